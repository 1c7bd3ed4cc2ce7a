#pragma once

#include <filesystem>

namespace queries {

/// Where a run of a test file finds its files.
struct TestFolders {
  std::filesystem::path file;     ///< that of the test file
  std::filesystem::path scratch;  ///< empty at first, for databases and what commands write
};

}  // namespace queries
