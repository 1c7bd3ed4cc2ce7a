#include "algebra3d/kernel/subdivision/detail/ring_masks.h"
#include "base/interruption_scope.h"

#include <array>
#include <cstdint>

#include "algebra3d/kernel/exact/trigonometry.h"

namespace algebra3d::subdivision {
namespace {

constexpr std::size_t kShortRing = 16;

/// The points that divide a circle into `count` steps. Few steps are computed once and for all.
class Turns {
 public:
  explicit Turns(std::size_t count) : count_(count), own_(count < kKnown ? 0 : count) {
    if (count >= kKnown) fill(own_);
  }
  const CirclePoint& operator[](std::size_t index) const {
    return (count_ < kKnown ? known()[count_] : own_)[index % count_];
  }

 private:
  static constexpr std::size_t kKnown = 2 * kShortRing + 1;

  static void fill(std::vector<CirclePoint>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      poll_interruption_at(i);
      points[i] = circle_point(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(points.size()));
    }
  }
  static const std::array<std::vector<CirclePoint>, kKnown>& known() {
    static const auto all = [] {
      std::array<std::vector<CirclePoint>, kKnown> made;
      for (std::size_t count = 1; count < kKnown; ++count) {
        made[count].resize(count);
        fill(made[count]);
      }
      return made;
    }();
    return all;
  }

  std::size_t count_;
  std::vector<CirclePoint> own_;
};

/// Weights of a ring that depend on how many places a point is on: constant + first cos(2 pi j / n) + second cos(4 pi j
/// / n).
struct CyclicWeights {
  double constant = 0, first = 0, second = 0;
};

using ShortWeights = std::array<double, kShortRing>;

/// For rings whose weights are `weights[j]` for the point j places on.
void apply_directly(const ShortWeights& weights, const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 sum = weights[0] * ring[i];
    for (std::size_t j = 1; j < n; ++j) sum = sum + weights[j] * ring[(i + j) % n];
    result[i] = sum;
  }
}

/// cos(i - j) is cos(i) cos(j) + sin(i) sin(j).
void apply_by_sums(const CyclicWeights& weights, const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  const std::size_t n = ring.size();
  const Turns turns(n);
  Vec3 all, cosines, sines, double_cosines, double_sines;
  for (std::size_t j = 0; j < n; ++j) {
    const CirclePoint &once = turns[j], &twice = turns[2 * j];
    all = all + ring[j];
    cosines = cosines + once.cosine * ring[j];
    sines = sines + once.sine * ring[j];
    double_cosines = double_cosines + twice.cosine * ring[j];
    double_sines = double_sines + twice.sine * ring[j];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const CirclePoint &once = turns[i], &twice = turns[2 * i];
    result[i] = weights.constant * all + weights.first * (once.cosine * cosines + once.sine * sines) +
                weights.second * (twice.cosine * double_cosines + twice.sine * double_sines);
  }
}

void apply(const CyclicWeights& cyclic, const std::vector<Vec3>& ring, std::vector<Vec3>& result, double more_of_own) {
  const std::size_t n = ring.size();
  result.resize(n);
  if (n > kShortRing) {
    apply_by_sums(cyclic, ring, result);
    for (std::size_t i = 0; i < n; ++i) result[i] = result[i] + more_of_own * ring[i];
    return;
  }
  const Turns turns(n);
  ShortWeights weights = {};
  for (std::size_t j = 0; j < n; ++j)
    weights[j] = cyclic.constant + cyclic.first * turns[j].cosine + cyclic.second * turns[2 * j].cosine;
  weights[0] += more_of_own;
  apply_directly(weights, ring, result);
}

}  // namespace

void doo_sabin_corners(const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  const auto n = static_cast<double>(ring.size());
  // A corner has 5 + n for itself, where the cosine gives 5.
  apply({3 / (4 * n), 2 / (4 * n), 0}, ring, result, 0.25);
}

void interior_edge_points(const Vec3& vertex, const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  const auto n = static_cast<double>(ring.size());
  result.resize(ring.size());
  if (ring.size() == 3) {
    apply_directly({5.0 / 12, -1.0 / 12, -1.0 / 12}, ring, result);
  } else if (ring.size() == 4) {
    apply_directly({0.375, 0, -0.125, 0}, ring, result);
  } else {
    apply({0.25 / n, 1 / n, 0.5 / n}, ring, result, 0);
  }
  for (Vec3& point : result) point = 0.75 * vertex + point;
}

void boundary_edge_points(const Vec3& vertex, const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  const std::size_t triangle_count = ring.size() - 1;
  const auto k = static_cast<double>(triangle_count);
  // Half turns are divided among the triangles.
  const Turns turns(2 * triangle_count);
  Vec3 sines, double_sines;
  for (std::size_t j = 1; j < triangle_count; ++j) {
    sines = sines + turns[j].sine * ring[j];
    double_sines = double_sines + turns[2 * j].sine * ring[j];
  }
  // sin(t) / (1 - cos(t)) and sin(2 t) / (cos(t) - cos(2 t)) without differences of numbers that are nearly equal.
  const auto [cosine, sine] = turns[1];
  const double half_cotangent = (1 + cosine) / sine;
  const double quotient = 2 * cosine * half_cotangent / (1 + 2 * cosine);
  result.resize(ring.size());
  for (std::size_t i = 1; i < triangle_count; ++i) {
    const double sine_i = turns[i].sine, double_sine_i = turns[2 * i].sine;
    const double of_vertex = 1 - half_cotangent * sine_i / k;
    const double of_first = (turns[i].cosine - quotient * double_sine_i / k) / 4;
    result[i] = of_vertex * vertex + of_first * (ring.front() - ring.back()) +
                (1 / k) * (sine_i * sines + (0.5 * double_sine_i) * double_sines);
  }
}

}  // namespace algebra3d::subdivision
