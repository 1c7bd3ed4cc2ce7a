#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace algebra3d::arrangement {

/// The numbers below a count, bucket by bucket, ascending in each: an index of a list that leaves it as it is, with
/// four bytes for each of its elements.
class NumbersByBucket {
 public:
  /// `bucket_of(number)`: an integer below `bucket_count`. Cost: linear in both.
  template <typename BucketOf>
  NumbersByBucket(std::size_t count, std::size_t bucket_count, BucketOf bucket_of)
      : begins_(bucket_count + 1), numbers_(count) {
    for (std::size_t number = 0; number < count; ++number) ++begins_[bucket_of(number)];
    // Where buckets end; they are filled from behind, so that this is where they begin afterwards.
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    for (std::size_t number = count; number-- > 0;)
      numbers_[--begins_[bucket_of(number)]] = static_cast<std::uint32_t>(number);
  }

  std::size_t bucket_count() const { return begins_.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t bucket) const { return of(bucket, bucket + 1); }
  /// The numbers in consecutive buckets, from `first` to the one before `last`.
  std::span<const std::uint32_t> of(std::size_t first, std::size_t last) const {
    return std::span(numbers_).subspan(begins_[first], begins_[last] - begins_[first]);
  }

 private:
  std::vector<std::uint32_t> begins_;  // of each bucket, and where all end
  std::vector<std::uint32_t> numbers_;
};

}  // namespace algebra3d::arrangement
