// A line sweeps over the plane, from left to right and upwards within one vertical line. The status is the list of the
// edges that cross it, from bottom to top. At each end point of edges,
// (1) the edges that end there are next to each other in the status,
// (2) the edges before and after these pass strictly below and above the point,
// (3) the edges that begin there leave it in different directions, and are inserted in their order.
// So any two edges that are next to each other for a while are in order when this begins and when it ends, and, since
// they are straight, in between: no two edges cross, however the places in the status were found. Edges that enter the
// region (which lies to the left of an edge) and edges that leave it alternate, which gives the winding numbers.

#include "algebra3d/kernel/validity/detail/simple_boundary.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

bool is_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

int turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d(Projection::xy, a, b, c);
}

/// An edge from its lower to its higher end point in the order of the sweep.
struct SweptEdge {
  explicit SweptEdge(const PlanarEdge& edge) : begin(edge.from), end(edge.to), enters(is_before(begin, end)) {
    if (!enters) std::swap(begin, end);
  }
  int side(const Vec3& point) const { return turn(begin, end, point); }

  Vec3 begin, end;
  bool enters;  // the region is above it
};

class Sweep {
 public:
  explicit Sweep(const std::vector<PlanarEdge>& edges) : edges_(edges.begin(), edges.end()), ends_(edges.size()) {
    std::ranges::sort(edges_, [](const SweptEdge& a, const SweptEdge& b) { return is_before(a.begin, b.begin); });
    std::iota(ends_.begin(), ends_.end(), 0U);
    std::ranges::sort(ends_, [&](std::uint32_t a, std::uint32_t b) { return is_before(edges_[a].end, edges_[b].end); });
  }

  bool run() {
    while (next_end_ < ends_.size()) {
      const Vec3& end = edges_[ends_[next_end_]].end;
      const bool begins = next_begin_ < edges_.size() && is_before(edges_[next_begin_].begin, end);
      if (!pass(begins ? edges_[next_begin_].begin : end)) return false;
    }
    return true;
  }

 private:
  using Place = std::vector<std::uint32_t>::difference_type;

  /// Moves the sweep line over an end point; false if the conditions do not hold there.
  bool pass(const Vec3 point) {
    const auto is_below = [&](std::uint32_t edge) { return edges_[edge].side(point) > 0; };
    const auto first = std::ranges::partition_point(status_, is_below);
    auto last = first;
    for (; next_end_ < ends_.size() && edges_[ends_[next_end_]].end == point; ++next_end_, ++last)
      if (last == status_.end() || edges_[*last].end != point) return false;
    if (first != status_.begin() && !is_below(*(first - 1))) return false;
    if (last != status_.end() && edges_[*last].side(point) >= 0) return false;
    return begin_edges(point) && replace(first - status_.begin(), last - status_.begin());
  }

  /// The edges that begin at a point, from bottom to top; false if two have the same direction.
  bool begin_edges(const Vec3& point) {
    beginning_.clear();
    for (; next_begin_ < edges_.size() && edges_[next_begin_].begin == point; ++next_begin_)
      beginning_.push_back(static_cast<std::uint32_t>(next_begin_));
    const auto is_lower = [&](std::uint32_t a, std::uint32_t b) {
      return turn(point, edges_[a].end, edges_[b].end) > 0;
    };
    std::ranges::sort(beginning_, is_lower);
    const auto is_not_lower = [&](std::uint32_t a, std::uint32_t b) { return !is_lower(a, b); };
    return std::ranges::adjacent_find(beginning_, is_not_lower) == beginning_.end();
  }

  /// Puts the edges that begin in the place of those that end; false if entering and leaving edges do not alternate.
  bool replace(Place first, Place last) {
    const auto count = static_cast<Place>(beginning_.size());
    if ((last - first - count) % 2 != 0) return false;
    for (Place i = 0; i < count; ++i)
      if (edges_[beginning_[static_cast<std::size_t>(i)]].enters != ((first + i) % 2 == 0)) return false;
    const Place common = std::min(count, last - first);
    std::copy_n(beginning_.begin(), common, status_.begin() + first);
    if (count > common)
      status_.insert(status_.begin() + last, beginning_.begin() + common, beginning_.end());
    else
      status_.erase(status_.begin() + first + common, status_.begin() + last);
    return true;
  }

  std::vector<SweptEdge> edges_;     // by their beginnings
  std::vector<std::uint32_t> ends_;  // the edges by their ends
  std::size_t next_begin_ = 0, next_end_ = 0;
  std::vector<std::uint32_t> status_, beginning_;
};

}  // namespace

bool bounds_simple_region(const std::vector<PlanarEdge>& edges) {
  return Sweep(edges).run();
}

}  // namespace algebra3d
