#include "algebra3d/kernel/planar/detail/inside_triangles.h"

#include <algorithm>
#include <array>

namespace algebra3d::planar {

bool mark_segment(Subdivision& triangulation, HalfedgeId halfedge, SegmentId segment) {
  if (mark_has_inside(triangulation.mark(halfedge))) return false;
  const HalfedgeId twin = Subdivision::twin(halfedge);
  triangulation.set_mark(halfedge, segment_mark(segment, true));
  if (triangulation.mark(twin) == 0) triangulation.set_mark(twin, segment_mark(segment, false));
  return true;
}

namespace {

class InsideFlood {
 public:
  explicit InsideFlood(const Subdivision& triangulation)
      : triangulation_(triangulation), is_done_(triangulation.halfedges().size()) {}

  InsideTriangles run();

 private:
  bool flood(HalfedgeId start);
  void push(HalfedgeId triangle);
  bool visit(HalfedgeId triangle);
  void close_off_outside();

  static constexpr std::uint8_t kFound = 1, kOutside = 2;

  const Subdivision& triangulation_;
  IdVector<HalfedgeId, std::uint8_t>
      is_done_;  // of each half-edge: whether its triangle has been found, or is unbounded
  std::vector<HalfedgeId> open_;
  InsideTriangles found_;
};

void InsideFlood::push(HalfedgeId triangle) {
  const HalfedgeId second = triangulation_.next(triangle);
  is_done_[triangle] = is_done_[second] = is_done_[triangulation_.next(second)] = kFound;
  open_.push_back(triangle);
}

/// Adds a triangle and goes on across its edges. False if the inside does not end where it has to.
bool InsideFlood::visit(HalfedgeId triangle) {
  const Subdivision& t = triangulation_;
  const HalfedgeId second = t.next(triangle), third = t.next(second);
  found_.halfedges.push_back(triangle);
  found_.corners.push_back({t.origin(triangle), t.origin(second), t.origin(third)});
  return std::ranges::all_of(std::array{triangle, second, third}, [&](HalfedgeId side) {
    const std::uint32_t mark = t.mark(side);
    const HalfedgeId across = Subdivision::twin(side);
    if (mark_has_inside(mark)) return true;
    if (mark != 0 || is_done_[across] == kOutside) {
      found_.wrong_halfedge = side;
      return false;
    }
    if (is_done_[across] == 0) push(across);
    return true;
  });
}

bool InsideFlood::flood(HalfedgeId start) {
  push(start);
  while (!open_.empty()) {
    const HalfedgeId triangle = open_.back();
    open_.pop_back();
    if (!visit(triangle)) return false;
  }
  found_.patch_ends.push_back(static_cast<std::uint32_t>(found_.halfedges.size()));
  return true;
}

void InsideFlood::close_off_outside() {
  const HalfedgeId first = triangulation_.outer_halfedge();
  if (first.is_none()) return;
  HalfedgeId h = first;
  do {
    is_done_[h] = kOutside;
    h = triangulation_.next(h);
  } while (h != first);
}

InsideTriangles InsideFlood::run() {
  close_off_outside();
  for (const HalfedgeId h : triangulation_.halfedges()) {
    if (triangulation_.is_taken_out(h) || !mark_has_inside(triangulation_.mark(h)) || is_done_[h] == kFound) continue;
    if (is_done_[h] == kOutside) {
      found_.wrong_halfedge = h;
      break;
    }
    if (!flood(h)) break;
  }
  return std::move(found_);
}

}  // namespace

InsideTriangles find_inside(const Subdivision& triangulation) {
  return InsideFlood(triangulation).run();
}

}  // namespace algebra3d::planar
