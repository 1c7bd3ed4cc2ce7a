#pragma once

#include <cstdint>
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

/// Numbers about an import, all finite. Each is none where there is nothing to say, or a double cannot hold it.
struct ImportMeasures {
  std::optional<std::uint64_t> facets_dropped;  ///< facets of the file outside the solid, at least in part
  std::optional<double> area_seen;              ///< of the facets of the file; what lies upon each other counts once
  std::optional<double> area_dropped;           ///< of that, outside the solid
  std::optional<double> area_added;             ///< of the solid, where the file has no facet
  std::optional<double> dropped_distance;       ///< no point that was left out is farther from the solid
  std::optional<double> added_distance;         ///< no point that was added or moved is farther from the facets
  std::optional<double> volume_before;          ///< of the facets, if they are closed
  std::optional<double> volume_after;           ///< of the solid
};

/// The outcome of importing one mesh file.
struct ImportedSolid {
  std::optional<Volume3d> solid;
  /// One line for people: "ok", "ok: turned right side out", "repaired: ...", or why there is no solid; with "; wrong
  /// count: ..." behind it if the file's header and size disagree.
  std::string status;
  /// What was tolerated in the file, and what changed no decision, one sentence each.
  std::vector<std::string> remarks;
  std::optional<stl::WrongCount> wrong_count;  ///< of a binary STL file
  /// False if the file could not be read to its end, or was changed meanwhile: another try may give something else.
  bool was_read = true;
  SoupReport found;  ///< in the facets as given
  ImportMeasures measures;
  std::optional<RepairReport> repair;  ///< what was changed; none if the file could not be read, or needed no repair
};

/// Reads a mesh file (mesh_file.h) as a solid: the readers of stl/, then solid_from_soup (repair/), which mends what is
/// no solid. Whatever is wrong with the file is a status, no error. With strict options a wrong count in the header is
/// a reason for no solid, too. A file without facets is the empty solid. Any number of calls may run at once. Errors:
/// interrupted, out_of_memory.
Result<ImportedSolid> import_solid(const std::filesystem::path& path,
                                   std::optional<stl::MeshFormat> format = std::nullopt,
                                   const RepairOptions& options = {}, const Monitor& monitor = {});

/// The same of a mesh file that was read before, or could not be read.
Result<ImportedSolid> import_solid(Result<MeshFile> read, const RepairOptions& options, const Monitor& monitor = {});

/// A surface, or why there is none, and what there is to say about the file.
struct ImportedSurface {
  std::optional<Surface3d> surface;
  std::string reason;
  std::vector<std::string> remarks;
};

/// The same as a surface (surface_from_soup).
Result<ImportedSurface> import_surface(const std::filesystem::path& path, const Monitor& monitor = {});

}  // namespace algebra3d
