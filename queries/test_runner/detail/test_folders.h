#pragma once

#include <filesystem>

namespace queries {

/// The folders of a run of a test file.
struct TestFolders {
  std::filesystem::path file;     ///< folder of the test file
  std::filesystem::path scratch;  ///< initially empty; for databases and files that commands write
};

}  // namespace queries
