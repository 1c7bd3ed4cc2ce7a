#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Of a point without negative zeros.
inline std::uint64_t hash_of(const Vec3& p) {
  __extension__ typedef unsigned __int128 UInt128;  // NOLINT(modernize-use-using): `using` takes no __extension__
  const auto fold = [](std::uint64_t a, std::uint64_t b) {
    const UInt128 product = UInt128{a} * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64U);
  };
  const auto x = std::bit_cast<std::uint64_t>(p.x);
  const auto y = std::bit_cast<std::uint64_t>(p.y);
  const auto z = std::bit_cast<std::uint64_t>(p.z);
  return fold(fold(x ^ 0x9E3779B97F4A7C15U, y ^ 0xD6E8FEB86659FD93U), z ^ 0xCA5A826395121157U);
}

/// Numbers different points in the order in which they come.
///
/// Open addressing with linear probing. A slot holds 32 bits of the hash beside the point's number, so that a probe
/// that meets another point reads that point's coordinates hardly ever.
class PointTable {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  explicit PointTable(std::size_t triangle_count) : slots_(capacity_for(triangle_count)), mask_(slots_.size() - 1) {
    // A closed mesh has half as many points as triangles; a soup without common corners grows the list.
    points_.reserve(triangle_count / 2 + 4);
  }

  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask_]); }

  /// Of a point, which is added if it is new.
  std::uint32_t number_of(const Vec3& p, std::uint64_t hash) {
    Slot& slot = slots_[place_of(p, hash)];
    if (slot.number != kNone) return slot.number;
    slot = {static_cast<std::uint32_t>(hash >> 32U), static_cast<std::uint32_t>(points_.size())};
    points_.push_back(p);
    if (points_.size() > slots_.size() / 8 * 5) grow();
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  /// kNone if it is not there.
  std::uint32_t find(const Vec3& p, std::uint64_t hash) const { return slots_[place_of(p, hash)].number; }

  std::vector<Vec3> take_points() && { return std::move(points_); }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = kNone;
  };

  static std::size_t capacity_for(std::size_t triangle_count) { return std::bit_ceil(triangle_count + 16); }

  /// Where the point is, or is to be.
  std::size_t place_of(const Vec3& p, std::uint64_t hash) const {
    const auto tag = static_cast<std::uint32_t>(hash >> 32U);
    for (std::size_t i = hash & mask_;; i = (i + 1) & mask_) {
      const Slot& slot = slots_[i];
      if (slot.number == kNone || (slot.tag == tag && points_[slot.number] == p)) return i;
    }
  }

  // Points are inserted anew in their order: the table depends on the points alone, not on its history.
  void grow() {
    slots_.assign(2 * slots_.size(), Slot());
    mask_ = slots_.size() - 1;
    for (std::uint32_t number = 0; number < points_.size(); ++number) {
      const std::uint64_t hash = hash_of(points_[number]);
      std::size_t i = hash & mask_;
      while (slots_[i].number != kNone) i = (i + 1) & mask_;
      slots_[i] = {static_cast<std::uint32_t>(hash >> 32U), number};
    }
  }

  std::vector<Slot> slots_;
  std::size_t mask_;
  std::vector<Vec3> points_;
};

}  // namespace algebra3d
