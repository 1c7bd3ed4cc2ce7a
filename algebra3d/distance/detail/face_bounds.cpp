#include "algebra3d/distance/detail/face_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/base/nearest_in_triangle.h"

namespace algebra3d::distances {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// A bound of the roundings of a distance, and of exact corners, in units: coordinates are below 2.
constexpr double kOfDistance = 0x1p-48;
/// A bound of the roundings of a point of an edge: of its coordinates, and twice that for each unit of the edge.
constexpr double kOfPoint = 0x1p-52;
/// Grows a number by more than a few roundings.
constexpr double kGrown = 1 + 0x1p-50;
/// More candidates for a part are not compared with it one by one.
constexpr std::size_t kManyCandidates = 64;
/// Parts are not divided more often.
constexpr std::uint32_t kMaxDepth = 96;

double size_of(const Vec3& v) {
  return std::sqrt(dot(v, v));
}

double scale_for(const Box3& box) {
  double half = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    half = std::max({half, std::abs(box.min[axis]) / 2, std::abs(box.max[axis]) / 2});
  return half > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(half), -1022, 1000)) : 1;
}

}  // namespace

FaceBounds::FaceBounds(const TriangleMesh& from, const DistanceOperand& to, const Box3& box, double enough,
                       const Monitor& monitor)
    : from_(from),
      to_(to),
      box_(box),
      half_scale_(scale_for(box)),
      enough_(half_scale_ * (0.5 * enough)),
      monitor_(monitor) {}

Vec3 FaceBounds::unscaled(const Vec3& point) const {
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = std::clamp(unscaled(point[axis]), box_.min[axis], box_.max[axis]);
  return result;
}

FaceBounds::Target FaceBounds::target(FaceId face) const {
  const auto [a, b, c] = to_.mesh->triangle(face);
  const std::vector<Vec3>& points = to_.mesh->points().approx();
  const Vec3 corner = scaled(points[a]);
  return {face, corner, scaled(points[b]) - corner, scaled(points[c]) - corner};
}

Vec3 FaceBounds::unit_normal(FaceId face) const {
  const Target at = target(face);
  const Vec3 normal = cross(at.first_edge, at.second_edge);
  const double size = size_of(normal);
  return size > 0 ? 1 / size * normal : Vec3{};
}

/// The sides of the cell along the edges. An edge without a neighbour has one at right angles to the triangle.
std::array<FaceBounds::CellSide, 3> FaceBounds::cell_of(FaceId face) const {
  const TriangleMesh& mesh = *to_.mesh;
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3 normal = unit_normal(face);
  std::array<CellSide, 3> sides;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const HalfedgeId edge = TriangleMesh::halfedge(face, i), opposite = mesh.opposite(edge);
    const Vec3 upward = opposite.is_valid() ? normal + unit_normal(TriangleMesh::face(opposite)) : normal;
    const Vec3 begin = scaled(points[mesh.origin(edge).index()]), end = scaled(points[mesh.target(edge).index()]);
    sides[i] = {begin, cross(upward, end - begin)};
  }
  return sides;
}

/// The distance of a point of the triangle that is nearest but for roundings: never too small by more than roundings.
double FaceBounds::distance(const Vec3& point, const Target& target) {
  const Vec3 from_corner = point - target.corner;
  const auto [first, second] = nearest_in_triangle(from_corner, target.first_edge, target.second_edge);
  return size_of(from_corner - (first * target.first_edge + second * target.second_edge));
}

FaceBounds::Farthest FaceBounds::farthest(const Part& part, const Target& target) {
  Farthest result{-1, {}};
  for (std::uint32_t i = 0; i < part.size; ++i)
    if (const double own = distance(part.corners[i], target); own > result.upper) result = {own, part.corners[i]};
  result.upper = (result.upper + (kOfDistance + part.deviation)) * kGrown;
  return result;
}

Vec3 FaceBounds::centre_of(const Part& part) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < part.size; ++i) sum = sum + part.corners[i];
  return 1.0 / part.size * sum;
}

FaceBounds::Near FaceBounds::nearest(const Vec3& point, FaceId near) const {
  Near best{near, distance(point, target(near))};
  const auto reach = [&] { return unscaled(best.distance + kOfDistance); };
  to_.hierarchy->for_each_near(Box3::of(unscaled(point)), reach(), [&](std::uint32_t face) {
    const double own = distance(point, target(FaceId(face)));
    if (own < best.distance) best = {FaceId(face), own};
    return reach();
  });
  return best;
}

/// From face to neighbouring face as long as that is nearer: mostly what is nearest, if the first one is near.
FaceBounds::Near FaceBounds::walk(const Vec3& point, FaceId from) const {
  Near best{from, distance(point, target(from))};
  for (bool has_moved = true; has_moved;) {
    has_moved = false;
    const FaceId face = best.face;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfedgeId opposite = to_.mesh->opposite(TriangleMesh::halfedge(face, i));
      if (!opposite.is_valid()) continue;
      const double own = distance(point, target(TriangleMesh::face(opposite)));
      if (own >= best.distance) continue;
      best = {TriangleMesh::face(opposite), own};
      has_moved = true;
    }
  }
  return best;
}

void FaceBounds::take(const Farthest& farthest, FaceId near) {
  if (farthest.upper <= irrelevant()) return;
  best_ = farthest;
  best_near_ = near;
}

FaceBound FaceBounds::of(FaceId face, const std::array<FaceId, 3>& nearest) {
  Part whole;
  for (const std::uint32_t corner : from_.triangle(face)) whole.add(scaled(from_.points().approx()[corner]));
  double least = kUnbounded;
  for (const FaceId near : nearest) {
    const double upper = farthest(whole, target(near)).upper;
    if (upper <= enough_) return {};
    if (upper < least) hint_ = near;
    least = std::min(least, upper);
  }
  best_ = {};
  waiting_.assign(1, whole);
  while (!waiting_.empty() && !monitor_.is_cancelled()) {
    const Part part = waiting_.back();
    waiting_.pop_back();
    visit(part);
  }
  if (best_.upper <= enough_) return {};
  return {unscaled(best_.upper), unscaled(best_.where), best_near_};
}

/// The faces that may be nearest to a point of the part, none of which is farther than `reach` from the set. False if
/// they are too many.
bool FaceBounds::gather(const Part& part, double reach) {
  candidates_.clear();
  Box3 box;
  for (std::uint32_t i = 0; i < part.size; ++i) box.extend(unscaled(part.corners[i]));
  const double limit = unscaled(reach);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::nextafter(box.min[axis] - limit, -kUnbounded);
    box.max[axis] = std::nextafter(box.max[axis] + limit, kUnbounded);
  }
  to_.hierarchy->for_each_meeting(box, [&](std::uint32_t face) {
    candidates_.push_back(target(FaceId(face)));
    return candidates_.size() <= kManyCandidates;
  });
  return !candidates_.empty() && candidates_.size() <= kManyCandidates;
}

/// Bounds the part, or divides it until few faces are near.
void FaceBounds::visit(const Part& part) {
  const Vec3 centre = centre_of(part);
  double radius = 0;
  for (std::uint32_t i = 0; i < part.size; ++i) radius = std::max(radius, size_of(part.corners[i] - centre));
  Near near = walk(centre, hint_);
  Farthest bound = farthest(part, target(near.face));
  const auto is_bounded = [&] { return bound.upper <= irrelevant(); };
  const auto has_gathered = [&] {
    return gather(part, std::min(bound.upper, (near.distance + radius + kOfDistance) * kGrown));
  };
  if (is_bounded()) return;
  bool has_few = has_gathered();
  if (!has_few) {
    near = nearest(centre, near.face);
    bound = farthest(part, target(near.face));
    if (is_bounded()) return;
    has_few = has_gathered();
  }
  hint_ = near.face;
  if (has_few)
    cover(part);
  else if (near.distance < radius && part.depth < kMaxDepth / 2)
    halve(part, waiting_);
  else
    take(bound, near.face);
}

/// Covers the part with the cells of the candidates.
void FaceBounds::cover(const Part& part) {
  std::size_t steps = 4 * candidates_.size() + 32;
  uncovered_.assign(1, part);
  while (!uncovered_.empty()) {
    const Part next = uncovered_.back();
    uncovered_.pop_back();
    const Vec3 centre = centre_of(next);
    const Target* near = &candidates_.front();
    double least = kUnbounded;
    for (const Target& candidate : candidates_) {
      const double own = distance(centre, candidate);
      if (own < least) near = &candidate;
      least = std::min(least, own);
    }
    const Farthest bound = farthest(next, *near);
    if (bound.upper <= irrelevant()) continue;
    if (steps == 0 || next.depth >= kMaxDepth) {
      take(bound, near->face);
      continue;
    }
    --steps;
    if (!divide_by_cell(next, *near)) halve(next, uncovered_);
  }
}

/// Takes the bound of what is in the cell, and leaves the rest uncovered. False if nothing is.
bool FaceBounds::divide_by_cell(const Part& part, const Target& target) {
  const std::size_t count = uncovered_.size();
  Part inside = part;
  for (const CellSide& side : cell_of(target.face)) {
    Part in, out;
    if (!cut(inside, side, in, out)) continue;
    if (out.size > 0) uncovered_.push_back(out);
    inside = in;
    if (inside.size == 0) break;
  }
  if (inside.size == 0) {
    uncovered_.resize(count);
    return false;
  }
  take(farthest(inside, target), target.face);
  return true;
}

/// Divides a part along a plane. False if the part has too many corners, or if roundings hide where the plane is. The
/// division is exact in this sense: the cuts are at shares of the edges, and the exact part has the same ones.
bool FaceBounds::cut(const Part& part, const CellSide& side, Part& inside, Part& outside) {
  constexpr double kNear = 0x1p-50;
  std::array<double, Part::kMaxCorners> heights;  // NOLINT(cppcoreguidelines-pro-type-member-init): as far as used
  double highest = 0, longest = 0;
  for (std::uint32_t i = 0; i < part.size; ++i) {
    heights[i] = dot(side.inward, part.corners[i] - side.point);
    highest = std::max(highest, std::abs(heights[i]));
  }
  for (std::uint32_t i = 0; i < part.size; ++i)
    if (std::abs(heights[i]) <= kNear * highest) heights[i] = 0;
  inside.size = outside.size = 0;
  int cut_count = 0, on_plane = 0;
  bool has_inside = false, has_outside = false;
  for (std::uint32_t i = 0; i < part.size; ++i) {
    const std::uint32_t next = i + 1 < part.size ? i + 1 : 0;
    const double height = heights[i], other = heights[next];
    has_inside = has_inside || height > 0;
    has_outside = has_outside || height < 0;
    if (inside.size + 1 >= Part::kMaxCorners || outside.size + 1 >= Part::kMaxCorners) return false;
    if (height >= 0) inside.add(part.corners[i]);
    if (height <= 0) outside.add(part.corners[i]);
    on_plane += static_cast<int>(height == 0);
    if (!((height > 0 && other < 0) || (height < 0 && other > 0))) continue;
    const Vec3 edge = part.corners[next] - part.corners[i];
    const Vec3 point = part.corners[i] + height / (height - other) * edge;
    longest = std::max(longest, size_of(edge));
    inside.add(point);
    outside.add(point);
    ++cut_count;
  }
  if (!has_outside) {
    inside = part;
    outside.size = 0;
    return true;
  }
  if (!has_inside) {
    outside = part;
    inside.size = 0;
    return true;
  }
  if (cut_count + on_plane != 2) return false;
  inside.depth = outside.depth = part.depth + 1;
  inside.deviation = outside.deviation = part.deviation + (cut_count > 0 ? kOfPoint * (1 + 2 * longest) : 0);
  return true;
}

/// Divides a part by a line between two corners, a triangle at the middle of its longest edge.
void FaceBounds::halve(const Part& part, std::vector<Part>& halves) {
  Part first, second;
  first.depth = second.depth = part.depth + 1;
  first.deviation = second.deviation = part.deviation;
  if (part.size > 3) {
    const std::uint32_t middle = part.size / 2;
    for (std::uint32_t i = 0; i <= middle; ++i) first.add(part.corners[i]);
    for (std::uint32_t i = middle; i < part.size; ++i) second.add(part.corners[i]);
    second.add(part.corners[0]);
  } else {
    std::uint32_t longest = 0;
    double length = -1;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double own = size_of(part.corners[(i + 1) % 3] - part.corners[i]);
      if (own > length) longest = i;
      length = std::max(length, own);
    }
    const Vec3 &a = part.corners[longest], &b = part.corners[(longest + 1) % 3], &c = part.corners[(longest + 2) % 3];
    const Vec3 middle = 0.5 * a + 0.5 * b;
    first.deviation = second.deviation = part.deviation + kOfPoint;
    for (const Vec3& corner : {a, middle, c}) first.add(corner);
    for (const Vec3& corner : {middle, b, c}) second.add(corner);
  }
  halves.push_back(first);
  halves.push_back(second);
}

}  // namespace algebra3d::distances
