#include "algebra3d/kernel/distance/detail/face_bounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <type_traits>

#include "base/nearest_in_triangle.h"

namespace algebra3d::distances {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// A bound of the roundings of a distance, and of exact corners, in units: coordinates are below 2.
template <typename Number>
constexpr Number kOfDistance = 16 * std::numeric_limits<Number>::epsilon();
/// Grows a number by more than a few roundings.
template <typename Number>
constexpr Number kGrown = 1 + 4 * std::numeric_limits<Number>::epsilon();
/// More candidates for a part are not compared with it one by one.
constexpr std::size_t kManyCandidates = 64;
/// After so many parts of a face those that are left are bounded by one triangle each.
constexpr std::size_t kMaxParts = 1 << 14;
/// So many parts of a face that are left when the steps for the part that they are of are used up are visited anew.
constexpr std::size_t kMaxRenewed = 64;
/// Parts that were divided less often are divided at a face that is near enough, without a search for the nearest.
constexpr std::uint32_t kDepthAmongNeedles = 8;
/// Parts are not divided more often, which halves two of their sides as often as there are digits, and more.
template <typename Number>
constexpr std::uint32_t kMaxDepth = sizeof(Number) > sizeof(double) ? 192 : 96;

/// The distance of a point from the segment from 0 to `edge`.
template <typename Vector>
auto distance_from_edge(const Vector& point, const Vector& edge) {
  const auto whole = dot(edge, edge), along = dot(point, edge);
  if (!(along > 0)) return size_of(point);
  return along < whole ? size_of(point - along / whole * edge) : size_of(point - edge);
}

template <typename Vector>
Vector narrowed(const WideVec3& v) {
  using Number = decltype(Vector::x);
  return Vector(static_cast<Number>(v.x), static_cast<Number>(v.y), static_cast<Number>(v.z));
}

}  // namespace

double half_scale_for(const Box3& box) {
  double half = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    half = std::max({half, std::abs(box.min[axis]) / 2, std::abs(box.max[axis]) / 2});
  return half > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(half), -1022, 1000)) : 1;
}

template <typename Vector>
FaceBounds<Vector>::FaceBounds(const TriangleMesh& from, const DistanceOperand& to, const LargeFacets& facets,
                               const Box3& box, double enough, const Monitor& monitor)
    : from_(from),
      to_(to),
      boxes_(to.hierarchy->oriented_boxes(*to.mesh)),
      facets_(facets),
      box_(box),
      half_scale_(half_scale_for(box)),
      enough_(half_scale_ * (0.5 * enough)),
      monitor_(monitor) {}

template <typename Vector>
Vec3 FaceBounds<Vector>::unscaled(const Vector& point) const {
  Vec3 result{static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = std::clamp(result[axis] / half_scale_ * 2, box_.min[axis], box_.max[axis]);
  return result;
}

/// Rounded up.
template <typename Vector>
double FaceBounds<Vector>::unscaled(Number length) const {
  const Number exact = length / half_scale_ * 2;
  const auto rounded = static_cast<double>(exact);
  return rounded < exact ? std::nextafter(rounded, kUnbounded) : rounded;
}

template <typename Vector>
auto FaceBounds<Vector>::target(FaceId face) const -> Target {
  const auto [a, b, c] = to_.mesh->triangle(face);
  const std::vector<Vec3>& points = to_.mesh->points().approx();
  const Vector corner = scaled(points[a]);
  return {face, corner, scaled(points[b]) - corner, scaled(points[c]) - corner};
}

template <typename Vector>
Vector FaceBounds<Vector>::unit_normal(FaceId face) const {
  const Target at = target(face);
  const Vector normal = cross(at.first_edge, at.second_edge);
  const Number size = size_of(normal);
  return size > 0 ? 1 / size * normal : Vector{};
}

/// The sides of the cell along the edges. An edge without a neighbour has one at right angles to the triangle.
template <typename Vector>
auto FaceBounds<Vector>::cell_of(FaceId face) const -> std::array<CellSide<Vector>, 3> {
  const TriangleMesh& mesh = *to_.mesh;
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vector normal = unit_normal(face);
  std::array<CellSide<Vector>, 3> sides;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const HalfedgeId edge = TriangleMesh::halfedge(face, i), opposite = mesh.opposite(edge);
    const Vector upward = opposite.is_valid() ? normal + unit_normal(TriangleMesh::face(opposite)) : normal;
    const Vector begin = scaled(points[mesh.origin(edge).index()]), end = scaled(points[mesh.target(edge).index()]);
    sides[i] = {begin, cross(upward, end - begin)};
  }
  return sides;
}

/// From the nearest point of the triangle, but for roundings.
template <typename Vector>
Vector FaceBounds<Vector>::way_from(const Target& target, const Vector& point) {
  const Vector from_corner = point - target.corner;
  const auto [first, second] = nearest_in_triangle(from_corner, target.first_edge, target.second_edge);
  return from_corner - (first * target.first_edge + second * target.second_edge);
}

/// The distance of a point of the triangle that is nearest but for roundings: never too small by more than roundings.
template <typename Vector>
auto FaceBounds<Vector>::distance(const Vector& point, const Target& target) -> Number {
  const Vector from_corner = point - target.corner;
  const auto [first, second] = nearest_in_triangle(from_corner, target.first_edge, target.second_edge);
  const Number inside = size_of(from_corner - (first * target.first_edge + second * target.second_edge));
  if constexpr (std::is_same_v<Number, double>) return inside;
  // In a needle roundings hide where the nearest point is, but not along an edge.
  return std::min({inside, distance_from_edge(from_corner, target.first_edge),
                   distance_from_edge(from_corner, target.second_edge),
                   distance_from_edge(from_corner - target.first_edge, target.second_edge - target.first_edge)});
}

template <typename Vector>
auto FaceBounds<Vector>::farthest(const Part& part, const Target& target) -> Farthest {
  Farthest result{0, -1, {}};
  for (std::uint32_t i = 0; i < part.size; ++i)
    if (const Number own = distance(part.corners[i], target); own > result.distance) result = {0, own, part.corners[i]};
  result.upper = (result.distance + (kOfDistance<Number> + part.deviation)) * kGrown<Number>;
  return result;
}

/// True if this distance of the farthest corner from another triangle shows that the bound is not tight: if the corner
/// is not farther than is enough, or clearly nearer than the bound.
template <typename Vector>
bool FaceBounds<Vector>::is_clearly_nearer(Number distance, const Farthest& bound) const {
  constexpr Number kClearly = 0.875;
  return distance + kOfDistance<Number> < bound.distance && distance < std::max(kClearly * bound.upper, enough_);
}

template <typename Vector>
template <typename IsEnough>
auto FaceBounds<Vector>::nearest(const Vector& point, FaceId near, IsEnough is_enough) -> Near {
  Near best{near, distance(point, target(near))};
  const auto reach = [&] { return unscaled(best.distance + kOfDistance<Number>); };
  const Vec3 place = unscaled(point);
  const OrientedGaps gaps(*to_.hierarchy, boxes_, place);
  to_.hierarchy->for_each_near(Box3::of(place), reach(), gaps, [&](std::uint32_t face) {
    ++work_;
    const Number own = distance(point, target(FaceId(face)));
    if (own >= best.distance) return reach();
    best = {FaceId(face), own};
    return is_enough(best.face) ? -1 : reach();
  });
  return best;
}

/// From face to neighbouring face as long as that is nearer, some times at most: mostly what is nearest, if the first
/// one is near.
template <typename Vector>
auto FaceBounds<Vector>::walk(const Vector& point, FaceId from) const -> Near {
  Near best{from, distance(point, target(from))};
  constexpr int kSteps = 16;
  bool has_moved = true;
  for (int step = 0; has_moved && step < kSteps; ++step) {
    has_moved = false;
    const FaceId face = best.face;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfedgeId opposite = to_.mesh->opposite(TriangleMesh::halfedge(face, i));
      if (!opposite.is_valid()) continue;
      const Number own = distance(point, target(TriangleMesh::face(opposite)));
      if (own >= best.distance) continue;
      best = {TriangleMesh::face(opposite), own};
      has_moved = true;
    }
  }
  return best;
}

/// The one of the hint and the faces found before that is nearest to a point.
template <typename Vector>
FaceId FaceBounds<Vector>::near_of_recent(const Vector& point) const {
  Near best{hint_, distance(point, target(hint_))};
  for (const FaceId recent : recent_) {
    if (recent.is_none()) break;
    if (const Number own = distance(point, target(recent)); own < best.distance) best = {recent, own};
  }
  return best.face;
}

template <typename Vector>
void FaceBounds<Vector>::take(const Farthest& farthest, FaceId near) {
  if (farthest.upper <= irrelevant()) return;
  best_ = farthest;
  best_near_ = near;
}

template <typename Vector>
FaceBound FaceBounds<Vector>::of(FaceId face, const std::array<FaceId, 3>& nearest, std::size_t max_work) {
  Part whole;
  for (const std::uint32_t corner : from_.triangle(face)) whole.add(scaled(from_.points().approx()[corner]));
  Number least = kUnbounded;
  for (const FaceId near : nearest) {
    const Number upper = farthest(whole, target(near)).upper;
    if (upper <= enough_) return {};
    if (upper < least) hint_ = near;
    least = std::min(least, upper);
  }
  normal_ = cross(whole.corners[1] - whole.corners[0], whole.corners[2] - whole.corners[0]);
  best_ = {};
  work_ = renewed_count_ = 0;
  waiting_.assign(1, whole);
  for (std::size_t count = 0; !waiting_.empty() && !monitor_.is_cancelled(); ++count) {
    const Part part = waiting_.back();
    waiting_.pop_back();
    if (count < kMaxParts && work_ < max_work)
      visit(part);
    else
      take(farthest(part, target(hint_)), hint_);
  }
  comparison_count_ += work_;
  if (best_.upper <= enough_) return {};
  return {unscaled(best_.upper), unscaled(best_.where), best_near_};
}

/// The faces that may be nearest to a point of the part, none of which is farther than `reach` from the set. False if
/// they are too many.
template <typename Vector>
bool FaceBounds<Vector>::gather(const Part& part, Number reach) {
  Box3 box;
  for (std::uint32_t i = 0; i < part.size; ++i) box.extend(unscaled(part.corners[i]));
  const double limit = unscaled(reach);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::nextafter(box.min[axis] - limit, -kUnbounded);
    box.max[axis] = std::nextafter(box.max[axis] + limit, kUnbounded);
  }
  candidates_.clear();
  to_.hierarchy->for_each_meeting(box, [&](std::uint32_t face) {
    ++work_;
    candidates_.push_back(target(FaceId(face)));
    return candidates_.size() <= kManyCandidates;
  });
  return candidates_.size() <= kManyCandidates && !candidates_.empty();
}

template <typename Vector>
bool FaceBounds<Vector>::is_over_facet(const std::array<Vec3, 3>& corners, FaceId face) const {
  if (facets_.plane_of(face) == nullptr) return false;
  Part part;
  for (const Vec3& corner : corners) part.add(scaled(corner));
  part.deviation = 0x1p-44;
  return lies_over_facet(part, face);
}

/// True if the part lies over the inside of the large facet of a face, and near its plane, so that no point of it is
/// farther from the facet than is irrelevant. The part is made smaller for it by what the bound leaves over: parts
/// often end where facets do.
template <typename Vector>
bool FaceBounds<Vector>::lies_over_facet(const Part& part, FaceId face) const {
  const LargeFacets::Plane* plane = facets_.plane_of(face);
  if (plane == nullptr) return false;
  constexpr Number kMargin = 16 * std::numeric_limits<double>::epsilon();
  const auto point = narrowed<Vector>(plane->point), normal = narrowed<Vector>(plane->normal);
  const auto deviation = static_cast<Number>(plane->deviation), turn = static_cast<Number>(plane->turn);
  const auto height = [&](const Vector& place) { return dot(normal, place - point); };
  const Vector centre = part.centre();
  Number highest = 0, radius = 0;
  for (const Vector& corner : part.corner_span()) {
    highest = std::max(highest, std::abs(height(corner)));
    radius = std::max(radius, size_of(corner - centre));
  }
  // By the exact plane, whose normal is turned by little.
  const Number bound = (highest + deviation + kMargin + part.deviation) * (1 + Number(0x1p-38));
  const Number left = irrelevant() - bound;
  if (!(left > 0)) return false;
  const Number shrunk = 1 - std::min(left / (2 * radius), Number(1) / 16);
  const Number lateral = kMargin + part.deviation + 2 * turn * (highest + kMargin);
  // The foot of the centre is in the facet, since it is within this of one of its faces, and outlines are not.
  const Vector foot = centre - height(centre) * normal;
  if (!(distance(foot, target(face)) <= lateral + deviation)) return false;
  const Number reach = 4 * (lateral + deviation);
  Part inner;
  Box3 box;
  for (const Vector& corner : part.corner_span()) {
    const Vector place = centre + shrunk * (corner - centre);
    inner.add(place - height(place) * normal);
    const Vec3 in_plane = unscaled(inner.corners[inner.size - 1]);
    box.extend(in_plane);
  }
  const double margin = unscaled(2 * reach);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::nextafter(box.min[axis] - margin, -kUnbounded);
    box.max[axis] = std::nextafter(box.max[axis] + margin, kUnbounded);
  }
  bool is_inside = true;
  facets_.for_each_outline_edge(face, box, [&](const Vec3& begin, const Vec3& end) {
    const std::array<Vector, 2> edge{scaled(begin), scaled(end)};
    is_inside = are_apart_seen_along<Vector>(normal, edge, inner.corner_span(), reach);
    return is_inside;
  });
  return is_inside;
}

/// Bounds the part, or divides it until few faces are near.
template <typename Vector>
void FaceBounds<Vector>::visit(const Part& part) {
  ++work_;
  const Vector centre = part.centre();
  Number radius = 0;
  for (std::uint32_t i = 0; i < part.size; ++i) radius = std::max(radius, size_of(part.corners[i] - centre));
  Near near = walk(centre, near_of_recent(centre));
  Farthest bound = farthest(part, target(near.face));
  const auto is_bounded = [&] { return bound.upper <= irrelevant() || lies_over_facet(part, near.face); };
  if (is_bounded()) return;
  // Among needles a long part has many candidates, and what is nearest to its centre rarely does for all of it.
  if (boxes_ != nullptr && near.distance <= irrelevant() && part.depth < kDepthAmongNeedles) {
    hint_ = near.face;
    divide(part, target(near.face), waiting_, [&](const Farthest& own) { return clearly_nearer_of_all(own); });
    return;
  }
  near = nearest(centre, near.face, [&](FaceId face) {
    bound = farthest(part, target(face));
    return bound.upper <= irrelevant();
  });
  recent_[recent_count_++ % recent_.size()] = near.face;
  if (is_bounded()) return;
  const bool has_few =
      gather(part, std::min(bound.upper, (near.distance + radius + kOfDistance<Number>)*kGrown<Number>));
  hint_ = near.face;
  if (has_few)
    cover(part);
  else if (part.depth < kMaxDepth<Number> / 2)
    divide(part, target(near.face), waiting_, [&](const Farthest& own) { return clearly_nearer_of_all(own); });
  else
    take(bound, near.face);
}

/// Covers the part with the cells of the candidates. One corner where roundings hide which cell it is in may use up all
/// steps; so some of what is left then is visited anew.
template <typename Vector>
void FaceBounds<Vector>::cover(const Part& part) {
  std::size_t steps = 4 * candidates_.size() + 32;
  uncovered_.assign(1, part);
  while (!uncovered_.empty()) {
    const Part next = uncovered_.back();
    uncovered_.pop_back();
    work_ += candidates_.size();
    const Vector centre = next.centre();
    const Target* near = &candidates_.front();
    Number least = kUnbounded;
    for (const Target& candidate : candidates_) {
      const Number own = distance(centre, candidate);
      if (own < least) near = &candidate;
      least = std::min(least, own);
    }
    const Farthest bound = farthest(next, *near);
    if (bound.upper <= irrelevant() || lies_over_facet(next, near->face)) continue;
    if (steps == 0 && next.depth < kMaxDepth<Number> / 2 && renewed_count_ < kMaxRenewed) {
      ++renewed_count_;
      waiting_.push_back(next);
      continue;
    }
    if (steps == 0 || next.depth >= kMaxDepth<Number>) {
      take_least(next);
      continue;
    }
    --steps;
    divide(next, *near, uncovered_, [&](const Farthest& own) { return clearly_nearer(own); });
  }
}

/// Takes the bound of what of a part is in the cell of a triangle if it is tight, and leaves the rest to `left`:
/// divided where another triangle, nearer(bound), is as near as this one, if it is not tight, and in halves if nothing
/// is in the cell.
template <typename Vector>
template <typename Nearer>
void FaceBounds<Vector>::divide(const Part& part, const Target& target, std::vector<Part>& left, Nearer nearer) {
  const std::size_t count = left.size();
  Part inside = part;
  for (const CellSide<Vector>& side : cell_of(target.face)) {
    Part in, out;
    if (!inside.cut(side, in, out)) continue;
    if (out.size > 0) left.push_back(out);
    inside = in;
    if (inside.size == 0) break;
  }
  if (inside.size == 0) {
    left.resize(count);
    std::ranges::copy(part.halves(), std::back_inserter(left));
    return;
  }
  const Farthest bound = farthest(inside, target);
  if (bound.upper <= irrelevant()) return;
  const std::optional<Target> other = nearer(bound);
  if (!other)
    take(bound, target.face);
  else if (!divide_between(inside, bound.where, target, *other, left))
    std::ranges::copy(inside.halves(), std::back_inserter(left));
}

/// The candidate that is nearest to the farthest corner, if it shows that the bound is not tight.
template <typename Vector>
auto FaceBounds<Vector>::clearly_nearer(const Farthest& bound) const -> std::optional<Target> {
  const Target* nearest = nullptr;
  Number least = bound.distance;
  for (const Target& candidate : candidates_) {
    const Number own = distance(bound.where, candidate);
    if (own < least) nearest = &candidate;
    least = std::min(least, own);
  }
  return nearest != nullptr && is_clearly_nearer(least, bound) ? std::optional(*nearest) : std::nullopt;
}

/// The triangle of the whole set that is nearest to the farthest corner, if it shows that the bound is not tight.
template <typename Vector>
auto FaceBounds<Vector>::clearly_nearer_of_all(const Farthest& bound) -> std::optional<Target> {
  const Near near =
      nearest(bound.where, walk(bound.where, near_of_recent(bound.where)).face, [](FaceId) { return false; });
  return is_clearly_nearer(near.distance, bound) ? std::optional(target(near.face)) : std::nullopt;
}

/// Divides a part where it is equally far from the planes of two triangles, or from what else of them is nearest to a
/// point, which is nearer to the second one. False if that is not between its corners.
template <typename Vector>
bool FaceBounds<Vector>::divide_between(const Part& part, const Vector& point, const Target& first,
                                        const Target& second, std::vector<Part>& left) {
  const auto from_first = way_from(first, point), from_second = way_from(second, point);
  const Number size_first = size_of(from_first), size_second = size_of(from_second);
  if (!(size_second > 0) || !(size_first > size_second)) return false;
  // Both distances grow along these ways; the plane is that where they are equal, to first order.
  const Vector inward = 1 / size_second * from_second - 1 / size_first * from_first;
  const Number slope = dot(inward, inward);
  if (!(slope > 0)) return false;
  Part near_first, near_second;
  const CellSide<Vector> side{point + (size_first - size_second) / slope * inward, inward};
  if (!part.cut(side, near_first, near_second) || near_first.size == 0 || near_second.size == 0) return false;
  left.push_back(near_first);
  left.push_back(near_second);
  return true;
}

/// Takes the least bound of the part that a candidate gives.
template <typename Vector>
void FaceBounds<Vector>::take_least(const Part& part) {
  Farthest least{kUnbounded, kUnbounded, {}};
  FaceId of_least;
  for (const Target& candidate : candidates_)
    if (const Farthest bound = farthest(part, candidate); bound.upper < least.upper) {
      least = bound;
      of_least = candidate.face;
    }
  take(least, of_least);
}

template class FaceBounds<Vec3>;
template class FaceBounds<WideVec3>;

}  // namespace algebra3d::distances
