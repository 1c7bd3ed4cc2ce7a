#pragma once

#include <algorithm>
#include <cstddef>

#include "algebra3d/base/monitor.h"
#include "algebra3d/base/strong_id.h"
#include "base/scheduler.h"

namespace algebra3d::subdivision {

/// Number of elements that a task visits between two looks at the monitor.
inline constexpr std::size_t kBlock = 8192;

inline std::size_t block_count(std::size_t element_count) {
  return (element_count + kBlock - 1) / kBlock;
}

/// Calls visit(block, ids) for consecutive blocks of elements, in parallel, each a step of the stage. Blocks are left
/// out once the work is cancelled: who asked must look at the monitor then.
template <typename Id, typename Visit>
void for_each_block(std::size_t element_count, const Stage& stage, const Visit& visit) {
  parallel_for(block_count(element_count), 1, [&](std::size_t block) {
    Stage own(stage);
    if (!own.begin_step()) return;
    const std::size_t begin = block * kBlock;
    visit(block, IdRange<Id>(Id(begin), Id(std::min(begin + kBlock, element_count))));
  });
}

/// Calls visit(id) for all elements, in parallel.
template <typename Id, typename Visit>
void for_each_element(std::size_t element_count, const Stage& stage, const Visit& visit) {
  for_each_block<Id>(element_count, stage, [&](std::size_t, IdRange<Id> ids) {
    for (const Id id : ids) visit(id);
  });
}

}  // namespace algebra3d::subdivision
