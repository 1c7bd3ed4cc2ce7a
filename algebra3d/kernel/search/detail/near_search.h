#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

template <typename Visit, typename Apart, typename Pause>
void BoxHierarchy::for_each_near_pair_with(const BoxHierarchy& other, double reach, Visit visit, Apart are_apart,
                                           Pause pause) const {
  if (faces_.empty() || other.faces_.empty()) return;
  const FrameChange change = change_from(other);
  double limit = squared_in_frame(reach);
  std::vector<NearPair> stack{{root(), other.root(), changed(change, other.levels_.back().boxes[0]), 0}};
  std::uint32_t steps = 0;
  while (!stack.empty()) {
    const NearPair pair = stack.back();
    stack.pop_back();
    if (++steps % 4096 == 0 && !pause()) return;
    if (pair.squared_gap > limit) continue;
    if (are_apart(pair.own, pair.other)) continue;
    if (pair.own.level > 0 || pair.other.level > 0) {
      push_near_children(other, change, pair, stack);
      continue;
    }
    const std::size_t own_begin = pair.own.index * kLeafSize, own_end = std::min(own_begin + kLeafSize, faces_.size());
    const std::size_t begin = pair.other.index * kLeafSize, end = std::min(begin + kLeafSize, other.faces_.size());
    for (std::size_t j = begin; j < end; ++j) {
      const Box box = changed(change, other.face_boxes_[j]);
      if (squared_gap(levels_[0].boxes[pair.own.index], box) > limit) continue;
      for (std::size_t i = own_begin; i < own_end; ++i) {
        if (squared_gap(face_boxes_[i], box) > limit) continue;
        const double farthest = visit(faces_[i], other.faces_[j]);
        if (farthest < 0) return;
        limit = squared_in_frame(farthest);
      }
    }
  }
}

template <typename Gap>
void BoxHierarchy::push_near_children(const Node& node, const Box& where, double limit, Gap gap,
                                      std::vector<NearNode>& stack) const {
  const LargeVector<Box>& below = levels_[node.level - 1].boxes;
  const auto end = std::min(2 * node.index + 2, static_cast<std::uint32_t>(below.size()));
  const std::size_t first_new = stack.size();
  for (std::uint32_t child = 2 * node.index; child < end; ++child) {
    const Node opened{node.level - 1, child};
    const double of_boxes = squared_gap(below[child], where);
    if (of_boxes > limit) continue;
    const double certain = std::max(0.0, gap(opened)) / 2 * frame_.scale * (1 - 0x1p-40);
    if (certain * certain <= limit) stack.push_back({opened, std::max(of_boxes, certain * certain)});
  }
  if (stack.size() == first_new + 2 && stack[first_new].squared_gap < stack[first_new + 1].squared_gap)
    std::swap(stack[first_new], stack[first_new + 1]);
}

template <typename Gap, typename Visit>
void BoxHierarchy::for_each_near(const Box3& where, double reach, Gap gap, Visit visit) const {
  if (faces_.empty()) return;
  const Box place = scaled(where);
  double limit = squared_in_frame(reach);
  std::vector<NearNode> stack{{root(), 0}};
  while (!stack.empty()) {
    const NearNode node = stack.back();
    stack.pop_back();
    if (node.squared_gap > limit) continue;
    if (node.level > 0) {
      push_near_children(node, place, limit, gap, stack);
      continue;
    }
    const std::size_t begin = node.index * kLeafSize, end = std::min(begin + kLeafSize, faces_.size());
    for (std::size_t i = begin; i < end; ++i) {
      if (squared_gap(face_boxes_[i], place) > limit) continue;
      const double farthest = visit(faces_[i]);
      if (farthest < 0) return;
      limit = squared_in_frame(farthest);
    }
  }
}

}  // namespace algebra3d
