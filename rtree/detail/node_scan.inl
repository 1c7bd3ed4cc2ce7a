// The scans of nodes for one instruction set, included by node_scan.cpp in a namespace of each. There are defined
// before: SCAN_TARGET, the attribute of functions for the instruction set; kLanes and kWideLanes, the numbers of keys
// and of doubles that are worked on at once; slots_of(Keys) and wide_slots_of(Signed), one bit for each lane that is
// -1; LEAST_LANE(Doubles); WIDENED(WideKeys), the keys as Signed; SHIFTED(before, here), the last lane of the one and
// all but the last of the other; CHOSEN(slots, a, b), the lanes of a whose bits are set, else those of b.

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

// The squared distances of the slots from `first` on. Of each slot only the side that faces the box counts: its
// position among the doubles is that of the box of the keys.
SCAN_TARGET inline void add_squares(const KeyBoxes& node, std::size_t first, const Target& target,
                                    const KeyFrame& frame, Doubles& sum) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    WideKeys low, high;
    __builtin_memcpy(&low, node.min[axis] + first, sizeof(low));
    __builtin_memcpy(&high, node.max[axis] + first, sizeof(high));
    const WideKeys above = low >= target.first_above[axis];
    const WideKeys key = (low & above) | (high & ~above);
    const auto is_above = (Unsigned)WIDENED(above);
    const AxisFrame& map = frame.axes[axis];
    const auto wide_key = (Unsigned)WIDENED(key);
    const Unsigned position = ((wide_key + static_cast<std::uint64_t>(map.base)) << map.shift) +
                              (~is_above & static_cast<std::uint64_t>(map.remainders()));
    const auto sign = (Unsigned)((Signed)position >> 63);
    const Unsigned bits = ((position ^ sign) - sign) | (sign & (std::uint64_t{1} << 63));
    const auto edge = (Doubles)bits;
    const Doubles gap = is_above ? edge - target.box.max[axis] : target.box.min[axis] - edge;
    const Doubles positive = gap > 0.0 ? gap : Doubles{};  // not where infinities were subtracted
    sum += positive * positive;
  }
}

SCAN_TARGET void squared_distances(const KeyBoxes& node, const Target& target, const KeyFrame& frame,
                                   double (&squares)[kFanOut]) {
  for (std::size_t first = 0; first < kFanOut; first += kWideLanes) {
    Doubles sum = {};
    add_squares(node, first, target, frame, sum);
    __builtin_memcpy(squares + first, &sum, sizeof(sum));
  }
}

constexpr std::int64_t kSlots[kFanOut] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

SCAN_TARGET SlotMask rank(const KeyBoxes& node, const Target& target, const KeyFrame& frame, double limit,
                          RankedSlots& ranked) {
  SlotMask slots = 0;
  for (std::size_t first = 0; first < kFanOut; first += kWideLanes) {
    WideKeys low;
    Signed lane;
    __builtin_memcpy(&low, node.min[0] + first, sizeof(low));
    __builtin_memcpy(&lane, kSlots + first, sizeof(lane));
    const Signed is_unused = WIDENED(low == INT32_MAX);
    Doubles sum = {};
    add_squares(node, first, target, frame, sum);
    sum = is_unused ? Doubles{} + RankedSlots::kFarthest : sum;
    const Signed bits = ((Signed)sum & ~std::int64_t{kFanOut - 1}) | lane;
    __builtin_memcpy(ranked.squares + first, &bits, sizeof(bits));
    slots |= wide_slots_of((sum <= limit) & ~is_unused) << first;
  }
  return slots;
}

// The square of a slot with the number of its node.
SCAN_TARGET inline double numbered(double square, std::uint64_t node) {
  constexpr std::uint64_t kOfNode = (NearestList::kMaxNodes - 1) * std::uint64_t{kFanOut};
  return __builtin_bit_cast(double, (__builtin_bit_cast(std::uint64_t, square) & ~kOfNode) | node * kFanOut);
}

// Puts a number in order without branches: each place gets the smaller of itself and the larger of the place before and
// the new number.
template <std::size_t groups>
SCAN_TARGET inline void put(const Doubles& number, Doubles (&list)[groups]) {
  for (std::size_t group = groups; group-- > 0;) {
    const Doubles before = group > 0 ? list[group - 1] : Doubles{};
    const Doubles shifted = SHIFTED(before, list[group]);
    const Doubles larger = shifted > number ? shifted : number;
    list[group] = list[group] < larger ? list[group] : larger;
  }
}

// A list that stays in registers meanwhile.
template <std::size_t size>
SCAN_TARGET inline void keep_short(const RankedSlots& ranked, SlotMask slots, std::uint32_t node, NearestList& list) {
  Doubles groups[size / kWideLanes];
  for (std::size_t group = 0; group < size / kWideLanes; ++group)
    __builtin_memcpy(&groups[group], list.squares + group * kWideLanes, sizeof(Doubles));
  while (slots != 0) put(Doubles{} + numbered(ranked.squares[take_slot(slots)], node), groups);
  for (std::size_t group = 0; group < size / kWideLanes; ++group)
    __builtin_memcpy(list.squares + group * kWideLanes, &groups[group], sizeof(Doubles));
}

SCAN_TARGET void keep(const RankedSlots& ranked, SlotMask slots, std::uint32_t node, NearestList& list,
                      std::size_t size) {
  if (size == 8) return keep_short<8>(ranked, slots, node, list);
  if (size == 16) return keep_short<16>(ranked, slots, node, list);
  while (slots != 0) {
    const Doubles square = Doubles{} + numbered(ranked.squares[take_slot(slots)], node);
    for (std::size_t group = size; group > 0; group -= kWideLanes) {
      Doubles here, before = {};
      __builtin_memcpy(&here, list.squares + group - kWideLanes, sizeof(here));
      if (group > kWideLanes) __builtin_memcpy(&before, list.squares + group - 2 * kWideLanes, sizeof(before));
      const Doubles shifted = SHIFTED(before, here);
      const Doubles larger = shifted > square ? shifted : square;
      const Doubles kept = here < larger ? here : larger;
      __builtin_memcpy(list.squares + group - kWideLanes, &kept, sizeof(kept));
    }
  }
}

// By counting for each how many are less: without branches, and in any order.
SCAN_TARGET SlotMask nearest(const RankedSlots& ranked, std::size_t count) {
  SlotMask slots = 0;
  for (std::size_t first = 0; first < kFanOut; first += kWideLanes) {
    Doubles squares;
    __builtin_memcpy(&squares, ranked.squares + first, sizeof(squares));
    Signed less = {};
    for (const double square : ranked.squares) less += square < squares;  // true is -1
    slots |= wide_slots_of(less > -static_cast<std::int64_t>(count)) << first;
  }
  return slots;
}

SCAN_TARGET double least(const RankedSlots& ranked, SlotMask slots) {
  const Doubles farthest = Doubles{} + RankedSlots::kFarthest;
  Doubles low = farthest;
  for (std::size_t first = 0; first < kFanOut; first += kWideLanes) {
    Doubles other;
    __builtin_memcpy(&other, ranked.squares + first, sizeof(other));
    other = CHOSEN(slots >> first, other, farthest);
    low = first == 0 ? other : (other < low ? other : low);
  }
  return LEAST_LANE(low);
}

// The compiler makes vectors of it.
SCAN_TARGET KeyBox bounds(const KeyBoxes& node) {
  KeyBox result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t low = INT32_MAX, high = INT32_MIN;
    for (std::size_t slot = 0; slot < kFanOut; ++slot) {
      low = node.min[axis][slot] < low ? node.min[axis][slot] : low;
      high = node.max[axis][slot] > high ? node.max[axis][slot] : high;
    }
    result.min[axis] = low;
    result.max[axis] = high;
  }
  return result;
}

constexpr NodeScans kScans = {meeting, meeting_exactly, meeting_rows, squared_distances, rank, keep, nearest, least, bounds};
