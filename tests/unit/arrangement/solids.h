#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// Solids whose corners and triangles are written down directly, without the engine under test.
namespace algebra3d::solids {

/// A corner of a polygon in the plane.
using Corner = std::array<double, 2>;

inline std::vector<TriangleMesh::Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> result;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) result.push_back(mesh.triangle(FaceId(f)));
  return result;
}

/// Welds equal corners as they come.
class Maker {
 public:
  Maker& triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    triangles_.push_back({number(a), number(b), number(c)});
    return *this;
  }
  Maker& quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return triangle(a, b, c).triangle(a, c, d);
  }
  TriangleMesh mesh() const { return {PointArray(points_), triangles_}; }

 private:
  std::uint32_t number(const Vec3& p) {
    const auto [place, is_new] = numbers_.try_emplace(p + Vec3{}, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return place->second;
  }

  std::map<Vec3, std::uint32_t> numbers_;
  std::vector<Vec3> points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

inline TriangleMesh box(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  };
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  Maker maker;
  for (const auto& s : kSides) maker.quad(corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
  return maker.mesh();
}
inline TriangleMesh cube(double low, double high) {
  return box({low, low, low}, {high, high, high});
}

/// Oriented outward, whatever the order of the corners; the sign is exact for small integers.
inline TriangleMesh tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (dot(cross(b - a, c - a), d - a) < 0) return tetrahedron(a, c, b, d);
  return Maker().triangle(a, c, b).triangle(a, b, d).triangle(b, c, d).triangle(c, a, d).mesh();
}

/// From z = low to z = high over a polygon that turns counter-clockwise and is seen whole from its first corner.
inline TriangleMesh prism(std::span<const Corner> polygon, double low, double high) {
  Maker maker;
  const auto at = [&](std::size_t i, double z) {
    const Corner& corner = polygon[i % polygon.size()];
    return Vec3{corner[0], corner[1], z};
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    maker.quad(at(i, low), at(i + 1, low), at(i + 1, high), at(i, high));
    if (i == 0 || i + 1 == polygon.size()) continue;
    maker.triangle(at(0, low), at(i + 1, low), at(i, low)).triangle(at(0, high), at(i, high), at(i + 1, high));
  }
  return maker.mesh();
}

/// The tip over (or under) a polygon at z = base that turns counter-clockwise and is seen whole from its first corner.
inline TriangleMesh pyramid(std::span<const Corner> polygon, double base, const Vec3& tip) {
  Maker maker;
  const bool is_upright = tip.z > base;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    is_upright ? maker.triangle(a, b, c) : maker.triangle(a, c, b);
  };
  const auto at = [&](std::size_t i) {
    const Corner& corner = polygon[i % polygon.size()];
    return Vec3{corner[0], corner[1], base};
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add(at(i), at(i + 1), tip);
    if (i != 0 && i + 1 != polygon.size()) add(at(0), at(i + 1), at(i));
  }
  return maker.mesh();
}

/// Rows of quadrangles from pole to pole, as `createSphere` makes them.
inline TriangleMesh sphere(int rows, int columns, double radius) {
  Maker maker;
  const auto at = [&](int row, int column) {
    if (row == 0) return Vec3{0, 0, radius};
    if (row == rows) return Vec3{0, 0, -radius};
    const double down = std::numbers::pi * row / rows, round = 2 * std::numbers::pi * (column % columns) / columns;
    return Vec3{radius * std::sin(down) * std::cos(round), radius * std::sin(down) * std::sin(round),
                radius * std::cos(down)};
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 a = at(row, column), b = at(row + 1, column), c = at(row + 1, column + 1), d = at(row, column + 1);
      if (row + 1 < rows) maker.triangle(a, b, c);
      if (row > 0) maker.triangle(a, c, d);
    }
  }
  return maker.mesh();
}

/// The octahedron with each edge in `parts` parts, blown up to the unit sphere: 8 parts^2 triangles.
inline TriangleMesh geodesic_sphere(int parts) {
  Maker maker;
  const auto place = [](const Vec3& p) { return (1 / std::sqrt(dot(p, p))) * p; };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign{(octant & 1) != 0 ? -1.0 : 1.0, (octant & 2) != 0 ? -1.0 : 1.0, (octant & 4) != 0 ? -1.0 : 1.0};
    const bool is_mirrored = sign.x * sign.y * sign.z < 0;
    const auto at = [&](int i, int j) { return place({sign.x * (parts - i - j), sign.y * i, sign.z * j}); };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      is_mirrored ? maker.triangle(a, c, b) : maker.triangle(a, b, c);
    };
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < parts) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return maker.mesh();
}

/// The mesh with each corner put where `map` says; all corners are doubles. `map` does not turn bodies inside out.
template <typename Map>
TriangleMesh mapped(const TriangleMesh& mesh, const Map& map) {
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points().approx()) points.push_back(map(p));
  return {PointArray(std::move(points)), triangles_of(mesh)};
}

inline TriangleMesh shifted(const TriangleMesh& mesh, const Vec3& shift) {
  return mapped(mesh, [&](const Vec3& p) { return p + shift; });
}

/// Turned about an axis through the origin, each corner rounded to doubles.
inline TriangleMesh rotated(const TriangleMesh& mesh, const Vec3& axis, double radians) {
  const Vec3 k = (1 / std::sqrt(dot(axis, axis))) * axis;
  const double c = std::cos(radians), s = std::sin(radians);
  return mapped(mesh, [&](const Vec3& p) { return c * p + s * cross(k, p) + ((1 - c) * dot(k, p)) * k; });
}

/// x to y to z to x, `turns` times.
inline TriangleMesh with_axes_permuted(const TriangleMesh& mesh, int turns) {
  return mapped(mesh, [&](Vec3 p) {
    for (int i = 0; i < turns; ++i) p = {p.z, p.x, p.y};
    return p;
  });
}

}  // namespace algebra3d::solids
