#pragma once

#include <cstddef>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"

namespace algebra3d {

/// Computes generalized winding numbers: the sum of the signed solid angles of triangles, which need not be closed, as
/// seen from a point, divided by 4 pi. Close to an integer for nearly closed triangles. Rounded. Source:
/// [jacobson2013], [vanoosterom1983].
class GeneralizedWindingNumbers {
 public:
  /// The soup must outlive this.
  explicit GeneralizedWindingNumbers(const IndexedSoup& soup) : soup_(soup) {}

  /// Cost: linear.
  double at(const Vec3& point) const;
  std::size_t triangle_count() const { return soup_.triangles.size(); }

 private:
  const IndexedSoup& soup_;
};

}  // namespace algebra3d
