#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

/// The agreement of a solid with the space that triangles enclose by parity, as lengths along sample lines.
struct Agreement {
  double enclosed = 0;  ///< by the triangles: between an odd crossing with them and the next even one
  double missing = 0;   ///< the part of `enclosed` outside the solid
  double held = 0;      ///< by the solid: inside it
  double added = 0;     ///< the part of `held` not `enclosed` where also the triangles' winding number is 0

  /// True if much is lost or added, so that other strategies should be tried.
  bool is_doubtful() const { return missing > enclosed / 10 || added > held / 4; }
  /// True if most is lost or added: the solid is not the one that the triangles were meant to bound.
  bool is_wrong() const { return missing > enclosed / 2 || added > held / 2; }
};

/// A ray-parity estimate: a cheap sample of the space that triangles enclose, to compare solids with. The triangles
/// need be neither closed nor consistently oriented. A point on one of 96 lines along the axes is enclosed if an odd
/// number of triangles is crossed before it. Each line passes through a triangle, along the axis nearest to its normal;
/// half of the lines are spread over the area, half over the number of triangles. Triangles with the same corners count
/// once. Lines with an odd number of crossings, as through a hole or an interface, are ignored; if these are three
/// quarters of all lines, there is no estimate, and every solid agrees. Parity cannot distinguish the overlap of two
/// bodies from a cavity; so an overlap never counts as missing, nor as added if the bodies have the same orientation.
/// Deterministic. Decisions: rounded. Cost: linear, some nanoseconds per triangle.
class ParityEstimate {
 public:
  /// Chooses lines through the triangles, and finds what is enclosed along them. `left_out`: a flag per face; those
  /// whose flag is set do not count; empty: all count.
  explicit ParityEstimate(const TriangleMesh& mesh, const IdVector<FaceId, bool>& left_out = {});

  /// Compares a solid with the triangles along the same lines. Cost: linear in the solid.
  Agreement compare(const TriangleMesh& solid) const;
  /// True if there is no estimate, or the triangles enclose nothing on the sample lines. Without an estimate compare()
  /// doubts no solid; if nothing is enclosed, it may still doubt one for the area that is added.
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
  using CrossingLists = std::vector<std::vector<Crossing>>;  // per line, ascending

  void choose_lines(const TriangleMesh& mesh, std::span<const FaceId> counted);
  static Line line_through(const TriangleMesh& mesh, FaceId face, std::size_t number);
  CrossingLists crossings(const TriangleMesh& mesh, std::span<const FaceId> counted) const;
  void cross_with(const TriangleMesh& mesh, FaceId face, const std::array<std::vector<double>, 3>& us,
                  CrossingLists& result) const;
  static void compare_along(const std::vector<Crossing>& given, const std::vector<Crossing>& solid, Agreement& result);

  std::vector<Line> lines_;  // by axis, then by u
  double total_ = 0;
};

}  // namespace algebra3d
