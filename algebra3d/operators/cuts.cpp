// split, clip, section, shells: parts of solids.
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/operators/solid_sets.h"
#include "algebra3d/registry/overload.h"

namespace algebra3d {
namespace {

Result<std::vector<Volume3d>> split_solid(Context& context, const Volume3d& solid, const Plane3d& plane) {
  ASSIGN_OR_RETURN(SolidParts parts, split(context, solid, plane.plane));
  return std::vector<Volume3d>{std::move(parts.in_front), std::move(parts.behind)};
}

Result<Volume3d> clip_solid(Context& context, const Volume3d& solid, const Box3& box) {
  return clipped(context, solid, box);
}

Result<Surface3d> section_of(Context& context, const Volume3d& solid, const Plane3d& plane) {
  return section(context, solid, plane.plane);
}

Result<std::vector<Surface3d>> shells_of(Context& context, const std::optional<Volume3d>& solid) {
  std::vector<Surface3d> shells;
  if (!solid) return shells;
  SubmeshMaker maker(solid->mesh());
  for (const std::vector<FaceId>& faces : connected_components(solid->mesh()).faces()) {
    RETURN_IF_ERROR(context.check_cancelled());
    shells.push_back(Surface3d::trusted(maker.make(faces)));
  }
  return shells;
}

const std::string kInner = "createCube(makePoint3D(0.5, 0.5, 0.5), makePoint3D(1, 1, 1))";
const std::string kPlane = "[const plane3d value (0.5 0 0 1)]";

void register_half_spaces(Registry& registry) {
  registry.add({
      .name = "split",
      .syntax = "_ split[_]",
      .doc = "The parts of a solid on both sides of a plane, as a stream of two: in front of it, behind it.",
      .detail =
          "In front is the side to which the normal points. Either part may be empty. Corners of the cut are exact.",
      .exactness = Exactness::exact,
      .overloads = {overload<&split_solid>("solid", "plane")},
      .examples = {{kCubeOfTwo + " split[" + kPlane + "] transformstream projectextend[; V: volume(.Elem)] sum[V]",
                    "8.0"},
                   {kCubeOfTwo + " split[" + kPlane + "] count", "2"},
                   {"[const volume3d value undefined] split[" + kPlane + "] count", "0"}},
      .errors = {{"query " + kCubeOfTwo + " split[1] count", "split: expected (volume3d plane3d), got (volume3d int)"}},
  });
  registry.add({
      .name = "clip",
      .syntax = "_ clip[_]",
      .doc = "The part of a solid that lies in a box.",
      .detail = "The intersection with the box as a solid; empty for a box without volume.",
      .exactness = Exactness::exact,
      .overloads = {overload<&clip_solid>("solid", "box")},
      .examples = {{"volume(" + kCubeOfTwo + " clip[rectangle3(1, 5, 1, 5, 0, 5)])", "2.0"},
                   {"size(" + kCubeOfTwo + " clip[rectangle3(3, 5, 1, 5, 0, 5)])", "0"},
                   {kCubeOfTwo + " clip[[const rect3 value undefined]]", "undefined"}},
      .errors = {{"query " + kCubeOfTwo + " clip[1]", "clip: expected (volume3d rect3), got (volume3d int)"}},
  });
}

void register_surfaces_of_solids(Registry& registry) {
  registry.add({
      .name = "section",
      .syntax = "section(_, _)",
      .doc = "The part of a plane that lies in a solid, as a surface that looks where the plane's normal points.",
      .detail =
          "Faces of the solid in the plane belong to it; edges and corners in which the plane only touches do not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&section_of>("solid", "plane")},
      .examples = {{"area(section(" + kCubeOfTwo + ", " + kPlane + "))", "4.0"},
                   {"area(section(" + kCubeOfTwo + " minus " + kInner + ", " + kPlane + "))", "4.0"},
                   {"area(section(" + kCubeOfTwo + " minus " + kInner + ", [const plane3d value (0.75 0 0 1)]))",
                    "3.75"},
                   {"size(section(" + kCubeOfTwo + ", [const plane3d value (3 0 0 1)]))", "0"},
                   {"section([const volume3d value undefined], " + kPlane + ")", "undefined"}},
      .errors = {{"query section(" + kCubeOfTwo + ", 1)", "section: expected (volume3d plane3d), got (volume3d int)"}},
  });
  registry.add({
      .name = "shells",
      .syntax = "shells(_)",
      .doc = "The closed surfaces that bound a solid, as a stream: outer ones look outward, those of cavities inward.",
      .detail = "Triangles that share an edge are of one shell. Shells come in order of their first triangles; an "
                "undefined or empty solid has none.",
      .exactness = Exactness::exact,
      .overloads = {overload<&shells_of>("solid")},
      .examples = {{"shells(" + kCubeOfTwo + ") count", "1"},
                   {"shells(" + kCubeOfTwo + " minus " + kInner + ") count", "2"},
                   {"shells([const volume3d value undefined]) count", "0"}},
      .errors = {{"query shells(1) count", "shells: expected (volume3d), got (int)"}},
  });
}

}  // namespace

void register_cuts(Registry& registry) {
  register_half_spaces(registry);
  register_surfaces_of_solids(registry);
}

}  // namespace algebra3d
