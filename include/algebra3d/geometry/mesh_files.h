#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"

namespace algebra3d {

/// The result of reading a mesh file as a solid. The format (STL, OBJ or OFF) is detected from content and name.
struct ReadSolid {
  std::optional<Solid> solid;
  /// One line for people: `ok`, `repaired: ...` with the changes, or why there is no solid.
  std::string status;
  /// Irregularities of the file that were tolerated, one sentence each.
  std::vector<std::string> remarks;
  // Measures of the repair; missing if they were not measured.
  std::optional<double> area_dropped;      ///< of the triangles of the file, outside the solid
  std::optional<double> area_added;        ///< of the solid, where the file has no triangle
  std::optional<double> dropped_distance;  ///< upper bound of the distance of dropped parts from the solid
  std::optional<double> added_distance;    ///< upper bound of the distance of added or moved points from the triangles
};

/// Reads a mesh file as a solid and repairs it if necessary; `options` are those of importSTL, as in "holes=5;
/// gaps=0.01" or "strict". Defects of the file are in the status and are not errors. Errors: invalid_value for wrong
/// options; interrupted; out_of_memory.
Result<ReadSolid> read_solid(const std::filesystem::path& file, const std::string& options = {},
                             const Monitor& monitor = {});

/// Reads a mesh file as a surface: triangles are divided where they cross, and nothing is added. Errors: file_missing
/// and io_error if the file cannot be read, file_format for its content, with the place; limit_exceeded; interrupted.
Result<Surface> read_surface(const std::filesystem::path& file, const Monitor& monitor = {});

/// Writes a solid in the format of the name's ending (.stl, .obj, .off): rounded to the precision of the format and
/// proved again; atomically. STL is binary. Errors: invalid_value if the solid cannot be rounded; wrong_usage for
/// another ending; file_missing (no such folder), disk_full and io_error with the system's reason; interrupted.
Status write_solid(const Solid& solid, const std::filesystem::path& file, const Monitor& monitor = {});

}  // namespace algebra3d
