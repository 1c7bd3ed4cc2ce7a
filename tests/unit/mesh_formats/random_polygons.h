#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "base/polygon_soup.h"

inline algebra3d::PolygonSoup polygon_soup(std::vector<algebra3d::Vec3> points,
                                           const std::vector<std::vector<std::uint32_t>>& faces) {
  algebra3d::PolygonSoup soup;
  soup.points = std::move(points);
  for (const auto& face : faces) soup.add_face(face);
  return soup;
}

/// `count` points of any bit pattern (all exponents, subnormals and zeros of both signs) that is finite as a Number,
/// float or double, and about as many faces of 3 to 9 corners.
template <typename Number = double>
algebra3d::PolygonSoup random_polygons(std::size_t count) {
  using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
  std::mt19937_64 random(20240601);
  algebra3d::PolygonSoup soup;
  const auto number = [&] {
    for (;;) {
      auto bits = static_cast<Bits>(random());
      if (random() % 8 == 0) bits &= sizeof(Number) == 8 ? static_cast<Bits>(0x800fffffffffffffU) : Bits{0x807fffffU};
      const auto value = std::bit_cast<Number>(bits);
      if (std::isfinite(value)) return static_cast<double>(value);
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = number();
    const double y = number();
    soup.points.push_back({x, y, number()});
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::uint32_t> face(3 + random() % 7);
    for (std::uint32_t& corner : face) corner = static_cast<std::uint32_t>(random() % count);
    soup.add_face(face);
  }
  return soup;
}
