#include "algebra3d/arrangement/vertex_pool.h"

#include <bit>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

// Zeros of either sign are one number.
std::uint64_t bits_of(double coordinate) {
  return std::bit_cast<std::uint64_t>(coordinate + 0.0);
}

std::uint64_t hash_of(const Vec3& p) {
  std::uint64_t h = bits_of(p.x) * 0x9E3779B97F4A7C15U;
  h = (h ^ (h >> 32U) ^ bits_of(p.y)) * 0xC2B2AE3D27D4EB4FU;
  h = (h ^ (h >> 32U) ^ bits_of(p.z)) * 0x165667B19E3779F9U;
  return h ^ (h >> 32U);
}

}  // namespace

std::uint32_t VertexPool::intern(const PointRef& point) {
  if (2 * (size() + 1) > slots_.size()) grow();
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = hash_of(point.approx) & mask;; slot = (slot + 1) & mask) {
    const std::uint32_t vertex = slots_[slot];
    if (vertex == kNone) {
      slots_[slot] = static_cast<std::uint32_t>(size());
      approx_.push_back(point.approx);
      exact_.push_back(point.exact);
      return slots_[slot];
    }
    if (equal((*this)[vertex], point)) return vertex;
  }
}

std::uint32_t VertexPool::intern(const ExactPoint& point) {
  const std::size_t before = size();
  const std::uint32_t vertex = intern(point.ref());
  if (size() > before && !point.is_double()) owned_.push_back(point);
  return vertex;
}

void VertexPool::grow() {
  slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), kNone);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t vertex = 0; vertex < size(); ++vertex) {
    std::size_t slot = hash_of(approx_[vertex]) & mask;
    while (slots_[slot] != kNone) slot = (slot + 1) & mask;
    slots_[slot] = vertex;
  }
}

}  // namespace algebra3d::arrangement
