#pragma once

#include <span>

#include "rtree/detail/node.h"

namespace rtree {

/// The target of a search: the keys to compare with, and the coordinates for distances.
struct Target {
  Box3 box;
  OrderedBox exact;
  KeyBox keys;
  /// Keys from here on are above the box on this axis. The first key is above everything before the frame.
  std::int32_t first_above[3];

  Target(const Box3& asked, const KeyFrame& frame) : box(asked), exact(OrderedBox::of(asked)), keys(frame.keys(exact)) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      first_above[axis] = exact.max[axis] < frame.axes[axis].first() ? INT32_MIN : keys.max[axis] + 1;
  }
};

/// The slots of a node that meet a box: the upper 16 bits have those for which keys do not prove it.
struct Meeting {
  std::uint32_t bits;

  SlotMask slots() const { return bits & 0xffff; }
  SlotMask open() const { return bits >> 16; }
};

/// Lower bounds of squared distances, each with its slot in the lowest four bits: so the least of them names its slot.
/// Those of unused slots are kFarthest at least.
struct alignas(64) RankedSlots {
  static constexpr double kFarthest = 0x1p1023;

  double squares[kFanOut];

  static std::size_t slot(double square) { return std::bit_cast<std::uint64_t>(square) % kFanOut; }
};

/// The least squared distances, ascending, each with the number of its node and its slot in the lowest bits.
struct alignas(64) NearestList {
  static constexpr std::size_t kGrain = 8;     ///< its length is a multiple of it
  static constexpr std::size_t kMaxSize = 72;  ///< largest length
  static constexpr std::uint32_t kMaxNodes = 256;

  double squares[kMaxSize];

  static std::size_t node(double square) { return std::bit_cast<std::uint64_t>(square) / kFanOut % kMaxNodes; }
};

/// The scans of nodes, in the widest vectors that the processor has. All give the same results.
struct NodeScans {
  /// The slots that may meet the box.
  SlotMask (*meeting)(const KeyBoxes& node, const KeyBox& box);
  /// The slots that may meet the box, and which of them need an exact comparison.
  Meeting (*meeting_exactly)(const KeyBoxes& node, const KeyBox& box);
  /// `meetings[row]` for each of the rows: the slots of `second` that meet the slot `row` of `first`.
  void (*meeting_rows)(const KeyBoxes& first, SlotMask rows, const KeyBoxes& second, Meeting (&meetings)[kFanOut]);
  /// Lower bounds of the squared distances of the slots from the box. Unused slots get any number.
  void (*squared_distances)(const KeyBoxes& node, const Target& target, const KeyFrame& frame,
                            double (&squares)[kFanOut]);
  /// Ranks the slots by these bounds, which are rounded down to make room for the slots' numbers; returns the slots
  /// whose bounds are at most `limit`. Domain: coordinates whose squares do not overflow.
  SlotMask (*rank)(const KeyBoxes& node, const Target& target, const KeyFrame& frame, double limit,
                   RankedSlots& ranked);
  /// Puts those of the slots of the `node`-th node into the first `size` places of a list, of which the largest numbers
  /// fall out.
  void (*keep)(const RankedSlots& ranked, SlotMask slots, std::uint32_t node, NearestList& list, std::size_t size);
  /// The slots with the `count` least of the ranked squares.
  SlotMask (*nearest)(const RankedSlots& ranked, std::size_t count);
  /// The least of the ranked squares of the slots; kFarthest if there are none.
  double (*least)(const RankedSlots& ranked, SlotMask slots);
  /// The box around the boxes of all slots.
  KeyBox (*bounds)(const KeyBoxes& node);
};

/// The scans for this processor.
const NodeScans& node_scans();

/// All that can run here, for tests; plain code first.
std::size_t available_scans(const NodeScans* (&scans)[4]);

}  // namespace rtree
