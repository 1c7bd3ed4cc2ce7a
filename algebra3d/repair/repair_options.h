#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// What a repair may do. Lengths are in coordinate units.
struct RepairOptions {
  /// Vertices and edges on boundaries that are closer than this are joined. By default 1e-4 of the diagonal of the box
  /// around the file; never so far that an edge would vanish.
  std::optional<double> crack_tolerance;
  /// Holes with a larger diameter (of the box around the loop) are left open. By default none is for that reason.
  std::optional<double> largest_hole;
  /// Cavities stay; if false, the solid is filled.
  bool keeps_cavities = true;
  /// Bodies and cavities with less volume are left out.
  double smallest_shell = 0;
  /// If a larger part of the area seen would be left out of the solid, there is none; from 0 to 1.
  double most_dropped = 0.9;
  /// No repair: what is no valid solid after welding equal corners is refused.
  bool is_strict = false;
  /// The most pairs of triangles whose boxes meet, of solid angles that are added up, and of thousandths of a cut where
  /// triangles cross, in millions; beyond it the repair gives up.
  double work_limit = 500;

  static RepairOptions strict() {
    RepairOptions options;
    options.is_strict = true;
    return options;
  }
};

/// Options as people write them, separated by semicolons, in any order and each at most once: "cracks=0.001",
/// "holes=20", "cavities=keep" or "cavities=drop", "smallest=0.5", "dropped=0.5", "work=1000", "strict". Lengths,
/// volumes and the work are real numbers that are not negative, `dropped` one from 0 to 1; all but `strict` have a
/// value. The empty text has the defaults. Errors: invalid_value, naming what was found and what was expected.
Result<RepairOptions> parse_repair_options(std::string_view text);

/// The options in the notation of `parse_repair_options`, without those that have their default: the same text exactly
/// for the same options, empty for the defaults.
std::string text_of(const RepairOptions& options);

}  // namespace algebra3d
