#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "algebra3d/kernel/exact/point.h"

/// Random sets of points for the tests of convex sets, most of them degenerate.
namespace algebra3d::clouds {

enum class Kind : std::uint8_t { ball, sphere, small_grid, cylinder, cone, thin, thirds };
inline constexpr int kKinds = 7;

class Cloud {
 public:
  explicit Cloud(std::uint64_t seed) : random_(seed) {}

  std::vector<ExactPoint> draw() {
    const auto kind = static_cast<Kind>(number(kKinds));
    const int count = 4 + number(60);
    std::vector<ExactPoint> points;
    for (int i = 0; i < count; ++i) points.push_back(point(kind));
    for (int i = number(4); i > 0; --i) points.push_back(points[static_cast<std::size_t>(number(count))]);
    return place(points);
  }

 private:
  int number(int below) { return static_cast<int>(random_() % static_cast<std::uint64_t>(below)); }
  double real() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  double whole(int below) { return number(below); }

  ExactPoint point(Kind kind) {
    const double turn = whole(12) * 0.5235987755982988, x = real(), y = real(), z = real();
    switch (kind) {
      case Kind::sphere: {
        const double factor = 1 / length(Vec3{x, y, z});
        return factor * Vec3{x, y, z};
      }
      case Kind::small_grid:
        return Vec3{whole(4), whole(4), whole(3)};
      case Kind::cylinder:
        return Vec3{std::cos(turn), std::sin(turn), whole(3)};
      case Kind::cone: {
        const double height = whole(3);
        return Vec3{(2 - height) * std::cos(turn), (2 - height) * std::sin(turn), height};
      }
      case Kind::thin:
        return Vec3{x, y, number(5) == 0 ? 0x1p-60 * z : 0};
      case Kind::thirds:
        return ExactPoint(RationalVec3(Rational(number(7), 3), Rational(number(7), 3), Rational(number(5), 7)));
      default:
        return Vec3{x, y, z};
    }
  }

  /// Far from the origin, huge, tiny, or as it is.
  std::vector<ExactPoint> place(const std::vector<ExactPoint>& points) {
    const int where = number(6);
    std::vector<ExactPoint> placed;
    for (const ExactPoint& p : points) {
      const Vec3 q = p.approx();
      const auto all = [](double value) { return Vec3{value, value, value}; };
      if (!p.is_double() || where > 3)
        placed.push_back(p);
      else if (where == 0)
        placed.push_back(0x1p-40 * q + all(1e3));
      else if (where == 1)
        placed.push_back(0x1p1000 * q);
      else if (where == 2)
        placed.push_back(0x1p-1060 * q);
      else
        placed.push_back(q + all(1e9));
    }
    return placed;
  }

  std::mt19937_64 random_;
};

inline PointArray array_of(const std::vector<ExactPoint>& points) {
  PointArray array;
  for (const ExactPoint& point : points) array.push_back(point);
  return array;
}

}  // namespace algebra3d::clouds
