#include "algebra3d/repair/weld.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <unordered_map>

namespace algebra3d {
namespace {

__extension__ typedef unsigned __int128 UInt128;  // NOLINT(modernize-use-using): `using` takes no __extension__

std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  const UInt128 product = UInt128{a} * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64U);
}

std::uint64_t hash_of(const Vec3& p) {
  const auto x = std::bit_cast<std::uint64_t>(p.x);
  const auto y = std::bit_cast<std::uint64_t>(p.y);
  const auto z = std::bit_cast<std::uint64_t>(p.z);
  return fold(fold(x ^ 0x9E3779B97F4A7C15U, y ^ 0xD6E8FEB86659FD93U), z ^ 0xCA5A826395121157U);
}

/// Open addressing with linear probing. A slot holds 32 bits of the hash beside the point's number, so that a probe
/// that meets another point reads that point's coordinates hardly ever.
class PointTable {
 public:
  explicit PointTable(std::size_t triangle_count) : slots_(capacity_for(triangle_count)), mask_(slots_.size() - 1) {
    // A closed mesh has half as many points as triangles; a soup without common corners grows the list.
    points_.reserve(triangle_count / 2 + 4);
  }

  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask_]); }

  std::uint32_t number_of(const Vec3& p, std::uint64_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32U);
    for (std::size_t i = hash & mask_;; i = (i + 1) & mask_) {
      Slot& slot = slots_[i];
      if (slot.number == kFree) {
        slot = {tag, static_cast<std::uint32_t>(points_.size())};
        points_.push_back(p);
        if (points_.size() > slots_.size() / 8 * 5) grow();
        return static_cast<std::uint32_t>(points_.size() - 1);
      }
      if (slot.tag == tag && points_[slot.number] == p) return slot.number;
    }
  }

  std::vector<Vec3> take_points() && { return std::move(points_); }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = kFree;
  };

  static std::size_t capacity_for(std::size_t triangle_count) { return std::bit_ceil(triangle_count + 16); }

  // Points are inserted anew in their order: the table depends on the points alone, not on its history.
  void grow() {
    slots_.assign(2 * slots_.size(), Slot());
    mask_ = slots_.size() - 1;
    for (std::uint32_t number = 0; number < points_.size(); ++number) {
      const std::uint64_t hash = hash_of(points_[number]);
      std::size_t i = hash & mask_;
      while (slots_[i].number != kFree) i = (i + 1) & mask_;
      slots_[i] = {static_cast<std::uint32_t>(hash >> 32U), number};
    }
  }

  std::vector<Slot> slots_;
  std::size_t mask_;
  std::vector<Vec3> points_;
};

/// Corners of a few triangles: their hashes are known, and their slots on the way from memory, before they are looked
/// up.
constexpr std::size_t kBlock = 32;

}  // namespace

WeldedTriangles weld(std::span<const TriangleSoup::Triangle> triangles) {
  assert(triangles.size() <= TriangleMesh::kMaxFaces);
  PointTable table(triangles.size());
  WeldedTriangles result;
  result.triangles.resize(triangles.size());
  std::array<Vec3, 3 * kBlock> corners;
  std::array<std::uint64_t, 3 * kBlock> hashes{};
  for (std::size_t start = 0; start < triangles.size(); start += kBlock) {
    const std::size_t count = std::min(kBlock, triangles.size() - start);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const Vec3& corner = triangles[start + i / 3][i % 3];
      // -0 + 0 is 0 when rounding to nearest; all other values stay.
      corners[i] = {corner.x + 0.0, corner.y + 0.0, corner.z + 0.0};
      hashes[i] = hash_of(corners[i]);
      table.prefetch(hashes[i]);
    }
    for (std::size_t i = 0; i < 3 * count; ++i)
      result.triangles[start + i / 3][i % 3] = table.number_of(corners[i], hashes[i]);
  }
  result.points = PointArray(std::move(table).take_points());
  return result;
}

WeldedTriangles weld(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles) {
  std::vector<TriangleSoup::Triangle> soup;
  soup.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) soup.push_back({points[a], points[b], points[c]});
  return weld(soup);
}

WeldedTriangles weld(std::span<const std::array<ExactPoint, 3>> triangles) {
  struct Hash {
    std::size_t operator()(const ExactPoint& p) const { return p.hash(); }
  };
  assert(triangles.size() <= TriangleMesh::kMaxFaces);
  std::unordered_map<ExactPoint, std::uint32_t, Hash> numbers;
  WeldedTriangles result;
  result.triangles.reserve(triangles.size());
  for (const auto& corners : triangles) {
    TriangleMesh::Triangle& triangle = result.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [place, is_new] = numbers.try_emplace(corners[i], static_cast<std::uint32_t>(numbers.size()));
      if (is_new) result.points.push_back(corners[i]);
      triangle[i] = place->second;
    }
  }
  return result;
}

}  // namespace algebra3d
