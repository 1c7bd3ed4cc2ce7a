// The scans of nodes for one instruction set, included by node_scan.cpp in a namespace of each. There are defined
// before: SCAN_TARGET, the attribute of functions for the instruction set; kLanes and kWideLanes, the numbers of keys
// and of doubles that are worked on at once; slots_of(Keys), one bit for each lane that is -1.

constexpr std::size_t kGroups = kFanOut / kLanes;

SCAN_TARGET inline Keys load(const std::int32_t* keys) {
  Keys result;
  __builtin_memcpy(&result, keys, sizeof(result));
  return result;
}

// The lanes of a group that do not meet the box.
SCAN_TARGET inline Keys missing(const KeyBoxes& node, std::size_t first, const KeyBox& box) {
  const Keys x = (load(node.min[0] + first) > box.max[0]) | (load(node.max[0] + first) < box.min[0]);
  const Keys y = (load(node.min[1] + first) > box.max[1]) | (load(node.max[1] + first) < box.min[1]);
  const Keys z = (load(node.min[2] + first) > box.max[2]) | (load(node.max[2] + first) < box.min[2]);
  return x | y | z;
}

// The lanes of a group for which a key is equal to that of the box on the other side.
SCAN_TARGET inline Keys touching(const KeyBoxes& node, std::size_t first, const KeyBox& box) {
  const Keys x = (load(node.min[0] + first) == box.max[0]) | (load(node.max[0] + first) == box.min[0]);
  const Keys y = (load(node.min[1] + first) == box.max[1]) | (load(node.max[1] + first) == box.min[1]);
  const Keys z = (load(node.min[2] + first) == box.max[2]) | (load(node.max[2] + first) == box.min[2]);
  return x | y | z;
}

SCAN_TARGET SlotMask meeting(const KeyBoxes& node, const KeyBox& box) {
  SlotMask slots = 0;
  for (std::size_t group = 0; group < kGroups; ++group)
    slots |= slots_of(~missing(node, group * kLanes, box)) << (group * kLanes);
  return slots;
}

SCAN_TARGET Meeting meeting_exactly(const KeyBoxes& node, const KeyBox& box) {
  SlotMask slots = 0, open = 0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::size_t first = group * kLanes;
    slots |= slots_of(~missing(node, first, box)) << first;
    open |= slots_of(touching(node, first, box)) << first;
  }
  return {slots | (open & slots) << kFanOut};
}

SCAN_TARGET void meeting_rows(const KeyBoxes& first, SlotMask rows, const KeyBoxes& second,
                              Meeting (&meetings)[kFanOut]) {
  while (rows != 0) {
    const std::size_t row = take_slot(rows);
    meetings[row] = meeting_exactly(second, first.box(row));
  }
}

// Of each slot only the side that faces the box counts: its position among the doubles is that of the box of the keys.
SCAN_TARGET void squared_distances(const KeyBoxes& node, const Target& target, const KeyFrame& frame,
                                   double (&squares)[kFanOut]) {
  for (std::size_t first = 0; first < kFanOut; first += kWideLanes) {
    Doubles sum = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      WideKeys low, high;
      __builtin_memcpy(&low, node.min[axis] + first, sizeof(low));
      __builtin_memcpy(&high, node.max[axis] + first, sizeof(high));
      const WideKeys above = low > target.keys.max[axis];
      const WideKeys key = (low & above) | (high & ~above);
      const auto is_above = __builtin_convertvector(__builtin_convertvector(above, Signed), Unsigned);
      const AxisFrame& map = frame.axes[axis];
      const auto wide_key = __builtin_convertvector(__builtin_convertvector(key, Signed), Unsigned);
      const Unsigned position = ((wide_key + static_cast<std::uint64_t>(map.base)) << map.shift) +
                                (~is_above & static_cast<std::uint64_t>(map.remainders()));
      const auto sign = __builtin_convertvector(__builtin_convertvector(position, Signed) >> 63, Unsigned);
      const Unsigned bits = ((position ^ sign) - sign) | (sign & (std::uint64_t{1} << 63));
      Doubles edge;
      __builtin_memcpy(&edge, &bits, sizeof(edge));
      const Doubles gap = is_above ? edge - target.box.max[axis] : target.box.min[axis] - edge;
      const Doubles positive = gap > 0.0 ? gap : Doubles{};  // not where infinities were subtracted
      sum += positive * positive;
    }
    __builtin_memcpy(squares + first, &sum, sizeof(sum));
  }
}

constexpr NodeScans kScans = {meeting, meeting_exactly, meeting_rows, squared_distances};
