#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace algebra3d {

/// A queue of half-edges in the order of rounded costs: those of one bucket differ by about a hundredth. Within a
/// bucket they keep the order of insertion, which follows the memory, so that neighbours are handled together.
class CostBuckets {
 public:
  static constexpr std::size_t kPerOctave = 64, kCount = 96 * kPerOctave;

  /// The bucket of a cost; costs from 2^-80 to 2^16 are distinguished.
  static std::size_t bucket_of(double cost) {
    constexpr std::uint64_t kFirst = (std::uint64_t{1023} - 80) * kPerOctave;
    const std::uint64_t place = std::bit_cast<std::uint64_t>(std::max(cost, 0.0)) >> 46U;
    return place <= kFirst ? 0 : std::min<std::size_t>(place - kFirst, kCount - 1);
  }

  void push(std::size_t bucket, std::uint32_t h) { buckets_[bucket].push_back(h); }
  /// The entries of a bucket, to which others may be added meanwhile.
  const std::vector<std::uint32_t>& operator[](std::size_t bucket) const { return buckets_[bucket]; }
  void reserve(std::size_t bucket, std::size_t count) { buckets_[bucket].reserve(count); }
  void release(std::size_t bucket) { std::vector<std::uint32_t>().swap(buckets_[bucket]); }

 private:
  std::vector<std::vector<std::uint32_t>> buckets_ = std::vector<std::vector<std::uint32_t>>(kCount);
};

}  // namespace algebra3d
