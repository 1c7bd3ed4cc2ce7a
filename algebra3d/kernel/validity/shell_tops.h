#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// The first face on the vertical line above the top of a shell.
struct FaceOverhead {
  bool is_known = true;  ///< false if the top touches another shell, or two faces are at the same height
  FaceId face;           ///< invalid if there is none
  int sign = 0;          ///< 1 if its normal points up, else -1
};

/// The highest vertices of the shells of a mesh and the faces above them. They determine the nesting of the shells with
/// one search per shell.
///
/// Requires shells that do not cross each other, each closed and with one winding number in front of it (as in
/// winding.h). Refers to mesh, hierarchy and shells. Concurrent calls are safe.
class ShellTops {
 public:
  /// `shell_of_face`: the number of each face's shell, from 0. Cost: linear.
  ShellTops(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, std::span<const std::uint32_t> shell_of_face,
            std::size_t shell_count);

  /// All shells by descending height of their tops; so a shell comes after the one that `overhead` finds above it.
  std::vector<std::uint32_t> from_highest() const;

  /// The first face above the top of a shell. Between them the winding number of the whole mesh is constant, and that
  /// of the shell is 0. Exact. Cost: the faces whose boxes meet the line up to the face.
  FaceOverhead overhead(std::uint32_t shell) const;

 private:
  struct Search;

  const TriangleMesh& mesh_;
  const BoxHierarchy& hierarchy_;
  std::span<const std::uint32_t> shell_of_face_;
  std::vector<VertexId> tops_;
};

/// Per shell: 1 if it is oriented outward, so that its volume is positive, else -1. `shell_of_face` as above. Exact.
/// Cost: linear, some nanoseconds per face; that of the exact volume for nearly flat shells.
std::vector<int> shell_orientations(const TriangleMesh& mesh, std::span<const std::uint32_t> shell_of_face,
                                    std::size_t shell_count);

}  // namespace algebra3d
