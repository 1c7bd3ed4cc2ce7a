#include "algebra3d/values/constructions/shape_makers.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/exact/trigonometry.h"
#include "algebra3d/kernel/validity/star_shape.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::int64_t kMaxCorners = 10'000'000;
/// What a cylinder of kMaxCorners has, about.
constexpr std::int64_t kMaxSphereTriangles = 40'000'000;

/// Corners, rounded or exact, and triangles of a solid that is being made.
struct Draft {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

Maybe<Volume3d> undefined(std::string reason) {
  return Undefined{std::move(reason)};
}

/// The error limit_exceeded if so many triangles certainly need more memory than is left.
Status check_memory(std::int64_t triangles) {
  constexpr std::int64_t kLeastBytes = 60;  // of a triangle: draft and mesh together, while the latter is made
  return require_memory(static_cast<std::uint64_t>(triangles * kLeastBytes),
                        fmt::format("a solid of {} triangles", triangles));
}

/// Proves the mesh: at once where all of the inside is seen from the centre, which is so unless the corners were moved
/// far for the size of the shape.
Result<Maybe<Volume3d>> prove(Context& context, TriangleMesh mesh, const Vec3& centre) {
  if (is_finite(centre) && is_star_shaped(mesh, centre)) return Maybe<Volume3d>(Volume3d::trusted(std::move(mesh)));
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = context.cancel};
  return Volume3d::prove(std::move(mesh), options);
}

/// Proves what the rounding of the corners has left of the shape, with the centre inside.
Result<Maybe<Volume3d>> finish(Context& context, Draft draft, const Vec3& centre) {
  for (const Vec3& p : draft.points)
    if (!is_finite(p)) return undefined("a corner is beyond the range of doubles");
  A3D_TRY(context.check_cancelled());
  A3D_ASSIGN(auto proved, prove(context, TriangleMesh(PointArray(std::move(draft.points)), draft.triangles), centre));
  if (proved) return proved;
  return undefined("the shape collapses when its corners are rounded to doubles");
}

/// Corner i has the bits of i as the ends that it takes in x, y and z.
constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

}  // namespace

Result<Maybe<Volume3d>> box_between(Context& context, const Point3d& p, const Point3d& q) {
  std::array<RationalVec3, 2> ends{p.position.rational(), q.position.rational()};
  const auto order = [](Rational& low, Rational& high) {
    if (high < low) std::swap(low, high);
    return low != high;
  };
  if (!order(ends[0].x, ends[1].x) || !order(ends[0].y, ends[1].y) || !order(ends[0].z, ends[1].z))
    return undefined("the corners have a coordinate in common, so the solid has no extent there");
  PointArray points;
  for (std::size_t i = 0; i < 8; ++i)
    points.push_back(ExactPoint(RationalVec3(ends[i & 1U].x, ends[(i >> 1U) & 1U].y, ends[(i >> 2U) & 1U].z)));
  Draft draft;
  for (const auto& [a, b, c, d] : kSides) draft.quad(a, b, c, d);
  const Vec3 centre = 0.5 * p.position.approx() + 0.5 * q.position.approx();
  return prove(context, TriangleMesh(std::move(points), draft.triangles), centre);
}

namespace {

/// Why there is no circle of `count` corners with this radius; empty if there is.
std::string circle_complaint(double radius, std::int64_t count) {
  if (!(radius > 0)) return fmt::format("the radius is {}; it must be positive", radius);
  if (count < 3 || count > kMaxCorners) return fmt::format("{} corners; there must be 3 to {}", count, kMaxCorners);
  return {};
}

/// Points of the unit cylinder moved to their place, each coordinate rounded once.
AffineMap placement(const Point3d& base, double radius, double height) {
  const Rational r(radius);
  return AffineMap::scaling(RationalVec3(), RationalVec3(r, r, Rational(height)))
      .then(AffineMap::translation(base.position.rational()));
}

/// A point on the axis, that high above the base.
Vec3 on_axis(const Point3d& base, double height) {
  return base.position.approx() + Vec3{0, 0, height};
}

/// Corner `index` of a regular polygon, of which those before it are known: mirrors at the axes and at x = y give seven
/// of eight, and rounding knows no difference.
CirclePoint next_corner(const std::vector<CirclePoint>& known, std::uint32_t index, std::uint32_t count) {
  const auto mirrored = [&](std::uint32_t turn) { return known[turn - index]; };
  if (2 * index > count) return {mirrored(count).cosine, 0.0 - mirrored(count).sine};
  if (count % 2 == 0 && 4 * index > count) return {0.0 - mirrored(count / 2).cosine, mirrored(count / 2).sine};
  if (count % 4 == 0 && 8 * index > count) return {mirrored(count / 4).sine, mirrored(count / 4).cosine};
  return circle_point(index, count);
}

/// The corners of a regular polygon. Each is asked for once: it takes microseconds, and solids use it many times.
Result<std::vector<CirclePoint>> unit_circle(Context& context, std::uint32_t count) {
  std::vector<CirclePoint> circle;
  circle.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 8192 == 0) A3D_TRY(context.check_cancelled());
    circle.push_back(next_corner(circle, i, count));
  }
  return circle;
}

/// Appends the corners of one circle of a cylinder, at height 0 or 1 before the placement.
void add_circle(const AffineMap& place, double height, const std::vector<CirclePoint>& circle, Draft& draft) {
  for (const CirclePoint& corner : circle)
    draft.points.push_back(place.apply_rounded(Vec3{corner.cosine, corner.sine, height}));
}

/// The convex polygon of points first .. first + count - 1, seen from above counter-clockwise, or turned over.
/// Chords halve their arcs, so that most triangles are small: in a fan of n slivers every one reaches across the disc,
/// and the proof would have to look at n^2 pairs of a sliver and a triangle of the cone's side.
void add_disc(std::uint32_t first, std::uint32_t count, bool faces_up, Draft& draft) {
  struct Arc {
    std::uint32_t begin, end;
  };
  std::vector<Arc> arcs = {{first, first + count - 1}};
  while (!arcs.empty()) {
    const auto [begin, end] = arcs.back();
    arcs.pop_back();
    if (end - begin < 2) continue;
    const std::uint32_t middle = begin + (end - begin) / 2;
    draft.triangles.push_back(faces_up ? Triangle{begin, middle, end} : Triangle{begin, end, middle});
    arcs.push_back({middle, end});
    arcs.push_back({begin, middle});
  }
}

}  // namespace

Result<Maybe<Volume3d>> upright_prism(Context& context, const Point3d& base, double radius, double height,
                                      std::int64_t corners) {
  if (auto complaint = circle_complaint(radius, corners); !complaint.empty()) return undefined(std::move(complaint));
  if (!(height > 0)) return undefined(fmt::format("the height is {}; it must be positive", height));
  A3D_TRY(check_memory(4 * corners));
  const auto n = static_cast<std::uint32_t>(corners);
  const AffineMap place = placement(base, radius, height);
  Draft draft;
  A3D_ASSIGN(const std::vector<CirclePoint> circle, unit_circle(context, n));
  add_circle(place, 0, circle, draft);
  add_circle(place, 1, circle, draft);
  add_disc(0, n, false, draft);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    draft.quad(i, next, n + next, n + i);
  }
  add_disc(n, n, true, draft);
  return finish(context, std::move(draft), on_axis(base, 0.5 * height));
}

Result<Maybe<Volume3d>> upright_pyramid(Context& context, const Point3d& base, double radius, double height,
                                        std::int64_t corners) {
  if (auto complaint = circle_complaint(radius, corners); !complaint.empty()) return undefined(std::move(complaint));
  if (!(height > 0)) return undefined(fmt::format("the height is {}; it must be positive", height));
  A3D_TRY(check_memory(2 * corners));
  const auto n = static_cast<std::uint32_t>(corners);
  const AffineMap place = placement(base, radius, height);
  Draft draft;
  A3D_ASSIGN(const std::vector<CirclePoint> circle, unit_circle(context, n));
  add_circle(place, 0, circle, draft);
  draft.points.push_back(place.apply_rounded(Vec3{0, 0, 1}));
  add_disc(0, n, false, draft);
  for (std::uint32_t i = 0; i < n; ++i) draft.triangles.push_back({i, (i + 1) % n, n});
  return finish(context, std::move(draft), on_axis(base, 0.25 * height));
}

namespace {

/// A ring of the sphere: the circle round the x axis through one corner of the half circle.
void add_ring(const Point3d& centre, double radius, const CirclePoint& corner, const std::vector<CirclePoint>& circle,
              Draft& draft) {
  const Rational across = Rational(radius) * Rational(corner.sine);
  const AffineMap place = AffineMap::scaling(RationalVec3(), RationalVec3(Rational(radius), across, across))
                              .then(AffineMap::translation(centre.position.rational()));
  for (const CirclePoint& on_ring : circle)
    draft.points.push_back(place.apply_rounded(Vec3{corner.cosine, on_ring.cosine, on_ring.sine}));
}

}  // namespace

Result<Maybe<Volume3d>> sphere_polyhedron(Context& context, const Point3d& centre, double radius,
                                          std::int64_t corners) {
  if (auto complaint = circle_complaint(radius, corners); !complaint.empty()) return undefined(std::move(complaint));
  const auto n = static_cast<std::uint32_t>(corners + corners % 2);
  if (std::int64_t{n} * (n - 2) > kMaxSphereTriangles)
    return undefined(fmt::format("{} corners give {} triangles; there must be at most {}", n, std::int64_t{n} * (n - 2),
                                 kMaxSphereTriangles));
  A3D_TRY(check_memory(std::int64_t{n} * (n - 2)));
  const AffineMap place = placement(centre, radius, radius);
  const std::uint32_t rings = n / 2 - 1;
  Draft draft;
  A3D_ASSIGN(const std::vector<CirclePoint> circle, unit_circle(context, n));
  for (std::uint32_t i = 1; i <= rings; ++i) {
    A3D_TRY(context.check_cancelled());
    add_ring(centre, radius, circle[i], circle, draft);
  }
  const std::uint32_t first_pole = rings * n, last_pole = first_pole + 1;
  draft.points.push_back(place.apply_rounded(Vec3{1, 0, 0}));
  draft.points.push_back(place.apply_rounded(Vec3{-1, 0, 0}));
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t next = (j + 1) % n, last_ring = (rings - 1) * n;
    draft.triangles.push_back({first_pole, j, next});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
      draft.quad(ring * n + j, (ring + 1) * n + j, (ring + 1) * n + next, ring * n + next);
    draft.triangles.push_back({last_pole, last_ring + next, last_ring + j});
  }
  return finish(context, std::move(draft), centre.position.approx());
}

}  // namespace algebra3d
