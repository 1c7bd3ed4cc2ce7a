#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The options of a repair (docs/import.md, "Options"). Lengths are in coordinate units.
struct RepairOptions {
  /// Gaps up to this width are stitched: boundary vertices and edges within this distance are joined. No merge moves a
  /// vertex farther, and no two that are farther apart than a third of a boundary edge at one of them are joined
  /// directly (detail/vertex_merging.h). By default 1e-4 of the diagonal of the box around the file.
  std::optional<double> gap_tolerance;
  /// Holes whose box has a longer diagonal than this stay open. By default all are closed.
  std::optional<double> largest_hole;
  /// False: cavities are filled.
  bool keeps_cavities = true;
  /// Bodies and cavities with less volume, in cubic coordinate units, are removed.
  double smallest_shell = 0;
  /// The largest fraction of the area seen that may be left out, from 0 to 1; beyond it there is no solid.
  double most_dropped = 0.9;
  /// The largest area that may be added, as a fraction of the area seen; beyond it there is no solid. By default any.
  std::optional<double> most_added;
  /// No repair: triangles that do not bound a valid solid after welding are refused.
  bool is_strict = false;
  /// Limit of the work, in millions of units: a pair of triangles whose boxes meet, or a solid angle, is one unit; a
  /// cut where triangles cross is a thousand. Pairs, solid angles and cuts are not added up: each kind has the whole
  /// limit, in each attempt (detail/work_limits.h). An attempt beyond it gives no solid; if it is the first, the repair
  /// ends.
  double work_limit = 500;
  /// Later proofs skip pairs of triangles that the first proof found disjoint (known_triangles.h); false: every proof
  /// tests all pairs. The result is the same. For tests; not part of the notation.
  bool reuses_proofs = true;

  /// The default options, but without a repair.
  static RepairOptions strict() {
    RepairOptions options;
    options.is_strict = true;
    return options;
  }
};

/// Parses options as people write them, separated by semicolons, in any order and each at most once: "gaps=0.001" (or
/// by its old name "cracks=0.001"), "holes=20", "cavities=keep" or "cavities=drop", "smallest=0.5", "dropped=0.5",
/// "added=0.2", "work=1000", "strict". Lengths, volumes and the work are numbers from 0, `dropped` from 0 to 1; all but
/// `strict` have a value. The empty text means the defaults. Errors: invalid_value, with what was found and what was
/// expected.
Result<RepairOptions> parse_repair_options(std::string_view text);

/// The options in the notation of `parse_repair_options`, without those that have their default. Equal options have
/// equal texts. Databases store a hash of it, so each option keeps its first name here.
std::string text_of(const RepairOptions& options);

}  // namespace algebra3d
