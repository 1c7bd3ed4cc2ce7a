#include "base/output_path.h"

#include <system_error>

namespace algebra3d {

OutputPath OutputPath::new_file(std::filesystem::path path) {
  OutputPath output(std::move(path));
  output.may_replace_ = false;
  return output;
}

OutputPath OutputPath::with_cancel(const std::atomic<bool>* cancel) const {
  OutputPath output = *this;
  output.cancel_ = cancel;
  return output;
}

Status OutputPath::check_free(const std::filesystem::path& name) const {
  std::error_code ignored;  // what cannot be looked at cannot be written either
  if (may_replace_ || !std::filesystem::exists(std::filesystem::symlink_status(path_, ignored))) return {};
  return not_replaced(name);
}

Error not_replaced(const std::filesystem::path& name) {
  return {ErrorCode::permission_denied, "'{}' exists, and no file is replaced here; choose another name",
          name.string()};
}

}  // namespace algebra3d
