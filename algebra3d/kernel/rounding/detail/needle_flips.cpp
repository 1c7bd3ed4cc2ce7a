#include "algebra3d/kernel/rounding/detail/needle_flips.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/wide_vec3.h"

namespace algebra3d {
namespace {

/// A flip makes the next one of a stack of needles possible.
constexpr int kMaxFlipRounds = 100;

/// A triangle by its longest edge and the corner that is off it.
struct Shape {
  std::size_t apex = 0;
  long double longest = 0, height = 0;
};

class NeedleFlips {
 public:
  NeedleFlips(TriangleStars& stars, double tolerance) : stars_(stars), tolerance_(tolerance) {}

  bool is_needle(const IndexTriangle& t) const { return shape(t).height <= tolerance_; }
  /// True if the needle has been flipped.
  bool flip(std::uint32_t needle) {
    const IndexTriangle& t = stars_[needle];
    const std::size_t apex = shape(t).apex;
    const std::uint32_t c = t[apex], a = t[(apex + 1) % 3], b = t[(apex + 2) % 3];
    const std::optional<std::uint32_t> second = only_other_at_edge(needle, a, b);
    if (!second) return false;
    const IndexTriangle& other = stars_[*second];
    const auto is_off_edge = [&](std::uint32_t v) { return v != a && v != b; };
    const std::uint32_t d = *std::ranges::find_if(other, is_off_edge);
    if (d == c || are_neighbours(c, d)) return false;
    if (!is_good({c, a, d}, normal(other)) || !is_good({d, b, c}, normal(other))) return false;
    stars_.flip(needle, c, *second, d);
    return true;
  }

 private:
  WideVec3 place(std::uint32_t vertex) const { return WideVec3(stars_.rounded_place(vertex)); }
  WideVec3 normal(const IndexTriangle& t) const {
    const WideVec3 a = place(t[0]);
    return cross(place(t[1]) - a, place(t[2]) - a);
  }
  Shape shape(const IndexTriangle& t) const {
    Shape shape;
    for (std::size_t apex = 0; apex < 3; ++apex) {
      const long double size = length(place(t[(apex + 2) % 3]) - place(t[(apex + 1) % 3]));
      if (size > shape.longest) shape = {apex, size};
    }
    if (shape.longest > 0) shape.height = length(normal(t)) / shape.longest;
    return shape;
  }
  bool is_good(const IndexTriangle& t, const WideVec3& up) const { return !is_needle(t) && dot(normal(t), up) > 0; }
  bool are_neighbours(std::uint32_t v, std::uint32_t w) const {
    bool are_found = false;
    stars_.for_each_at(v, [&](std::uint32_t t) { are_found |= std::ranges::find(stars_[t], w) != stars_[t].end(); });
    return are_found;
  }
  /// The other triangle with an edge, if there is only one.
  std::optional<std::uint32_t> only_other_at_edge(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
    std::optional<std::uint32_t> other;
    int count = 0;
    stars_.for_each_at(a, [&](std::uint32_t t) {
      if (t == triangle || std::ranges::find(stars_[t], b) == stars_[t].end()) return;
      other = t;
      ++count;
    });
    return count == 1 ? other : std::nullopt;
  }

  TriangleStars& stars_;
  double tolerance_;
};

}  // namespace

bool flip_needles(TriangleStars& stars, const std::vector<bool>& may_change, double tolerance) {
  NeedleFlips flips(stars, tolerance);
  const auto is_needle = [&](std::uint32_t triangle) {
    const IndexTriangle& t = stars[triangle];
    return t[0] != kNone && may_change[t[0]] && may_change[t[1]] && may_change[t[2]] && flips.is_needle(t);
  };
  std::vector<std::uint32_t> needles;
  for (std::uint32_t t = 0; t < stars.size(); ++t)
    if (is_needle(t)) needles.push_back(t);
  bool has_changed = false;
  for (int round = 0; round < kMaxFlipRounds; ++round) {
    const std::size_t gone = std::erase_if(needles, [&](std::uint32_t needle) { return flips.flip(needle); });
    if (gone == 0) break;
    has_changed = true;
  }
  return has_changed;
}

}  // namespace algebra3d
