#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/kernel/repair/repair_options.h"

namespace queries {

/// The options of `algebra3d import`.
struct ImportOptions {
  std::filesystem::path database;      ///< created if it does not exist
  std::string relation;                ///< created if it does not exist
  std::vector<std::string> paths;      ///< files, folders, patterns of glob(3)
  bool drops_gone = false;             ///< delete the tuples of deleted files
  bool quiet = false;                  ///< no progress and no summary
  int jobs = 0;                        ///< number of loading threads; 0: one per core
  std::optional<double> file_seconds;  ///< a file that takes longer has no solid; nothing: no limit

  algebra3d::RepairOptions repair;  ///< repair of files that are not valid solids

  // Limits of a batch of files, which is one transaction: it ends with the file that reaches a limit.
  double batch_seconds = 5;
  double batch_megabytes = 256;  ///< 10^6 bytes of file size
};

}  // namespace queries
