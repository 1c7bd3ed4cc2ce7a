#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/scheduler.h"

namespace algebra3d {

namespace detail {

/// Sorts by keys of three digits. `Key` gives the key of a value, an unsigned number below 2^kBits.
template <unsigned kBits, typename Value, typename Key>
class RadixSorter {
 public:
  explicit RadixSorter(const Key& key) : key_(key) {}

  void sort(std::span<Value> values, std::span<Value> buffer) const {
    if (values.size() < kMany) return sort_digits(values, buffer, kRounds);
    const Counts begins = divide(values, buffer);
    parallel_for(kDigits, 8, [&](std::size_t digit) {
      const std::size_t begin = begins[digit];
      const std::size_t count = (digit + 1 < kDigits ? begins[digit + 1] : values.size()) - begin;
      const std::span<Value> sorted = values.subspan(begin, count);
      std::ranges::copy(buffer.subspan(begin, count), sorted.begin());
      sort_digits(sorted, buffer.subspan(begin, count), kRounds - 1);
    });
  }

 private:
  static constexpr unsigned kRounds = 3, kDigitBits = (kBits + kRounds - 1) / kRounds;
  static constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  // Fewer than these are sorted by comparison.
  static constexpr std::size_t kFew = 256;
  // More than these are first divided by their highest digit, then each part fits into the cache of a processor.
  static constexpr std::size_t kMany = std::size_t{1} << 16;
  static constexpr std::size_t kBlock = std::size_t{1} << 16;

  using Counts = std::array<std::uint32_t, kDigits>;

  std::size_t digit(const Value& value, unsigned round) const {
    return key_(value) >> (round * kDigitBits) & (kDigits - 1);
  }

  // Counts become the places where each digit begins. False if all have one digit.
  static bool accumulate(Counts& counts, std::size_t size) {
    std::uint32_t sum = 0;
    bool is_divided = true;
    for (std::uint32_t& count : counts) {
      is_divided = is_divided && count != size;
      sum += std::exchange(count, sum);
    }
    return is_divided;
  }

  void move_by_digit(std::span<const Value> from, std::span<Value> to, unsigned round, Counts& begins) const {
    for (const Value& value : from) to[begins[digit(value, round)]++] = value;
  }

  // From the lowest digit to that before `rounds`.
  void sort_digits(std::span<Value> values, std::span<Value> buffer, unsigned rounds) const {
    if (values.size() < kFew) {
      std::ranges::stable_sort(values, {}, key_);
      return;
    }
    std::array<Counts, kRounds> counts{};
    for (const Value& value : values)
      for (unsigned round = 0; round < rounds; ++round) ++counts[round][digit(value, round)];
    std::span<Value> from = values, to = buffer;
    for (unsigned round = 0; round < rounds; ++round) {
      if (!accumulate(counts[round], values.size())) continue;
      move_by_digit(from, to, round, counts[round]);
      std::swap(from, to);
    }
    if (from.data() != values.data()) std::ranges::copy(from, values.begin());
  }

  // Divides by the highest digit: blocks of fixed size count and move their values; so the order does not depend on the
  // number of threads. Returns where each digit begins.
  Counts divide(std::span<const Value> values, std::span<Value> to) const {
    const std::size_t block_count = (values.size() + kBlock - 1) / kBlock;
    const auto block = [&](std::size_t i) {
      return values.subspan(i * kBlock, std::min(kBlock, values.size() - i * kBlock));
    };
    std::vector<Counts> begins(block_count);
    parallel_for(block_count, 1, [&](std::size_t i) {
      begins[i].fill(0);
      for (const Value& value : block(i)) ++begins[i][digit(value, kRounds - 1)];
    });
    Counts firsts;
    std::uint32_t sum = 0;
    for (std::size_t value = 0; value < kDigits; ++value) {
      firsts[value] = sum;
      for (Counts& counts : begins) sum += std::exchange(counts[value], sum);
    }
    parallel_for(block_count, 1, [&](std::size_t i) { move_by_digit(block(i), to, kRounds - 1, begins[i]); });
    return firsts;
  }

  const Key& key_;
};

}  // namespace detail

/// Sorts fewer than 2^32 values by key(value), an unsigned number below 2^kBits; values with equal keys keep their
/// order. `buffer` is as long as `values`. In parallel if there are many. Cost: linear.
template <unsigned kBits, typename Value, typename Key>
void radix_sort(std::span<Value> values, std::span<Value> buffer, const Key& key) {
  detail::RadixSorter<kBits, Value, Key>(key).sort(values, buffer);
}

}  // namespace algebra3d
