#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// What a solid holds of that which facets enclose, as lengths along some lines.
struct Agreement {
  double enclosed = 0;  ///< between an odd and the next even crossing with the facets
  double lost = 0;      ///< of that, what the solid does not hold
  double held = 0;      ///< by the solid
  double added = 0;  ///< of that, where the facets are crossed an even number of times, as often one way as the other

  /// Much of it is missing, or made up: worth trying to do better.
  bool is_doubtful() const { return lost > enclosed / 10 || added > held / 4; }
  /// Most of it is missing, or made up: the solid is not what the facets mean.
  bool is_wrong() const { return lost > enclosed / 2 || added > held / 2; }
};

/// A cheap estimate of what facets enclose that need be neither closed nor consistently oriented, to compare solids
/// with: where some lines along the axes are inside, counting crossings. Each line passes through a facet, along the
/// axis that is nearest to its normal; half of them are spread over the area, half over the number of facets. Facets
/// with the same corners count once. A line that crosses an odd number of facets, as through a hole or an inner wall,
/// says nothing; nor does any if three quarters of them do not. It cannot tell apart what lies in two overlapping
/// bodies and what lies in a cavity, so that it never takes the former for lost, nor for added, if the bodies look the
/// same way. Deterministic. Decisions: rounded. Cost: linear, some nanoseconds per facet.
class Enclosure {
 public:
  explicit Enclosure(const TriangleMesh& facets);

  Agreement compare(const TriangleMesh& solid) const;
  /// Nothing, as far as the lines can tell.
  bool is_empty() const { return !(total_ > 0); }

 private:
  struct Crossing {
    double at;
    int sign;
    TriangleMesh::Triangle corners;  // ascending
  };
  struct Line {
    std::size_t axis;
    double u, v;  // its coordinates along the next axis and the one after that
    std::vector<Crossing> crossings;
  };

  void choose_lines(const TriangleMesh& facets);
  std::vector<std::vector<Crossing>> crossings(const TriangleMesh& mesh) const;

  std::vector<Line> lines_;  // by axis, then by u
  double total_ = 0;
};

}  // namespace algebra3d
