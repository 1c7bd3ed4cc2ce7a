#include "algebra3d/planar/delaunay.h"

#include <vector>

namespace algebra3d::planar {
namespace {

/// A triangulated set: the half-edges of its hull that leave its first vertex counter-clockwise and its last one
/// clockwise, in the order by which the sets are put together.
struct DelaunayPart {
  std::uint32_t ccw_of_first = kNone, cw_of_last = kNone;
};

class DelaunayBuilder {
 public:
  explicit DelaunayBuilder(const PlanePoints& points) : points_(points), result_(points.size()) {}

  /// Vertices that follow each other from bottom to top, two at least.
  DelaunayPart strip(std::uint32_t begin, std::uint32_t end);
  /// All of `parts`, which is not empty.
  DelaunayPart merge_all(std::vector<DelaunayPart>& parts);
  Subdivision take(const DelaunayPart& all);

 private:
  DelaunayPart two(std::uint32_t a);
  DelaunayPart three(std::uint32_t a);
  DelaunayPart merge(DelaunayPart left, DelaunayPart right);
  void find_lower_tangent(std::uint32_t& left, std::uint32_t& right) const;
  void sew(std::uint32_t base);
  DelaunayPart from_left_to_right(std::uint32_t ccw_hull) const;

  bool is_left(std::uint32_t v, std::uint32_t h) const {
    return points_.turn(v, result_.origin(h), result_.target(h)) > 0;
  }
  bool is_right(std::uint32_t v, std::uint32_t h) const {
    return points_.turn(v, result_.target(h), result_.origin(h)) > 0;
  }

  const PlanePoints& points_;
  Subdivision result_;
};

DelaunayPart DelaunayBuilder::two(std::uint32_t a) {
  const std::uint32_t h = result_.add(a, a + 1);
  return {h, Subdivision::twin(h)};
}

DelaunayPart DelaunayBuilder::three(std::uint32_t a) {
  const std::uint32_t h = result_.add(a, a + 1), g = result_.add(a + 1, a + 2);
  result_.splice(Subdivision::twin(h), g);
  const int turn = points_.turn(a, a + 1, a + 2);
  if (turn == 0) return {h, Subdivision::twin(g)};
  const std::uint32_t closing = result_.connect(g, h);
  if (turn > 0) return {h, Subdivision::twin(g)};
  return {Subdivision::twin(closing), closing};
}

/// Moves from the last hull edge on the left and the first one on the right down to the edges between which the hulls
/// are joined from below.
void DelaunayBuilder::find_lower_tangent(std::uint32_t& left, std::uint32_t& right) const {
  for (;;) {
    if (is_left(result_.origin(right), left))
      left = result_.next(left);
    else if (is_right(result_.origin(left), right))
      right = result_.ccw(Subdivision::twin(right));
    else
      return;
  }
}

/// Joins the parts upwards from the edge `base`, which runs from the right part to the left one.
void DelaunayBuilder::sew(std::uint32_t base) {
  for (;;) {
    const std::uint32_t left_vertex = result_.target(base), right_vertex = result_.origin(base);
    const auto is_above = [&](std::uint32_t h) {
      return points_.turn(result_.target(h), left_vertex, right_vertex) > 0;
    };
    std::uint32_t left = result_.ccw(Subdivision::twin(base)), right = result_.cw(base);
    const bool has_left = is_above(left), has_right = is_above(right);
    if (!has_left && !has_right) return;
    if (has_left) {
      for (std::uint32_t after = result_.ccw(left);
           points_.is_in_circle(left_vertex, right_vertex, result_.target(left), result_.target(after));
           after = result_.ccw(left)) {
        result_.remove(left);
        left = after;
      }
    }
    if (has_right) {
      for (std::uint32_t after = result_.cw(right);
           points_.is_in_circle(left_vertex, right_vertex, result_.target(right), result_.target(after));
           after = result_.cw(right)) {
        result_.remove(right);
        right = after;
      }
    }
    const bool takes_right = !has_left || (has_right && points_.is_in_circle(result_.target(left), left_vertex,
                                                                             right_vertex, result_.target(right)));
    base = takes_right ? result_.connect(right, Subdivision::twin(base))
                       : result_.connect(Subdivision::twin(base), Subdivision::twin(left));
  }
}

DelaunayPart DelaunayBuilder::merge(DelaunayPart left, DelaunayPart right) {
  std::uint32_t from_left = left.cw_of_last, from_right = right.ccw_of_first;
  find_lower_tangent(from_left, from_right);
  const std::uint32_t base = result_.connect(Subdivision::twin(from_right), from_left);
  DelaunayPart merged{left.ccw_of_first, right.cw_of_last};
  if (result_.origin(from_left) == result_.origin(left.ccw_of_first)) merged.ccw_of_first = Subdivision::twin(base);
  if (result_.origin(from_right) == result_.origin(right.cw_of_last)) merged.cw_of_last = base;
  sew(base);
  return merged;
}

DelaunayPart DelaunayBuilder::merge_all(std::vector<DelaunayPart>& parts) {
  while (parts.size() > 1) {
    const std::size_t count = parts.size();
    for (std::size_t i = 0; i + 1 < count; i += 2) parts[i / 2] = merge(parts[i], parts[i + 1]);
    if (count % 2 == 1) parts[count / 2] = parts[count - 1];
    parts.resize((count + 1) / 2);
  }
  return parts.front();
}

/// The same hull, with its first and last vertices by x instead of by y.
DelaunayPart DelaunayBuilder::from_left_to_right(std::uint32_t ccw_hull) const {
  std::uint32_t first = ccw_hull, last = ccw_hull;
  for (std::uint32_t h = result_.ccw(Subdivision::twin(ccw_hull)); h != ccw_hull;
       h = result_.ccw(Subdivision::twin(h))) {
    if (points_.is_before(result_.origin(h), result_.origin(first))) first = h;
    if (points_.is_before(result_.target(last), result_.target(h))) last = h;
  }
  return {first, Subdivision::twin(last)};
}

DelaunayPart DelaunayBuilder::strip(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t count = end - begin, group_count = (count + 2) / 3;
  std::vector<DelaunayPart> parts(group_count);
  for (std::uint32_t i = 0; i < group_count; ++i) {
    const auto start_of = [&](std::uint64_t group) {
      return begin + static_cast<std::uint32_t>(group * count / group_count);
    };
    parts[i] = start_of(i + 1) - start_of(i) == 2 ? two(start_of(i)) : three(start_of(i));
  }
  return from_left_to_right(merge_all(parts).ccw_of_first);
}

Subdivision DelaunayBuilder::take(const DelaunayPart& all) {
  result_.set_outer_halfedge(all.cw_of_last);
  result_.link_vertices();
  return std::move(result_);
}

}  // namespace

Result<Subdivision> delaunay(const PlanePoints& points, const Monitor& monitor) {
  if (points.size() < 2) return Subdivision(points.size());
  DelaunayBuilder builder(points);
  std::vector<DelaunayPart> strips;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : points.strip_ends()) {
    RETURN_IF_ERROR(monitor.check());
    strips.push_back(builder.strip(begin, end));
    begin = end;
  }
  return builder.take(builder.merge_all(strips));
}

}  // namespace algebra3d::planar
