#pragma once

#include <atomic>
#include <ostream>

#include "algebra3d/registry/registry.h"
#include "queries/importer/file_loader.h"
#include "queries/importer/import_options.h"

namespace queries {

/// What an import uses of its surroundings. All that is referred to outlives the import.
struct ImportHost {
  const algebra3d::Registry& registry;
  std::ostream& out;  ///< takes the summary
  std::ostream& err;  ///< takes progress and errors
  bool err_is_terminal = false;
  /// Ends the import when it is set: what is complete is committed.
  const std::atomic<bool>* cancel = nullptr;
  SolidReader reader;  ///< empty: algebra3d::import_solid
};

/// Imports mesh files into a relation of a database: `Name: string` (the file name without extension), `File: text`
/// (the absolute, lexically normal path; symbolic links are not followed), `Solid: volume3d`, `Status: text` ("ok",
/// what was changed, or why the solid is undefined; without the path), and numbers about what was changed, undefined
/// where there are none: `FacetsDropped: int`, and as real `AreaSeen`, `AreaDropped`, `AreaAdded`, `DroppedDistance`,
/// `AddedDistance`, `VolumeBefore`, `VolumeAfter` (ImportMeasures). A relation of an earlier version, which lacks the
/// numbers, is added to as it is, and a note says so. Files are loaded by all cores and written by the calling thread,
/// in the order of their paths, in batches that are one transaction each: the relation does not depend on the threads,
/// and after a crash or an error the database is as after some batch.
///
/// A file that was imported before (same path, size and hash, and with the same repair options) is passed over, even if
/// its tuple was deleted since; one that has changed replaces its tuple, and so does one that could not be read to the
/// end the last time, or that was imported with other repair options. So running the
/// same import again completes one that was interrupted.
///
/// With `drops_gone` the tuples go whose files were meant by the given folders and patterns and are not there any more.
///
/// Gives the exit status: 0 all files were taken in, with or without a solid; 1 the import failed (a path or the
/// database; also if a folder could not be read, though all else is imported); 2 wrong usage; 130 interrupted. Nothing
/// is changed before all paths are found to exist. Never throws.
int run_import(const ImportOptions& options, const ImportHost& host);

/// The same with standard output, standard error and STL files.
int run_import(const ImportOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel);

}  // namespace queries
