// simplify.
#include "algebra3d/kernel/simplification/simplification.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/rounding/rounded_surface.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/large_allocator.h"
#include "base/number_text.h"
#include "base/polygon_soup.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The triangles of a value with double coordinates, as simplification takes them.
Result<Maybe<TriangleMesh>> rounded_triangles(Context& context, const Volume3d& solid) {
  if (solid.mesh().points().exact_count() == 0) return Maybe<TriangleMesh>(solid.mesh());
  A3D_ASSIGN(RoundedSolid rounded, rounded_solid(solid.mesh(), CoordinateGrid::doubles(), context.monitor()));
  if (!rounded.mesh) return Maybe<TriangleMesh>(Undefined{rounded.reason});
  return Maybe<TriangleMesh>(*std::move(rounded.mesh));
}
Result<Maybe<TriangleMesh>> rounded_triangles(Context& context, const Surface3d& surface) {
  if (surface.mesh().points().exact_count() == 0) return Maybe<TriangleMesh>(surface.mesh());
  A3D_ASSIGN(RoundedSurface rounded, rounded_surface(surface.mesh(), CoordinateGrid::doubles(), context.monitor()));
  if (!rounded.mesh) return Maybe<TriangleMesh>(Undefined{rounded.reason});
  return Maybe<TriangleMesh>(*std::move(rounded.mesh));
}
Result<Maybe<TriangleMesh>> rounded_triangles(Context& context, const Mesh3d& mesh) {
  const PolygonMesh& faces = mesh.mesh();
  for (std::size_t f = 0; f < faces.face_count(); ++f)
    if (faces.degree(FaceId(f)) != 3)
      return Error{ErrorCode::invalid_value,
                   "simplify: face {} has {} corners, expected triangles; triangulate makes them", f,
                   faces.degree(FaceId(f))};
  LargeVector<std::uint32_t> opposites(faces.halfedge_count());
  constexpr std::size_t kHalfedgesPerTask = 1U << 16U;
  parallel_for(opposites.size(), kHalfedgesPerTask, [&](std::size_t h) {
    const HalfedgeId opposite = faces.opposite(HalfedgeId(h));
    opposites[h] = opposite.is_valid() ? opposite.index() : TriangleMesh::kUnlinked;
  });
  A3D_TRY(context.check_cancelled());
  PointArray points(faces.points().approx());
  A3D_TRY(context.check_cancelled());
  return Maybe<TriangleMesh>(
      TriangleMesh::with_proposed_links(std::move(points), faces.origins(), std::move(opposites)));
}

Result<Simplification> simplified_as(const Volume3d& /*kind*/, const TriangleMesh& mesh,
                                     const SimplificationTarget& target, const Monitor& monitor) {
  return simplified_volume(mesh, target, monitor);
}
Result<Simplification> simplified_as(const Surface3d& /*kind*/, const TriangleMesh& mesh,
                                     const SimplificationTarget& target, const Monitor& monitor) {
  return simplified_surface(mesh, target, monitor);
}
Result<Simplification> simplified_as(const Mesh3d& /*kind*/, const TriangleMesh& mesh,
                                     const SimplificationTarget& target, const Monitor& monitor) {
  return simplified(mesh, target, monitor);
}

/// The results of simplified_volume and simplified_surface are proved, or the argument itself.
Volume3d value_of(const Volume3d& /*before*/, Simplification result) {
  return Volume3d::trusted(std::move(result.mesh));
}
Surface3d value_of(const Surface3d& /*before*/, Simplification result) {
  return Surface3d::trusted(std::move(result.mesh));
}
/// With the attributes of the remaining elements.
Mesh3d value_of(const Mesh3d& before, Simplification result) {
  PolygonMesh mesh(result.mesh.points(), PolygonLayout::of_degree(3), result.mesh.origins());
  MeshAttributes attributes = attributes_after(before.attributes(), before.mesh(), mesh, result);
  return {std::move(mesh), std::move(attributes)};
}

void report(Context& context, std::size_t before, const Simplification& result, const SimplificationTarget& target) {
  std::string text = fmt::format("simplify: {} of {} triangles are left", result.mesh.face_count(), before);
  if (target.deviation < kInfinity) text += ", deviation at most " + real_text(result.deviation);
  if (result.mesh.face_count() > target.triangles && target.deviation == kInfinity)
    text += result.repetitions > 0 ? "; steps after which it would cross itself were left out"
                                   : "; no further edge can be collapsed";
  context.diagnostics.report(std::move(text));
}

template <typename T>
Result<Maybe<T>> simplified_to(Context& context, const T& value, const SimplificationTarget& target) {
  if (!(target.crease_degrees >= 0 && target.crease_degrees <= 180))
    return Maybe<T>(Undefined{"the crease angle must be between 0 and 180 degrees"});
  A3D_ASSIGN(const auto mesh, rounded_triangles(context, value));
  if (!mesh) return Maybe<T>(Undefined{mesh.reason()});
  A3D_ASSIGN(Simplification result, simplified_as(value, *mesh, target, context.monitor()));
  report(context, mesh->face_count(), result, target);
  return Maybe<T>(value_of(value, std::move(result)));
}

/// Where no crease angle is given.
constexpr double kNoCreases = 180;

template <typename T>
Result<Maybe<T>> creased_to_count(Context& context, const T& value, std::int64_t triangles, double crease) {
  if (triangles < 0) return Maybe<T>(Undefined{"the number of triangles must not be negative"});
  return simplified_to(context, value, {static_cast<std::size_t>(triangles), kInfinity, crease});
}
template <typename T>
Result<Maybe<T>> simplified_to_count(Context& context, const T& value, std::int64_t triangles) {
  return creased_to_count(context, value, triangles, kNoCreases);
}

template <typename T>
Result<Maybe<T>> creased_to_deviation(Context& context, const T& value, double deviation, double crease) {
  if (!(deviation >= 0 && deviation < kInfinity)) return Maybe<T>(Undefined{"the deviation must not be negative"});
  return simplified_to(context, value, {0, deviation, crease});
}
template <typename T>
Result<Maybe<T>> simplified_to_deviation(Context& context, const T& value, double deviation) {
  return creased_to_deviation(context, value, deviation, kNoCreases);
}

template <typename T>
Result<Maybe<T>> creased_to_share(Context& context, const T& value, const std::string& measure, double share,
                                  double crease) {
  if (measure != "ratio")
    return Error{ErrorCode::invalid_value, R"(simplify: expected "ratio" and a share, got "{}")", measure};
  if (!(share >= 0 && share <= 1)) return Maybe<T>(Undefined{"the share must be between 0 and 1"});
  const double count = std::floor(share * static_cast<double>(value.mesh().face_count()));
  return simplified_to(context, value, {static_cast<std::size_t>(count), kInfinity, crease});
}
template <typename T>
Result<Maybe<T>> simplified_to_share(Context& context, const T& value, const std::string& measure, double share) {
  return creased_to_share(context, value, measure, share, kNoCreases);
}

/// The overloads for a type, whose parameter is called `name`.
template <typename T>
std::vector<Overload> overloads_for(const char* name) {
  return {overload<&simplified_to_count<T>>(name, "triangles"),
          overload<&simplified_to_deviation<T>>(name, "deviation"),
          overload<&simplified_to_share<T>>(name, "measure", "share"),
          overload<&creased_to_count<T>>(name, "triangles", "degrees"),
          overload<&creased_to_deviation<T>>(name, "deviation", "degrees"),
          overload<&creased_to_share<T>>(name, "measure", "share", "degrees")};
}

std::vector<Overload> simplify_overloads() {
  std::vector<Overload> all = overloads_for<Mesh3d>("mesh");
  for (const auto& more : {overloads_for<Surface3d>("surface"), overloads_for<Volume3d>("solid")})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

const std::string kSquareOfEight =
    "(mesh3d (((0 0 0) (1 0 0) (2 0 0) (0 1 0) (1 1 0) (2 1 0) (0 2 0) (1 2 0) (2 2 0)) ((0 1 4) (0 4 3) (1 2 5) (1 5 "
    "4) "
    "(3 4 7) (3 7 6) (4 5 8) (4 8 7))))";
const std::string kDetail =
    "Edges are collapsed, those first that cost the least quadric error, until a number of triangles (an int), a "
    R"(share of them ("ratio"), or a largest deviation (a real) is reached; a diagnostic says which of them. Topology )"
    "stays: parts, handles and boundary loops; the boundary is kept as far as the error allows, and no face turns "
    "over. So more triangles may be left than demanded. The deviation is the Hausdorff distance of the boundaries "
    "before and after. It is measured, and holds but for 2^-43 of the largest coordinate. Coordinates of results "
    "are doubles. A surface or solid stays a valid one: the result is proved, and where it crosses itself the "
    "steps around the crossing are taken back. With a crease angle, in degrees, edges with a larger angle between "
    "the normals of their faces are creases, which are kept like the boundary: vertices on a crease stay on its "
    "line of edges, and where creases meet or end the vertices stay in their places; without one there are none. "
    "Attributes of a mesh3d are kept: faces, vertices and edges have those of one that they were, corners those of the "
    "vertex that they are at, in their chart, that is, on their side of all edges where the values of corners "
    "differ. A mesh3d must consist of triangles, and its result may cross itself; edges with three or more faces "
    "stay, and so do isolated vertices.";

}  // namespace

void register_simplification(OperatorGroup& group) {
  group.add({
      .name = "simplify",
      .syntax = "simplify(_, _ ...)",
      .doc = "The mesh, surface or solid with fewer triangles: as many as given, or as few as a deviation allows.",
      .detail = kDetail,
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .cost = Cost::sorting,
      .sources = {"garland1997", "dey1999"},
      .overloads = simplify_overloads(),
      .examples = {{{kUnitCube, "0.0"}, "1.0", "(volume _)"},
                   {{kUnitCube, "100"}, "1.0", "(volume _)"},
                   {{kUnitCube, R"("ratio")", "1.0"}, "1.0", "(volume _)"},
                   {{kSquareOfEight, "0.0"},
                    "(((2.0 0.0 0.0) (0.0 0.0 0.0) (0.0 2.0 0.0) (2.0 2.0 0.0)) ((1 0 3) (1 3 2)))"},
                   {{kSquareOfEight, "0.0", "30.0"}, "2", "(size _)"},
                   {{kUnitCube, "8", "30"}, "1.0", "(volume _)"},
                   {{kUnitCube, R"("ratio")", "0.0", "30"}, "1.0", "(volume _)"},
                   {{kUnitCube, "8", "181"}, "undefined"},
                   {{kUnitCube, "-1"}, "undefined"},
                   {{kUnitCube, "-1.0"}, "undefined"},
                   {{kUndefinedSolid, "10"}, "undefined"}},
      .errors = {{{kUnitCube, R"("share")", "0.5"}, R"(simplify: expected "ratio" and a share, got "share")"},
                 {{"(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3))))", "1"},
                  "simplify: face 0 has 4 corners, expected triangles; triangulate makes them"},
                 {{"1", "2"}, "simplify: expected (mesh3d int), (mesh3d real)"}},
  });
}

}  // namespace algebra3d
