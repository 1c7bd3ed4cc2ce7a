#include "algebra3d/kernel/rounding/detail/divided_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <tuple>

namespace algebra3d {
namespace {

/// Some corners of an outline in their order, as positions.
using Polygon = std::vector<std::uint32_t>;

/// The part of a polygon from one of its corners to another one, both included.
Polygon part(const Polygon& polygon, std::size_t from, std::size_t to) {
  Polygon result;
  for (std::size_t i = from;; i = (i + 1) % polygon.size()) {
    result.push_back(polygon[i]);
    if (i == to) return result;
  }
}

class OutlineDivision {
 public:
  OutlineDivision(std::span<const OutlineCorner> outline, std::span<const OutlineChord> chords)
      : outline_(outline), chords_(chords) {}

  std::vector<IndexTriangle> run();

 private:
  bool pinch(const Polygon& polygon);
  bool divide_at_chord(const Polygon& polygon);
  void divide_at_longest_side(const Polygon& polygon);
  std::size_t longest_side(const Polygon& polygon) const;
  std::size_t apex_over(const Polygon& polygon, std::size_t side) const;
  void add(Polygon polygon);

  const OutlineCorner& corner(std::uint32_t position) const { return outline_[position]; }

  std::span<const OutlineCorner> outline_;
  std::span<const OutlineChord> chords_;
  std::vector<Polygon> rest_;
  std::vector<IndexTriangle> triangles_;
};

// A polygon of two corners is left out: its two sides cancel.
void OutlineDivision::add(Polygon polygon) {
  if (polygon.size() > 2) rest_.push_back(std::move(polygon));
}

/// Divides the polygon where two of its corners are one point.
bool OutlineDivision::pinch(const Polygon& polygon) {
  std::vector<std::pair<PointId, std::size_t>> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) points.emplace_back(corner(polygon[i]).point, i);
  std::ranges::sort(points);
  const auto same = std::ranges::adjacent_find(points, {}, [](const auto& p) { return p.first; });
  if (same == points.end()) return false;
  const std::size_t first = same->second, second = std::next(same)->second;
  Polygon inner = part(polygon, first, second), outer = part(polygon, second, first);
  inner.pop_back();
  outer.pop_back();
  add(std::move(inner));
  add(std::move(outer));
  return true;
}

bool OutlineDivision::divide_at_chord(const Polygon& polygon) {
  if (polygon.size() == 3) return false;
  for (const auto& [a, b] : chords_) {
    const auto from = std::ranges::find(polygon, a), to = std::ranges::find(polygon, b);
    if (from == polygon.end() || to == polygon.end()) continue;
    const auto i = static_cast<std::size_t>(from - polygon.begin()), j = static_cast<std::size_t>(to - polygon.begin());
    Polygon left = part(polygon, i, j), right = part(polygon, j, i);
    if (left.size() == 2 || right.size() == 2) continue;
    add(std::move(left));
    add(std::move(right));
    return true;
  }
  return false;
}

/// The position in the polygon where its longest side begins.
std::size_t OutlineDivision::longest_side(const Polygon& polygon) const {
  const auto key = [&](std::size_t i) {
    const OutlineCorner &from = corner(polygon[i]), &to = corner(polygon[(i + 1) % polygon.size()]);
    const WideVec3 side = to.place - from.place;
    return std::tuple(dot(side, side), std::min(from.point, to.point), std::max(from.point, to.point));
  };
  std::size_t longest = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    if (key(i) > key(longest)) longest = i;
  return longest;
}

/// The position in the polygon of the corner that sees a side under the largest angle; a corner on the same side of the
/// triangle only if there are no others.
std::size_t OutlineDivision::apex_over(const Polygon& polygon, std::size_t side) const {
  const OutlineCorner &from = corner(polygon[side]), &to = corner(polygon[(side + 1) % polygon.size()]);
  const auto key = [&](std::size_t i) {
    const OutlineCorner& apex = corner(polygon[i]);
    const WideVec3 a = from.place - apex.place, b = to.place - apex.place;
    const WideVec3 normal = cross(a, b);
    const long double cosine = dot(a, b), sine = std::sqrt(dot(normal, normal));
    const bool is_on_side = (from.sides & to.sides & apex.sides) != 0;
    return std::tuple(is_on_side, -std::atan2(sine, cosine), apex.point);
  };
  std::size_t best = (side + 2) % polygon.size();
  for (std::size_t i = 3; i < polygon.size(); ++i)
    if (const std::size_t other = (side + i) % polygon.size(); key(other) < key(best)) best = other;
  return best;
}

void OutlineDivision::divide_at_longest_side(const Polygon& polygon) {
  if (polygon.size() == 3) {
    triangles_.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  const std::size_t from = longest_side(polygon), to = (from + 1) % polygon.size(), apex = apex_over(polygon, from);
  triangles_.push_back({polygon[from], polygon[to], polygon[apex]});
  add(part(polygon, to, apex));
  add(part(polygon, apex, from));
}

std::vector<IndexTriangle> OutlineDivision::run() {
  Polygon whole(outline_.size());
  for (std::uint32_t i = 0; i < whole.size(); ++i) whole[i] = i;
  add(std::move(whole));
  while (!rest_.empty()) {
    const Polygon polygon = std::move(rest_.back());
    rest_.pop_back();
    if (!pinch(polygon) && !divide_at_chord(polygon)) divide_at_longest_side(polygon);
  }
  return std::move(triangles_);
}

}  // namespace

std::vector<IndexTriangle> divided_outline(std::span<const OutlineCorner> outline,
                                           std::span<const OutlineChord> chords) {
  return OutlineDivision(outline, chords).run();
}

}  // namespace algebra3d
