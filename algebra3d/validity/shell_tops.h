#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The face that a vertical line meets first above the top of a shell.
struct FaceOverhead {
  bool is_known = true;  ///< false if the top touches another shell, or two faces are met at one height
  FaceId face;           ///< invalid: there is none
  int sign = 0;          ///< 1 if its normal points up, else -1
};

/// The highest vertices of the shells of a mesh, and what lies above them: enough to say how shells are nested, with
/// one search for each shell and without counting all the shells around it.
///
/// Requires shells that do not pass through each other, each closed by itself with one winding number in front of it
/// (as in winding.h). Refers to mesh, hierarchy and shells. Calls may run in parallel.
class ShellTops {
 public:
  /// `shell_of_face` numbers the shells from 0. Cost: linear.
  ShellTops(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, std::span<const std::uint32_t> shell_of_face,
            std::size_t shell_count);

  /// All shells, those with the higher top first; so a shell comes after the one that `overhead` finds above it.
  std::vector<std::uint32_t> from_highest() const;

  /// Just above the top, and up to the face, there is nothing: the winding number of all shells together is the same
  /// there, and that of the shell itself is 0. Exact. Cost: the faces whose boxes lie around the line up to the face.
  FaceOverhead overhead(std::uint32_t shell) const;

 private:
  struct Search;

  const TriangleMesh& mesh_;
  const BoxHierarchy& hierarchy_;
  std::span<const std::uint32_t> shell_of_face_;
  std::vector<VertexId> tops_;
};

/// Per shell: 1 if its faces look outward, so that it encloses a positive volume, else -1. `shell_of_face` as above.
/// Exact. Cost: linear, some nanoseconds per face; that of the exact volume for shells that are nearly flat.
std::vector<int> shell_orientations(const TriangleMesh& mesh, std::span<const std::uint32_t> shell_of_face,
                                    std::size_t shell_count);

}  // namespace algebra3d
