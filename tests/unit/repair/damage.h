#pragma once

#include "unit/repair/soups.h"

/// Solids, and ways to damage them.
namespace algebra3d::soups {

inline TriangleMesh l_shaped() {
  // Seen whole from the corner of its notch.
  return solids::prism(std::vector<solids::Corner>{{2, 1}, {2, 2}, {0, 2}, {0, 0}, {4, 0}, {4, 1}}, 0, 3);
}

inline constexpr int kBodyCount = 8;
inline TriangleMesh body(int kind) {
  switch (kind) {
    case 0:
      return solids::box({0, 0, 0}, {4, 2, 3});
    case 1:
      return on_grid(samples::torus(14, 8));
    case 2:
      return on_grid(solids::sphere(6, 9, 2));
    case 3:
      return on_grid(solids::geodesic_sphere(4));
    case 4:
      return l_shaped();
    case 5:
      return samples::MeshMaker().box({0, 0, 0}, {8, 8, 8}).box({2, 2, 2}, {6, 6, 6}, true).mesh();
    case 6:
      return samples::MeshMaker()
          .box({0, 0, 0}, {8, 8, 8})
          .box({1, 1, 1}, {7, 7, 7}, true)
          .box({2, 2, 2}, {6, 6, 6})
          .box({3, 3, 3}, {5, 5, 5}, true)
          .mesh();
    default:
      return samples::MeshMaker()
          .box({0, 0, 0}, {3, 3, 3})
          .box({5, 0, 0}, {9, 3, 2})
          .tetrahedron({0, 10, 0}, {4, 10, 0}, {0, 14, 0}, {0, 10, 4})
          .mesh();
  }
}

// Ways to damage a soup that leave every point of space inside or outside as it was meant to be.

/// Flips triangles; of each connected component of the soup less than two fifths of the area.
inline void turn_some(TriangleSoup& soup, Chance& chance) {
  const TriangleMesh mesh = mesh_of(soup);
  const FaceComponents parts = connected_components(mesh);
  std::vector<double> area(parts.count), gone(parts.count);
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) area[parts.of_face[f]] += area_of(soup.triangles[f]);
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    double& turned_area = gone[parts.of_face[f]];
    if (!chance.one_in(4) || turned_area + area_of(soup.triangles[f]) > 0.4 * area[parts.of_face[f]]) continue;
    turned_area += area_of(soup.triangles[f]);
    soup.triangles[f] = turned(soup.triangles[f]);
  }
}

inline void repeat_some(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 5); n > 0; --n)
    soup.triangles.push_back(soup.triangles[index_below(chance, soup.triangles.size())]);
}

inline void add_degenerate_ones(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 5); n > 0; --n) {
    const auto [a, b, c] = soup.triangles[index_below(chance, soup.triangles.size())];
    switch (chance.below(3)) {
      case 0:
        soup.triangles.push_back({a, b, a});
        break;
      case 1:
        soup.triangles.push_back({c, c, c});
        break;
      default:
        soup.triangles.push_back({a, b, 0.5 * a + 0.5 * b});
        break;
    }
  }
}

/// Halves triangles whose neighbours stay whole.
inline void divide_some(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 6); n > 0; --n) {
    SoupTriangle& triangle = soup.triangles[index_below(chance, soup.triangles.size())];
    const auto [a, b, c] = triangle;
    const Vec3 middle = 0.5 * a + 0.5 * b;
    triangle = {a, middle, c};
    soup.triangles.push_back({middle, b, c});
  }
}

inline void shuffle_triangles(TriangleSoup& soup, Chance& chance) {
  shuffle(soup, chance);
}

/// Moves the corners of each triangle away from those of its neighbours, by no more than this in each coordinate.
inline void open_gaps(TriangleSoup& soup, Chance& chance, double size) {
  for (SoupTriangle& t : soup.triangles)
    for (Vec3& corner : t) corner = corner + size * Vec3{chance.unit(), chance.unit(), chance.unit()};
}

using Damage = void (*)(TriangleSoup& soup, Chance& chance);

}  // namespace algebra3d::soups
