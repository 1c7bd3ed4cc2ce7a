#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/repair/facet_list.h"

namespace algebra3d {

/// Winding numbers about points of facets that need not be closed: the sum of the solid angles under which the point
/// sees them, by those of a sphere. Near to a whole number where little is missing. Rounded.
/// Source: [jacobson2013], [vanoosterom1983].
class WindingNumbers {
 public:
  /// The list must outlive this.
  explicit WindingNumbers(const FacetList& facets) : facets_(facets) {}

  /// Cost: linear.
  double at(const Vec3& point) const;
  std::size_t facet_count() const { return facets_.triangles.size(); }

 private:
  const FacetList& facets_;
};

}  // namespace algebra3d
