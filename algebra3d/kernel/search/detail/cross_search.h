#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// The leaves of another hierarchy that were visited last, in the frame of this one: a leaf meets some leaves that
/// follow one another soon.
class BoxHierarchy::ChangedLeaves {
 public:
  ChangedLeaves(const BoxHierarchy& other, const FrameChange& change)
      : other_(other), change_(change), leaves_(std::min(kPlaces, other.leaf_count())) {}

  /// Valid until the next call.
  const ChangedLeaf& get(std::uint32_t leaf) {
    ChangedLeaf& known = leaves_[leaf % leaves_.size()];
    if (known.index != leaf) fill(known, leaf);
    return known;
  }

 private:
  static constexpr std::size_t kPlaces = 32;

  void fill(ChangedLeaf& place, std::uint32_t leaf) const {
    place.index = leaf;
    place.box = changed(change_, other_.levels_[0].boxes[leaf]);
    const std::size_t begin = leaf * kLeafSize, count = other_.leaf_faces(leaf).size();
    for (std::size_t i = 0; i < count; ++i) place.face_boxes[i] = changed(change_, other_.face_boxes_[begin + i]);
  }

  const BoxHierarchy& other_;
  const FrameChange& change_;
  std::vector<ChangedLeaf> leaves_;  // each at the place that its number gives
};

/// In the order of the search: children with high numbers first.
inline void BoxHierarchy::open(const BoxHierarchy& other, const FrameChange& change, CrossLevel::Pair pair,
                               Opened opened, CrossLevel& below, LastOpened& last) const {
  const std::span<const Box> own_boxes(levels_[below.own_level].boxes);
  const std::span<const Box> other_boxes(other.levels_[below.other_level].boxes);
  const auto children = [](std::uint32_t node, bool is_opened, std::size_t count) {
    const std::uint32_t begin = is_opened ? 2 * node : node, end = begin + (is_opened ? 2 : 1);
    return std::pair(begin, std::min(end, static_cast<std::uint32_t>(count)));
  };
  const auto [own_begin, own_end] = children(pair.own, opened.own, own_boxes.size());
  const auto [other_begin, other_end] = children(pair.other, opened.other, other_boxes.size());
  if (last.level != below.other_level || last.begin != other_begin || last.end != other_end) {
    last = {below.other_level, other_begin, other_end, {}};
    for (std::uint32_t j = other_begin; j < other_end; ++j)
      last.boxes[j - other_begin] = changed(change, other_boxes[j]);
  }
  // No branch: whether boxes meet is unpredictable.
  std::size_t size = below.pairs.size();
  below.pairs.resize(size + 4);
  for (std::uint32_t j = other_end; j-- > other_begin;) {
    const Box& box = last.boxes[j - other_begin];
    for (std::uint32_t i = own_end; i-- > own_begin;) {
      below.pairs[size] = {i, j};
      size += static_cast<std::size_t>(own_boxes[i].meets(box));
    }
  }
  below.pairs.resize(size);
}

template <typename Visit>
bool BoxHierarchy::visit_cross_leaves(std::uint32_t leaf, const ChangedLeaf& of_other,
                                      std::span<const std::uint32_t> other_faces, Visit& visit) const {
  std::array<std::uint32_t, kLeafSize> own_positions{}, other_positions{};
  const std::span<const std::uint32_t> own_reaching = reaching(leaf, of_other.box, own_positions);
  const Box box = levels_[0].boxes[leaf];
  std::size_t other_count = 0;
  for (std::uint32_t i = 0; i < other_faces.size(); ++i) {
    other_positions[other_count] = i;
    other_count += static_cast<std::size_t>(box.meets(of_other.face_boxes[i]));
  }
  for (const std::uint32_t i : std::span(other_positions).first(other_count))
    for (const std::uint32_t position : own_reaching)
      if (of_other.face_boxes[i].meets(face_boxes_[position]) && !visit(faces_[position], other_faces[i])) return false;
  return true;
}

/// Pairs go down level by level, some hundred at a time: the findings of one level are a list, in which nothing must be
/// predicted. One after the other they would be taken from a stack, and whether the next one has children is
/// unpredictable.
template <typename Visit, typename Apart, typename Pause>
void BoxHierarchy::for_each_pair_with(const BoxHierarchy& other, Visit visit, Apart are_apart, Pause pause,
                                      Share share) const {
  constexpr std::size_t kPairsAtATime = 256;
  if (faces_.empty() || other.faces_.empty()) return;
  const FrameChange change = change_from(other);
  struct Depth {
    CrossLevel level;
    std::size_t done = 0;  ///< number of its pairs that are opened
  };
  std::vector<Depth> depths{{cross_roots(other, change)}};
  while (depths.back().level.own_level + depths.back().level.other_level > 0)
    depths.push_back({level_below(depths.back().level, opened_below(depths.back().level))});
  std::vector<CrossLevel::Pair>& roots = depths[0].level.pairs;
  std::size_t number = roots.size();
  std::erase_if(roots, [&](const CrossLevel::Pair&) { return --number % share.count != share.index; });
  ChangedLeaves changed_leaves(other, change);
  LastOpened last_opened;
  for (std::size_t depth = 0;;) {
    auto& [level, done] = depths[depth];
    if (done == level.pairs.size()) {
      if (depth-- == 0) return;
      continue;
    }
    if (!pause()) return;
    const auto pairs = std::span(level.pairs).subspan(done, std::min(kPairsAtATime, level.pairs.size() - done));
    done += pairs.size();
    const bool are_leaves = depth + 1 == depths.size();
    if (!are_leaves) {
      depths[depth + 1].level.pairs.clear();
      depths[depth + 1].done = 0;
    }
    for (const CrossLevel::Pair pair : pairs) {
      if (are_apart(Node{level.own_level, pair.own}, Node{level.other_level, pair.other})) continue;
      if (!are_leaves)
        open(other, change, pair, opened_below(level), depths[depth + 1].level, last_opened);
      else if (!visit_cross_leaves(pair.own, changed_leaves.get(pair.other), other.leaf_faces(pair.other), visit))
        return;
    }
    if (!are_leaves) ++depth;
  }
}

}  // namespace algebra3d
