#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/repair/solid_from_soup.h"
#include "algebra3d/kernel/repair/soup_report.h"
#include "algebra3d/values/conversions/mesh_file.h"
#include "algebra3d/values/types/spatial.h"
#include "base/mesh_content.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {

/// The measures of an import, all finite. A measure is missing if it does not apply or is beyond the range of doubles.
struct ImportMeasures {
  std::optional<std::uint64_t> facets_dropped;  ///< triangles of the file outside the solid, at least in part
  std::optional<double> area_seen;              ///< of the triangles of the file; overlaps count once
  std::optional<double> area_dropped;           ///< part of `area_seen` outside the solid
  std::optional<double> area_added;             ///< of the solid, where the file has no triangle
  std::optional<double> dropped_distance;       ///< upper bound of the distance of dropped parts from the solid
  std::optional<double> added_distance;  ///< upper bound of the distance of added or moved points from the triangles
  std::optional<double> volume_before;   ///< of the triangles, if they are closed
  std::optional<double> volume_after;    ///< of the solid
};

/// The result of importing one mesh file.
struct ImportedSolid {
  std::optional<Volume3d> solid;
  /// One line for people: "ok", "ok: turned right side out", "repaired: ...", or why there is no solid; followed by ";
  /// wrong count: ..." if the file's header and size disagree, and by "; 2 polygons are not planar, ...".
  std::string status;
  /// The error that the status tells, if there was one. Its subject is the file if that could not be read.
  std::optional<Error> failure;
  /// Tolerated irregularities of the file and other remarks, one sentence each.
  std::vector<std::string> remarks;
  std::optional<mesh_formats::WrongCount> wrong_count;  ///< of a binary STL file
  BentPolygons bent;                                    ///< of formats with polygons
  /// False if the file could not be read to its end, or was changed meanwhile; another attempt may succeed.
  bool was_read = true;
  SoupReport found;  ///< in the triangles as given
  ImportMeasures measures;
  std::optional<RepairReport> repair;  ///< the changes; nothing if the file could not be read, or needed no repair

  /// The status, behind the file if that could not be read.
  std::string text() const { return failure ? failure->text() : status; }
  /// The status behind the file: as its error calls it, if it could not be read, and else `name`.
  std::string text_about(std::string_view name) const;
};

/// Reads a mesh file (mesh_file.h) as a solid: by the readers of mesh_formats/, then by solid_from_soup (repair/),
/// which repairs it. Defects of the file are in the status and are not errors. With strict options a wrong count in the
/// header also prevents a solid. A file without triangles is the empty solid. Concurrent calls are safe. Errors:
/// interrupted, out_of_memory.
Result<ImportedSolid> import_solid(const std::filesystem::path& path, const mesh_formats::MeshFormat* format = nullptr,
                                   const RepairOptions& options = {}, const Monitor& monitor = {});

/// As above, for a mesh file that has been read, or could not be read.
Result<ImportedSolid> import_solid(Result<MeshFile> read, const RepairOptions& options, const Monitor& monitor = {});

/// The result of importing a mesh file as a surface: the surface or the error that says why there is none, and remarks.
struct ImportedSurface {
  std::optional<Surface3d> surface;
  std::optional<Error> refusal;
  std::vector<std::string> remarks;
};

/// Reads a mesh file as a surface (surface_from_soup).
Result<ImportedSurface> import_surface(const std::filesystem::path& path, const Monitor& monitor = {});

/// As above, for a mesh file that has been read, or could not be read.
Result<ImportedSurface> import_surface(Result<MeshFile> read, const Monitor& monitor = {});

}  // namespace algebra3d
