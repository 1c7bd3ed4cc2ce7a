#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"

namespace algebra3d {

/// The outcome of reading a mesh file as a solid. The format (STL, OBJ or OFF) follows from content and name.
struct ReadSolid {
  std::optional<Solid> solid;
  /// One line for people: `ok`, `repaired: ...` with what was changed, left out and added, or why there is no solid.
  std::string status;
  /// Irregularities of the file that were tolerated, one sentence each.
  std::vector<std::string> remarks;
  // Amounts of the repair; without a value if they were not measured.
  std::optional<double> area_dropped;      ///< of the facets of the file, outside the solid
  std::optional<double> area_added;        ///< of the solid, where the file has no facet
  std::optional<double> dropped_distance;  ///< no point that was left out is farther from the solid
  std::optional<double> added_distance;    ///< no point that was added or moved is farther from the facets
};

/// Reads a mesh file as a solid. What is no valid solid is repaired; `options` are those of importSTL, as in
/// "holes=5; cracks=0.01" or "strict". Whatever is wrong with the file is a status, no error.
/// Errors: invalid_value for wrong options; interrupted; out_of_memory.
Result<ReadSolid> read_solid(const std::filesystem::path& file, const std::string& options = {},
                             const Monitor& monitor = {});

/// Reads a mesh file as a surface: facets are divided where they cross, and nothing is added. Errors: those of reading,
/// which name the file and the place; interrupted.
Result<Surface> read_surface(const std::filesystem::path& file, const Monitor& monitor = {});

/// Writes a solid as its name's ending says (.stl, .obj, .off): rounded to what the format holds and proved again,
/// whole or not at all. STL is binary. Errors: invalid_value if the solid cannot be rounded, wrong_usage for another
/// ending, io_error with the system's reason; interrupted.
Status write_solid(const Solid& solid, const std::filesystem::path& file, const Monitor& monitor = {});

}  // namespace algebra3d
