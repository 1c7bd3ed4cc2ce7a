#include "algebra3d/kernel/planar/detail/delaunay.h"

#include <vector>

#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::planar {
namespace {

/// The vertex that follows so many places behind another one.
VertexId behind(VertexId vertex, std::uint32_t places) {
  return VertexId(vertex.index() + places);
}

/// A triangulated set: the half-edges of its hull that leave its first vertex counter-clockwise and its last one
/// clockwise, in the order by which the sets are put together.
struct DelaunayPart {
  HalfedgeId ccw_of_first = {}, cw_of_last = {};
};

class DelaunayBuilder {
 public:
  explicit DelaunayBuilder(const PlanePoints& points) : points_(points), result_(points.size()) {}

  /// Vertices that follow each other from bottom to top, two at least.
  DelaunayPart strip(VertexId begin, VertexId end);
  /// All of `parts`, which is not empty.
  DelaunayPart merge_all(std::vector<DelaunayPart>& parts);
  Subdivision take(const DelaunayPart& all);

 private:
  DelaunayPart two(VertexId a);
  DelaunayPart three(VertexId a);
  DelaunayPart merge(DelaunayPart left, DelaunayPart right);
  void find_lower_tangent(HalfedgeId& left, HalfedgeId& right) const;
  void sew(HalfedgeId base);
  DelaunayPart from_left_to_right(HalfedgeId ccw_hull) const;

  bool is_left(VertexId v, HalfedgeId h) const { return points_.turn(v, result_.origin(h), result_.target(h)) > 0; }
  bool is_right(VertexId v, HalfedgeId h) const { return points_.turn(v, result_.target(h), result_.origin(h)) > 0; }

  const PlanePoints& points_;
  Subdivision result_;
};

DelaunayPart DelaunayBuilder::two(VertexId a) {
  const HalfedgeId h = result_.add(a, behind(a, 1));
  return {h, Subdivision::twin(h)};
}

DelaunayPart DelaunayBuilder::three(VertexId a) {
  const VertexId b = behind(a, 1), c = behind(a, 2);
  const HalfedgeId h = result_.add(a, b), g = result_.add(b, c);
  result_.splice(Subdivision::twin(h), g);
  const int turn = points_.turn(a, b, c);
  if (turn == 0) return {h, Subdivision::twin(g)};
  const HalfedgeId closing = result_.connect(g, h);
  if (turn > 0) return {h, Subdivision::twin(g)};
  return {Subdivision::twin(closing), closing};
}

/// Moves from the last hull edge on the left and the first one on the right down to the edges between which the hulls
/// are joined from below.
void DelaunayBuilder::find_lower_tangent(HalfedgeId& left, HalfedgeId& right) const {
  for (;;) {
    poll_interruption();
    if (is_left(result_.origin(right), left))
      left = result_.next(left);
    else if (is_right(result_.origin(left), right))
      right = result_.ccw(Subdivision::twin(right));
    else
      return;
  }
}

/// Joins the parts upwards from the edge `base`, which runs from the right part to the left one.
void DelaunayBuilder::sew(HalfedgeId base) {
  for (;;) {
    poll_interruption();
    const VertexId left_vertex = result_.target(base), right_vertex = result_.origin(base);
    const auto is_above = [&](HalfedgeId h) { return points_.turn(result_.target(h), left_vertex, right_vertex) > 0; };
    HalfedgeId left = result_.ccw(Subdivision::twin(base)), right = result_.cw(base);
    const bool has_left = is_above(left), has_right = is_above(right);
    if (!has_left && !has_right) return;
    if (has_left) {
      for (HalfedgeId after = result_.ccw(left);
           points_.is_in_circle(left_vertex, right_vertex, result_.target(left), result_.target(after));
           after = result_.ccw(left)) {
        result_.remove(left);
        left = after;
      }
    }
    if (has_right) {
      for (HalfedgeId after = result_.cw(right);
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
  HalfedgeId from_left = left.cw_of_last, from_right = right.ccw_of_first;
  find_lower_tangent(from_left, from_right);
  const HalfedgeId base = result_.connect(Subdivision::twin(from_right), from_left);
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

/// The hull with its first and last vertices by x instead of by y.
DelaunayPart DelaunayBuilder::from_left_to_right(HalfedgeId ccw_hull) const {
  HalfedgeId first = ccw_hull, last = ccw_hull;
  for (HalfedgeId h = result_.ccw(Subdivision::twin(ccw_hull)); h != ccw_hull; h = result_.ccw(Subdivision::twin(h))) {
    if (points_.is_before(result_.origin(h), result_.origin(first))) first = h;
    if (points_.is_before(result_.target(last), result_.target(h))) last = h;
  }
  return {first, Subdivision::twin(last)};
}

DelaunayPart DelaunayBuilder::strip(VertexId begin, VertexId end) {
  const std::uint32_t count = end.index() - begin.index(), group_count = (count + 2) / 3;
  std::vector<DelaunayPart> parts(group_count);
  for (std::uint32_t i = 0; i < group_count; ++i) {
    const auto start_of = [&](std::uint64_t group) { return static_cast<std::uint32_t>(group * count / group_count); };
    parts[i] = start_of(i + 1) - start_of(i) == 2 ? two(behind(begin, start_of(i))) : three(behind(begin, start_of(i)));
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
  VertexId begin(0);
  for (const VertexId end : points.strip_ends()) {
    A3D_TRY(monitor.check());
    strips.push_back(builder.strip(begin, end));
    begin = end;
  }
  return builder.take(builder.merge_all(strips));
}

}  // namespace algebra3d::planar
