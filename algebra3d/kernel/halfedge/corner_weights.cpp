#include "algebra3d/kernel/halfedge/detail/corner_weights.h"

#include <cmath>
#include <numbers>

#include "algebra3d/kernel/halfedge/detail/face_normal.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// Vectors of the compiler, which g++ and clang++ have on every processor; only the square root differs.
#define VECTOR_OF(Element, count) __attribute__((vector_size(sizeof(Element) * (count)))) Element
#define ALWAYS_INLINE inline __attribute__((always_inline))
// Places in memory that are computed one by one: g++ makes vectors of them, and takes these apart again.
#define KEEP_SCALAR(number) asm("" : "+r"(number))

namespace algebra3d::detail {
namespace {

constexpr double kHalfTurn = std::numbers::pi, kQuarterTurn = std::numbers::pi / 2;
constexpr double kTangentOfEighth = 0.41421356237309503;  // of an eighth of a half turn, up to which the series is used
// The polynomial of t^2 for (atan(t) / t - 1) / t^2, interpolated at Chebyshev nodes of [0, tan(pi / 8)^2]: the
// relative error of t + t^3 p(t^2) is below 2^-56 before rounding.
constexpr double kArcTangent[] = {-0.3333333333333333,  0.1999999999999552,   -0.14285714284666542,
                                  0.11111111015256223,  -0.09090904578118268, 0.07692183190695215,
                                  -0.0666451144553849,  0.05858148896788035,  -0.050854496541382486,
                                  0.039231655874580044, -0.019176884154115826};

constexpr double kLeastSize = 0x1p-450, kLargestSize = 0x1p450;

// Vectors of 16 bytes, which every 64-bit processor has; elsewhere the compiler makes plain code of it.
namespace weights_common {

#define KERNEL_TARGET
constexpr std::size_t kLanes = 2;
#define LANES(of) of(0), of(1)
#define SQUARE_ROOT(doubles)                         \
  Doubles {                                          \
    std::sqrt((doubles)[0]), std::sqrt((doubles)[1]) \
  }
#include "algebra3d/kernel/halfedge/detail/corner_weights.inl"
#undef KERNEL_TARGET
#undef LANES
#undef SQUARE_ROOT

}  // namespace weights_common

#if defined(__x86_64__)

namespace weights_avx2 {

#define KERNEL_TARGET __attribute__((target("avx2")))
constexpr std::size_t kLanes = 4;
#define LANES(of) of(0), of(1), of(2), of(3)
#define SQUARE_ROOT(doubles) ((Doubles)_mm256_sqrt_pd((__m256d)(doubles)))
#include "algebra3d/kernel/halfedge/detail/corner_weights.inl"
#undef KERNEL_TARGET
#undef LANES
#undef SQUARE_ROOT

}  // namespace weights_avx2

namespace weights_avx512 {

#define KERNEL_TARGET __attribute__((target("avx512f,avx512dq")))
constexpr std::size_t kLanes = 8;
#define LANES(of) of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)
#define SQUARE_ROOT(doubles) ((Doubles)_mm512_maskz_sqrt_pd(0xff, (__m512d)(doubles)))  // g++ 12 warns of the plain one
#include "algebra3d/kernel/halfedge/detail/corner_weights.inl"
#undef KERNEL_TARGET
#undef LANES
#undef SQUARE_ROOT

}  // namespace weights_avx512

#endif

}  // namespace

std::span<const CornerWeightKernels* const> available_corner_weight_kernels() {
  static constexpr const CornerWeightKernels* kAll[] = {
    &weights_common::kKernels,
#if defined(__x86_64__)
    &weights_avx2::kKernels,
    &weights_avx512::kKernels,
#endif
  };
  std::size_t count = 1;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) count = 2;
  if (count == 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) count = 3;
#endif
  return std::span(kAll).first(count);
}

const CornerWeightKernels& corner_weight_kernels() {
  static const CornerWeightKernels& best = *available_corner_weight_kernels().back();
  return best;
}

#undef VECTOR_OF
#undef ALWAYS_INLINE
#undef KEEP_SCALAR

}  // namespace algebra3d::detail
