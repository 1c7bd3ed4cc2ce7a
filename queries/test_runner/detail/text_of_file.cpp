#include "queries/test_runner/detail/text_of_file.h"

#include "base/file_content.h"

namespace queries {

algebra3d::Result<std::string> read_text(const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  auto content = algebra3d::FileContent::read(file, cancel);
  if (content) return std::string(content->bytes());
  if (content.error().code != algebra3d::ErrorCode::file_missing) return std::move(content).error();
  return algebra3d::Error{algebra3d::ErrorCode::file_missing, "cannot read '{}'", file.string()};
}

}  // namespace queries
