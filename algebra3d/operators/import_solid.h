#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/operators/mesh_file.h"
#include "algebra3d/repair/repair_options.h"
#include "algebra3d/repair/solid_from_soup.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {

/// The outcome of importing one mesh file.
struct ImportedSolid {
  std::optional<Volume3d> solid;
  /// One line for people: "ok", "ok: turned right side out", "repaired: ...", or why there is no solid.
  std::string status;
  /// What was tolerated in the file, and what changed no decision, one sentence each.
  std::vector<std::string> remarks;
  SoupReport found;                    ///< in the facets as given
  std::optional<RepairReport> repair;  ///< what was changed; none if the file could not be read, or needed no repair
};

/// Reads a mesh file (mesh_file.h) as a solid: the readers of stl/, then solid_from_soup (repair/), which mends what is
/// no solid. Whatever is wrong with the file is a status, no error. A file without facets is the empty solid. Any
/// number of calls may run at once. Errors: interrupted, out_of_memory.
Result<ImportedSolid> import_solid(const std::filesystem::path& path,
                                   std::optional<stl::MeshFormat> format = std::nullopt,
                                   const RepairOptions& options = {}, const Monitor& monitor = {});

/// A surface, or why there is none, and what there is to say about the file.
struct ImportedSurface {
  std::optional<Surface3d> surface;
  std::string reason;
  std::vector<std::string> remarks;
};

/// The same as a surface (surface_from_soup).
Result<ImportedSurface> import_surface(const std::filesystem::path& path, const Monitor& monitor = {});

}  // namespace algebra3d
