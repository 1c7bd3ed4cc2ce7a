#pragma once

#include <cstddef>
#include <limits>
#include <optional>

namespace algebra3d {

/// What a repair may do. Lengths are in coordinate units.
struct RepairOptions {
  /// Vertices and edges on boundaries that are closer than this are joined. By default 1e-4 of the diagonal of the box
  /// around the file; never so far that an edge would vanish.
  std::optional<double> crack_tolerance;
  /// Holes with a larger diameter (of the box around the loop) are left open. By default half the diagonal of the box
  /// around the file.
  std::optional<double> largest_hole;
  /// Cavities stay; if false, the solid is filled.
  bool keeps_cavities = true;
  /// Bodies and cavities with less volume are left out.
  double smallest_shell = 0;
  /// No repair: what is no valid solid after welding equal corners is refused.
  bool is_strict = false;
  /// The most pairs of triangles whose boxes meet, and of solid angles that are added up, in millions; beyond it the
  /// repair gives up.
  double work_limit = 500;
};

}  // namespace algebra3d
