#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "algebra3d/values/display/shape.h"

namespace queries {

/// The levels of detail of the cells that were asked for last. Used by one thread.
class LevelCache {
 public:
  struct Entry {
    std::size_t row = 0;
    std::size_t column = 0;
    std::vector<algebra3d::DrawnShape> levels;  ///< from the finest to the coarsest
  };

  /// The levels of a cell; null if they are not there.
  const Entry* find(std::size_t row, std::size_t column) const {
    for (const Entry& entry : entries_)
      if (entry.row == row && entry.column == column) return &entry;
    return nullptr;
  }
  /// Keeps the levels of a cell and returns them; beyond `kMostBytes` the oldest others go.
  const Entry& keep(Entry entry) {
    entries_.push_back(std::move(entry));
    while (entries_.size() > 1 && bytes() > kMostBytes) entries_.pop_front();
    return entries_.back();
  }

 private:
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20U;

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Entry& entry : entries_)
      for (const algebra3d::DrawnShape& shape : entry.levels) sum += content_bytes(shape);
    return sum;
  }

  std::deque<Entry> entries_;
};

}  // namespace queries
