#include "queries/test_runner/detail/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
namespace fs = std::filesystem;

algebra3d::Result<std::unique_ptr<ScratchFolder>> ScratchFolder::make() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return Error{ErrorCode::io_error, "no folder for temporary files: {}", error.message()};
  std::string name = (parent / "algebra3d-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return Error{ErrorCode::io_error, "cannot make the folder '{}'", name};
  return std::unique_ptr<ScratchFolder>(new ScratchFolder(name));
}

ScratchFolder::~ScratchFolder() {
  if (is_kept_) return;
  std::error_code ignored;  // a destructor has nobody to tell
  fs::remove_all(path_, ignored);
}

}  // namespace queries
