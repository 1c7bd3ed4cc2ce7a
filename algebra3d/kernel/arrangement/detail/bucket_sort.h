#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace algebra3d::arrangement {

/// Bucket sort: the same order as std::sort(values.begin(), values.end(), is_less), for an order that looks first at
/// `bucket_of(value)`, an integer below `bucket_count`.
/// Cost: linear in both, and sorting within buckets, which mostly hold few values.
template <typename T, typename BucketOf, typename IsLess>
void bucket_sort(std::vector<T>& values, std::size_t bucket_count, BucketOf bucket_of, IsLess is_less) {
  std::vector<std::uint32_t> ends(bucket_count);
  for (const T& value : values) ++ends[bucket_of(value)];
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends) sum += std::exchange(end, sum);
  std::vector<T> sorted(values.size());
  for (T& value : values) sorted[ends[bucket_of(value)]++] = std::move(value);
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) {
    if (end - begin > 1) std::sort(sorted.begin() + begin, sorted.begin() + end, is_less);
    begin = end;
  }
  values = std::move(sorted);
}

}  // namespace algebra3d::arrangement
