#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace algebra3d::detail {

/// Numbers from 0 to a given count, to be found by a hash of what they stand for. Whoever looks compares: others may
/// have the same hash.
class HashChains {
 public:
  explicit HashChains(std::size_t count)
      : first_(std::bit_ceil(std::max<std::size_t>(2 * count, 2)), kNone), next_(count, kNone) {}

  void insert(std::uint64_t hash, std::uint32_t number) {
    std::uint32_t& first = first_[place(hash)];
    next_[number] = first;
    first = number;
  }
  /// Calls visit(number) for the numbers that may have the hash, until it returns false.
  template <typename Visit>
  void for_each(std::uint64_t hash, const Visit& visit) const {
    for (std::uint32_t number = first_[place(hash)]; number != kNone; number = next_[number])
      if (!visit(number)) return;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::size_t place(std::uint64_t hash) const { return hash & (first_.size() - 1); }

  std::vector<std::uint32_t> first_, next_;
};

inline std::uint64_t hash_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t hash = a * 0x9e3779b97f4a7c15U;
  hash = (std::rotl(hash, 23) ^ b) * 0xbf58476d1ce4e5b9U;
  hash = (std::rotl(hash, 29) ^ c) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 32U);
}

}  // namespace algebra3d::detail
