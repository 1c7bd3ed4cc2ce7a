#pragma once

#include <atomic>
#include <ostream>

#include "algebra3d/operators/registry/registry.h"
#include "queries/importer/detail/file_loader.h"
#include "queries/importer/import_options.h"

namespace queries {

/// The environment of an import. Everything that it refers to outlives the import.
struct ImportHost {
  const algebra3d::Registry& registry;
  std::ostream& out;  ///< receives the summary
  std::ostream& err;  ///< receives progress and errors
  bool err_is_terminal = false;
  /// If set, the import ends; complete files are committed.
  const std::atomic<bool>* cancel = nullptr;
  SolidReader reader;  ///< empty: algebra3d::import_solid
};

/// Imports mesh files into a relation of a database: `Name: string` (the file name without extension), `File: text`
/// (the absolute, lexically normal path; symbolic links are not followed), `Solid: volume3d`, `Status: text` ("ok", the
/// changes, or why the solid is undefined; without the path), and measures of the changes, which may be undefined:
/// `FacetsDropped: int`, and as real `AreaSeen`, `AreaDropped`, `AreaAdded`, `DroppedDistance`, `AddedDistance`,
/// `VolumeBefore`, `VolumeAfter` (ImportMeasures). A relation of an earlier version without the measures stays without
/// them, and a note says so. Files are loaded by all cores and written by the calling thread in the order of their
/// paths, in batches of one transaction each: the relation does not depend on the threads, and after a crash or an
/// error the database is as after the last complete batch.
///
/// A file that was imported before (same path, size, hash and repair options) is skipped, even if its tuple was deleted
/// since. A file that has changed, could not be read to its end last time, or was imported with other repair options
/// replaces its tuple. So repeating an interrupted import completes it.
///
/// With `drops_gone` the tuples of files that match the given folders and patterns and no longer exist are deleted.
///
/// Returns the exit status: 0 all files were imported, with or without a solid; 1 the import failed (a path or the
/// database; also if a folder could not be read, although all else is imported); 2 wrong usage; 130 interrupted.
/// Nothing is changed unless all paths exist. Never throws.
int run_import(const ImportOptions& options, const ImportHost& host);

/// Imports with standard output, standard error and STL files.
int run_import(const ImportOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel);

}  // namespace queries
