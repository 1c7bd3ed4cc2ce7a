#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "algebra3d/base/monitor.h"
#include "base/scheduler.h"

namespace algebra3d::subdivision {

/// Number of elements that a task visits between two looks at the monitor.
inline constexpr std::size_t kBlock = 8192;

inline std::size_t block_count(std::size_t element_count) {
  return (element_count + kBlock - 1) / kBlock;
}

/// Calls visit(block, begin, end) for consecutive blocks of elements, in parallel, each a step of the stage. Blocks are
/// left out once the work is cancelled: who asked must look at the monitor then.
template <typename Visit>
void for_each_block(std::size_t element_count, const Stage& stage, const Visit& visit) {
  parallel_for(block_count(element_count), 1, [&](std::size_t block) {
    Stage own(stage);
    if (!own.begin_step()) return;
    const std::size_t begin = block * kBlock;
    visit(block, static_cast<std::uint32_t>(begin),
          static_cast<std::uint32_t>(std::min(begin + kBlock, element_count)));
  });
}

/// Calls visit(i) for all numbers below `element_count`.
template <typename Visit>
void for_each_element(std::size_t element_count, const Stage& stage, const Visit& visit) {
  for_each_block(element_count, stage, [&](std::size_t, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) visit(i);
  });
}

}  // namespace algebra3d::subdivision
