#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/base/int128.h"
#include "algebra3d/kernel/exact/point.h"
#include "base/indices.h"

namespace algebra3d {

/// Hash of rounded coordinates; negative zero equals zero.
inline std::uint64_t hash_of(const Vec3& p) {
  const auto bits_of = [](double coordinate) { return std::bit_cast<std::uint64_t>(coordinate + 0.0); };
  const auto fold = [](std::uint64_t a, std::uint64_t b) {
    const UInt128 product = UInt128{a} * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64U);
  };
  return fold(fold(bits_of(p.x) ^ 0x9E3779B97F4A7C15U, bits_of(p.y) ^ 0xD6E8FEB86659FD93U),
              bits_of(p.z) ^ 0xCA5A826395121157U);
}

/// A set of distinct points, numbered from 0 in the order of insertion. The numbers depend only on the order of the
/// calls. Concurrent calls of const members are safe.
///
/// Open addressing with linear probing. A slot holds 32 bits of the hash and the point's number, so a probe rarely
/// reads the coordinates of another point.
class PointTable {
 public:
  PointTable() = default;
  /// With capacity for `expected_count` points.
  explicit PointTable(std::size_t expected_count) : slots_(std::bit_ceil(2 * expected_count + 16)) {
    approx_.reserve(expected_count + 4);
  }

  /// The number of the point, which is added if it is new; the table shares the ownership of exact coordinates.
  /// Cost: constant expected.
  std::uint32_t intern(const PointRef& point) { return intern(point, hash_of(point.approx)); }
  /// As above, for a point whose hash is known.
  std::uint32_t intern(const PointRef& point, std::uint64_t hash) {
    if (approx_.size() >= slots_.size() / 8 * 5) grow();
    Slot& slot = slots_[place_of(point, hash)];
    if (slot.number != kNone) return slot.number;
    slot = {tag_of(hash), static_cast<std::uint32_t>(approx_.size())};
    if (!point.is_double()) {
      exact_.resize(approx_.size());
      exact_.emplace_back(point.exact);
    }
    approx_.push_back(point.approx);
    return slot.number;
  }
  /// Prefetches the memory that `intern` of a point with this hash will read.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(slots_.data() + (hash & (slots_.size() - 1))); }

  /// The number of a point; kNone if it is not in the table.
  std::uint32_t find(const PointRef& point) const {
    return slots_.empty() ? kNone : slots_[place_of(point, hash_of(point.approx))].number;
  }

  /// Frees what finding points takes, and unused capacity, once all points are there: `find` must not be called any
  /// more, and the next `intern` takes as long as all before.
  void finish();

  PointRef operator[](std::uint32_t number) const { return {approx_[number], exact_of(number)}; }
  std::size_t size() const { return approx_.size(); }

  /// The points by number. Domain: all are doubles.
  std::vector<Vec3> take_doubles() && {
    assert(exact_.empty());
    return std::move(approx_);
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = kNone;
  };

  static std::uint32_t tag_of(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32U); }
  const ExactCoordinates* exact_of(std::uint32_t number) const {
    return number < exact_.size() ? exact_[number].get() : nullptr;
  }
  bool is_at(std::uint32_t number, const PointRef& point) const {
    if (approx_[number] != point.approx) return false;
    const ExactCoordinates* const exact = exact_of(number);
    return exact == point.exact || are_equal(exact, point.exact);
  }
  static bool are_equal(const ExactCoordinates* a, const ExactCoordinates* b);

  /// The slot of the point, or the free slot for it.
  std::size_t place_of(const PointRef& point, std::uint64_t hash) const {
    const std::size_t mask = slots_.size() - 1;
    const std::uint32_t tag = tag_of(hash);
    for (std::size_t i = hash & mask;; i = (i + 1) & mask) {
      const Slot& slot = slots_[i];
      if (slot.number == kNone || (slot.tag == tag && is_at(slot.number, point))) return i;
    }
  }
  void grow();

  std::vector<Slot> slots_;  // their number is 0 or a power of two
  std::vector<Vec3> approx_;
  std::vector<SharedCoordinates> exact_;  // null for doubles; ends with the last exact point
};

}  // namespace algebra3d
