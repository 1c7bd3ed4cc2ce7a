#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "algebra3d/repair/repair_options.h"

namespace queries {

/// What `algebra3d import` was asked to do.
struct ImportOptions {
  std::filesystem::path database;  ///< created if it is not there
  std::string relation;            ///< created if it is not there
  std::vector<std::string> paths;  ///< files, folders, patterns of glob(3)
  bool drops_gone = false;         ///< tuples of files that are gone are dropped
  bool quiet = false;              ///< neither progress nor summary
  int jobs = 0;                    ///< threads that load files; 0: one for each core that the process may use

  algebra3d::RepairOptions repair;  ///< what may be done to files that are no solids

  // A batch of whole files is one transaction; it ends with the file that reaches a limit, or when its time is up.
  double batch_seconds = 5;
  double batch_megabytes = 256;  ///< 10^6 bytes of files as they lie on disk
};

}  // namespace queries
