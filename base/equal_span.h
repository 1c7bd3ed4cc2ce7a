#pragma once

#include <algorithm>
#include <functional>
#include <span>

namespace algebra3d {

/// The elements of a sorted contiguous range whose projections equal the value. Cost: logarithmic. Like
/// std::ranges::equal_range, but returns a span: Clang 14 cannot compile the subrange of libstdc++ 12.
template <typename Range, typename Value, typename Projection = std::identity>
auto equal_span(Range&& sorted, const Value& value, Projection projection = {}) {
  const auto first = std::ranges::lower_bound(sorted, value, {}, projection);
  return std::span(first, std::ranges::upper_bound(first, std::ranges::end(sorted), value, {}, projection));
}

}  // namespace algebra3d
