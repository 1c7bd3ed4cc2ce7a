#include "algebra3d/kernel/planar/detail/face_claims.h"

#include <vector>

#include "base/indices.h"

namespace algebra3d::planar {
namespace {

class ClaimFlood {
 public:
  ClaimFlood(const Subdivision& triangulation, IdSpan<SegmentId, const std::uint32_t> face_of_segment)
      : triangulation_(triangulation), face_of_segment_(face_of_segment), is_done_(triangulation.halfedges().size()) {}

  std::optional<ClaimConflict> run();

 private:
  /// The face that a marked half-edge says lies to its left; kNone for none.
  std::uint32_t claim(HalfedgeId h) const {
    const std::uint32_t mark = triangulation_.mark(h);
    return mark_has_inside(mark) ? face_of_segment_[segment_of_mark(mark)] : kNone;
  }
  std::optional<ClaimConflict> flood(HalfedgeId start);
  std::optional<ClaimConflict> flood_outside();
  void push(HalfedgeId triangle);

  static constexpr std::uint8_t kFound = 1, kOutside = 2;

  const Subdivision& triangulation_;
  IdSpan<SegmentId, const std::uint32_t> face_of_segment_;
  IdVector<HalfedgeId, std::uint8_t> is_done_;
  std::vector<HalfedgeId> open_;
};

void ClaimFlood::push(HalfedgeId triangle) {
  const HalfedgeId second = triangulation_.next(triangle);
  is_done_[triangle] = is_done_[second] = is_done_[triangulation_.next(second)] = kFound;
  open_.push_back(triangle);
}

std::optional<ClaimConflict> ClaimFlood::flood(HalfedgeId start) {
  const std::uint32_t face = claim(start);
  push(start);
  while (!open_.empty()) {
    const HalfedgeId triangle = open_.back();
    open_.pop_back();
    const HalfedgeId second = triangulation_.next(triangle);
    for (const HalfedgeId side : {triangle, second, triangulation_.next(second)}) {
      const HalfedgeId across = Subdivision::twin(side);
      if (triangulation_.mark(side) != 0) {
        if (claim(side) != face) return ClaimConflict{start, side};
      } else if (is_done_[across] == kOutside) {
        if (face != kNone) return ClaimConflict{start, {}};
      } else if (is_done_[across] == 0) {
        push(across);
      }
    }
  }
  return std::nullopt;
}

std::optional<ClaimConflict> ClaimFlood::flood_outside() {
  const HalfedgeId first = triangulation_.outer_halfedge();
  if (first.is_none()) return std::nullopt;
  HalfedgeId h = first;
  do {
    is_done_[h] = kOutside;
    if (triangulation_.mark(h) != 0 && claim(h) != kNone) return ClaimConflict{h, {}};
    h = triangulation_.next(h);
  } while (h != first);
  return std::nullopt;
}

std::optional<ClaimConflict> ClaimFlood::run() {
  if (const auto conflict = flood_outside()) return conflict;
  for (const HalfedgeId h : triangulation_.halfedges()) {
    if (triangulation_.is_taken_out(h) || triangulation_.mark(h) == 0 || is_done_[h] != 0) continue;
    if (const auto conflict = flood(h)) return conflict;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ClaimConflict> find_claim_conflict(const Subdivision& triangulation,
                                                 IdSpan<SegmentId, const std::uint32_t> face_of_segment) {
  return ClaimFlood(triangulation, face_of_segment).run();
}

}  // namespace algebra3d::planar
