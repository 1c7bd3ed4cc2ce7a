#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "algebra3d/base/vec3.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// A random position for the triangles of a file: a turn, a factor of 10^-4 to 10^4, and a move by up to 10^5 times the
/// factor. Coordinates are rounded. Depends on the seed alone, with every standard library.
class Placement {
 public:
  explicit Placement(std::uint64_t seed) : engine_(seed) {
    const Vec3 first = direction(), helper = direction();
    const Vec3 x = (1 / length(first)) * first;
    const Vec3 z = cross(x, helper);
    axes_ = {x, cross((1 / length(z)) * z, x), (1 / length(z)) * z};
    factor_ = std::pow(10.0, below(9) - 4);
    shift_ = (factor_ * std::pow(10.0, below(7) - 1)) * direction();
  }

  TriangleSoup of(TriangleSoup soup) const {
    for (TriangleSoup::Triangle& t : soup.triangles)
      for (Vec3& p : t) p = factor_ * (p.x * axes_[0] + p.y * axes_[1] + p.z * axes_[2]) + shift_;
    return soup;
  }

 private:
  int below(int limit) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(limit)); }
  double unit() { return static_cast<double>(static_cast<std::int64_t>(engine_())) * 0x1p-63; }
  Vec3 direction() {
    const double x = unit(), y = unit();
    return {x, y, unit() + 1.5};
  }

  std::mt19937_64 engine_;
  std::array<Vec3, 3> axes_;
  double factor_ = 1;
  Vec3 shift_;
};

}  // namespace algebra3d
