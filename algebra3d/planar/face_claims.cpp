#include "algebra3d/planar/face_claims.h"

#include <vector>

namespace algebra3d::planar {
namespace {

class ClaimFlood {
 public:
  ClaimFlood(const Subdivision& triangulation, std::span<const std::uint32_t> face_of_segment)
      : triangulation_(triangulation), face_of_segment_(face_of_segment), is_done_(triangulation.halfedge_count()) {}

  std::optional<ClaimConflict> run();

 private:
  /// The face that a marked half-edge says lies to its left; kNone for none.
  std::uint32_t claim(std::uint32_t h) const {
    const std::uint32_t mark = triangulation_.mark(h);
    return mark_has_inside(mark) ? face_of_segment_[segment_of_mark(mark)] : kNone;
  }
  std::optional<ClaimConflict> flood(std::uint32_t start);
  std::optional<ClaimConflict> flood_outside();
  void push(std::uint32_t triangle);

  static constexpr std::uint8_t kFound = 1, kOutside = 2;

  const Subdivision& triangulation_;
  std::span<const std::uint32_t> face_of_segment_;
  std::vector<std::uint8_t> is_done_;
  std::vector<std::uint32_t> open_;
};

void ClaimFlood::push(std::uint32_t triangle) {
  const std::uint32_t second = triangulation_.next(triangle);
  is_done_[triangle] = is_done_[second] = is_done_[triangulation_.next(second)] = kFound;
  open_.push_back(triangle);
}

std::optional<ClaimConflict> ClaimFlood::flood(std::uint32_t start) {
  const std::uint32_t face = claim(start);
  push(start);
  while (!open_.empty()) {
    const std::uint32_t triangle = open_.back();
    open_.pop_back();
    const std::uint32_t second = triangulation_.next(triangle);
    for (const std::uint32_t side : {triangle, second, triangulation_.next(second)}) {
      const std::uint32_t across = Subdivision::twin(side);
      if (triangulation_.mark(side) != 0) {
        if (claim(side) != face) return ClaimConflict{start, side};
      } else if (is_done_[across] == kOutside) {
        if (face != kNone) return ClaimConflict{start, kNone};
      } else if (is_done_[across] == 0) {
        push(across);
      }
    }
  }
  return std::nullopt;
}

std::optional<ClaimConflict> ClaimFlood::flood_outside() {
  const std::uint32_t first = triangulation_.outer_halfedge();
  if (first == kNone) return std::nullopt;
  std::uint32_t h = first;
  do {
    is_done_[h] = kOutside;
    if (triangulation_.mark(h) != 0 && claim(h) != kNone) return ClaimConflict{h, kNone};
    h = triangulation_.next(h);
  } while (h != first);
  return std::nullopt;
}

std::optional<ClaimConflict> ClaimFlood::run() {
  if (const auto conflict = flood_outside()) return conflict;
  for (std::uint32_t h = 0; h < triangulation_.halfedge_count(); ++h) {
    if (triangulation_.origin(h) == kNone || triangulation_.mark(h) == 0 || is_done_[h] != 0) continue;
    if (const auto conflict = flood(h)) return conflict;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ClaimConflict> find_claim_conflict(const Subdivision& triangulation,
                                                 std::span<const std::uint32_t> face_of_segment) {
  return ClaimFlood(triangulation, face_of_segment).run();
}

}  // namespace algebra3d::planar
