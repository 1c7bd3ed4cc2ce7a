#include "stl/off_reader.h"

#include <optional>

#include "stl/ascii_cursor.h"
#include "stl/file_content.h"
#include "stl/off_ascii_reader.h"
#include "stl/off_binary_reader.h"
#include "stl/off_header.h"
#include "stl/text.h"

namespace stl {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

Result<ReadMesh> read_off(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel) {
  if (is_padding(bytes)) return Error{ErrorCode::file_format, "{}: empty file; expected an OFF file", file_name};
  const std::optional<OffHeader> header = off_header(bytes);
  if (header && header->is_binary) return read_binary_off(bytes, *header, file_name, cancel);
  return read_ascii_off(bytes, header.value_or(OffHeader{}), file_name, cancel);
}

Result<ReadMesh> read_off_file(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto file = FileContent::read(path, cancel);
  if (!file) return std::move(file).error();
  return read_off(file->bytes(), path.string(), cancel);
}

}  // namespace stl
