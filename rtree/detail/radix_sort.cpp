#include "rtree/detail/radix_sort.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/scheduler.h"

namespace rtree {
namespace {

constexpr std::uint32_t kDigitBits = 10;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
// Fewer than these are sorted by comparison.
constexpr std::size_t kFew = 256;
// More than these are first divided by their highest digit, then each part fits into the cache of a processor.
constexpr std::size_t kMany = std::size_t{1} << 16;
constexpr std::size_t kBlock = std::size_t{1} << 16;

using Counts = std::array<std::uint32_t, kDigits>;

std::uint32_t digit(const Place& place, std::uint32_t position) {
  return place.code >> (position * kDigitBits) & (kDigits - 1);
}

// Counts become the places where each digit begins.
void accumulate(Counts& counts) {
  std::uint32_t sum = 0;
  for (std::uint32_t& count : counts) sum += std::exchange(count, sum);
}

void move_by_digit(std::span<const Place> from, std::span<Place> to, std::uint32_t position, Counts& begins) {
  for (const Place& place : from) to[begins[digit(place, position)]++] = place;
}

// From the lowest digit to that below `digits`.
void sort_digits(std::span<Place> places, std::span<Place> buffer, std::uint32_t digits) {
  if (places.size() < kFew) {
    std::ranges::stable_sort(places, {}, &Place::code);
    return;
  }
  std::array<Counts, 3> counts{};
  for (const Place& place : places)
    for (std::uint32_t position = 0; position < digits; ++position) ++counts[position][digit(place, position)];
  std::span<Place> from = places, to = buffer;
  for (std::uint32_t position = 0; position < digits; ++position) {
    accumulate(counts[position]);
    move_by_digit(from, to, position, counts[position]);
    std::swap(from, to);
  }
  if (from.data() != places.data()) std::ranges::copy(from, places.begin());
}

// Divides by the highest digit: blocks of fixed size count and move their places; so the order does not depend on the
// number of threads. Returns where each digit begins.
Counts divide(std::span<const Place> places, std::span<Place> to) {
  const std::size_t block_count = (places.size() + kBlock - 1) / kBlock;
  const auto block = [&](std::size_t i) {
    return places.subspan(i * kBlock, std::min(kBlock, places.size() - i * kBlock));
  };
  std::vector<Counts> begins(block_count);
  algebra3d::parallel_for(block_count, 1, [&](std::size_t i) {
    begins[i].fill(0);
    for (const Place& place : block(i)) ++begins[i][digit(place, 2)];
  });
  Counts firsts;
  std::uint32_t sum = 0;
  for (std::size_t value = 0; value < kDigits; ++value) {
    firsts[value] = sum;
    for (Counts& counts : begins) sum += std::exchange(counts[value], sum);
  }
  algebra3d::parallel_for(block_count, 1, [&](std::size_t i) { move_by_digit(block(i), to, 2, begins[i]); });
  return firsts;
}

}  // namespace

void radix_sort(std::span<Place> places, std::span<Place> buffer) {
  if (places.size() < kMany) return sort_digits(places, buffer, 3);
  const Counts begins = divide(places, buffer);
  algebra3d::parallel_for(kDigits, 8, [&](std::size_t value) {
    const std::size_t begin = begins[value];
    const std::size_t count = (value + 1 < kDigits ? begins[value + 1] : places.size()) - begin;
    const auto sorted = places.subspan(begin, count);
    std::ranges::copy(buffer.subspan(begin, count), sorted.begin());
    sort_digits(sorted, buffer.subspan(begin, count), 2);
  });
}

}  // namespace rtree
