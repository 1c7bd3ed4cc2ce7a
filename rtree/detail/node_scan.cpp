#include "rtree/detail/node_scan.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

// Vectors of the compiler, which g++ and clang++ have on every processor; only what makes a mask of bits differs.
#define VECTOR_OF(Element, count) __attribute__((vector_size(sizeof(Element) * (count)))) Element

namespace rtree {
namespace {

// With four wide lanes.
#define CHOSEN(slots, a, b) ((kLaneBits & static_cast<std::int64_t>(slots)) != 0 ? (a) : (b))
#define LEAST_LANE(doubles) std::min(std::min(doubles[0], doubles[1]), std::min(doubles[2], doubles[3]))
#define SHIFTED(before, here) __builtin_shufflevector(before, here, 3, 4, 5, 6)
#define WIDENED(keys) __builtin_convertvector(keys, Signed)

// Vectors of 16 bytes, which every 64-bit processor has; elsewhere the compiler makes plain code of it.
namespace common {

#define SCAN_TARGET
constexpr std::size_t kLanes = 4;
constexpr std::size_t kWideLanes = 4;
using Keys = VECTOR_OF(std::int32_t, kLanes);
using WideKeys = VECTOR_OF(std::int32_t, kWideLanes);
using Signed = VECTOR_OF(std::int64_t, kWideLanes);
using Unsigned = VECTOR_OF(std::uint64_t, kWideLanes);
using Doubles = VECTOR_OF(double, kWideLanes);

inline SlotMask slots_of(Keys lanes) {
#if defined(__x86_64__)
  __m128 bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  return static_cast<SlotMask>(_mm_movemask_ps(bits));
#elif defined(__aarch64__)
  uint32x4_t bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  constexpr std::uint32_t kBits[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(bits, vld1q_u32(kBits)));
#else
  SlotMask slots = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) slots |= static_cast<SlotMask>(lanes[lane] & 1) << lane;
  return slots;
#endif
}

inline SlotMask wide_slots_of(const Signed& lanes) {
  return slots_of(__builtin_convertvector(lanes, Keys));
}

constexpr Signed kLaneBits = {1, 2, 4, 8};

#include "rtree/detail/node_scan.inl"
#undef SCAN_TARGET

}  // namespace common

#if defined(__x86_64__)

namespace avx2 {

#define SCAN_TARGET __attribute__((target("avx2")))
constexpr std::size_t kLanes = 8;
constexpr std::size_t kWideLanes = 4;
using Keys = VECTOR_OF(std::int32_t, kLanes);
using WideKeys = VECTOR_OF(std::int32_t, kWideLanes);
using Signed = VECTOR_OF(std::int64_t, kWideLanes);
using Unsigned = VECTOR_OF(std::uint64_t, kWideLanes);
using Doubles = VECTOR_OF(double, kWideLanes);

SCAN_TARGET inline SlotMask slots_of(Keys lanes) {
  __m256 bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  return static_cast<SlotMask>(_mm256_movemask_ps(bits));
}

SCAN_TARGET inline SlotMask wide_slots_of(const Signed& lanes) {
  __m256d bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  return static_cast<SlotMask>(_mm256_movemask_pd(bits));
}

constexpr Signed kLaneBits = {1, 2, 4, 8};

#include "rtree/detail/node_scan.inl"
#undef SCAN_TARGET

}  // namespace avx2

#undef CHOSEN
#undef LEAST_LANE
#undef SHIFTED
#undef WIDENED

namespace avx512 {

#define SCAN_TARGET __attribute__((target("avx512f,avx512dq")))
constexpr std::size_t kLanes = 16;
constexpr std::size_t kWideLanes = 8;
using Keys = VECTOR_OF(std::int32_t, kLanes);
using WideKeys = VECTOR_OF(std::int32_t, kWideLanes);
using Signed = VECTOR_OF(std::int64_t, kWideLanes);
using Unsigned = VECTOR_OF(std::uint64_t, kWideLanes);
using Doubles = VECTOR_OF(double, kWideLanes);

SCAN_TARGET inline SlotMask slots_of(Keys lanes) {
  __m512i bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  return _mm512_movepi32_mask(bits);
}

SCAN_TARGET inline SlotMask wide_slots_of(const Signed& lanes) {
  __m512i bits;
  __builtin_memcpy(&bits, &lanes, sizeof(bits));
  return _mm512_movepi64_mask(bits);
}

SCAN_TARGET inline double least_lane(const Doubles& doubles) {
  using Half = VECTOR_OF(double, 4);
  const Half low = __builtin_shufflevector(doubles, doubles, 0, 1, 2, 3);
  const Half high = __builtin_shufflevector(doubles, doubles, 4, 5, 6, 7);
  const Half least = high < low ? high : low;
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

#define SHIFTED(before, here) __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14)
// g++ 12 makes two halves of a conversion, and warns of the plain intrinsic.
#define WIDENED(keys) ((Signed)_mm512_maskz_cvtepi32_epi64(0xff, (__m256i)(keys)))
#define LEAST_LANE(doubles) least_lane(doubles)
#define CHOSEN(slots, a, b) ((Doubles)_mm512_mask_blend_pd(static_cast<__mmask8>(slots), (__m512d)(b), (__m512d)(a)))
#include "rtree/detail/node_scan.inl"
#undef SCAN_TARGET

}  // namespace avx512

#endif

#undef CHOSEN
#undef LEAST_LANE
#undef SHIFTED
#undef WIDENED

}  // namespace

std::size_t available_scans(const NodeScans* (&scans)[4]) {
  std::size_t count = 0;
  scans[count++] = &common::kScans;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) scans[count++] = &avx2::kScans;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) scans[count++] = &avx512::kScans;
#endif
  return count;
}

const NodeScans& node_scans() {
  static const NodeScans& best = []() -> const NodeScans& {
    const NodeScans* scans[4];
    return *scans[available_scans(scans) - 1];
  }();
  return best;
}

#undef VECTOR_OF

}  // namespace rtree
