#include "mesh_formats/off/off_reader.h"

#include <optional>

#include "base/ascii_cursor.h"
#include "base/file_content.h"
#include "base/padding.h"
#include "mesh_formats/off/off_ascii_reader.h"
#include "mesh_formats/off/off_binary_reader.h"
#include "mesh_formats/off/off_header.h"

namespace mesh_formats {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FileContent;
using algebra3d::Result;

Result<ReadMesh> read_off(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel,
                          Wanted wanted) {
  if (is_padding(bytes)) return Error{ErrorCode::file_format, "empty file; expected an OFF file"}.about(file_name);
  const std::optional<OffHeader> header = off_header(bytes);
  if (header && header->is_binary) return read_binary_off(bytes, *header, file_name, wanted, cancel);
  return read_ascii_off(bytes, header.value_or(OffHeader{}), file_name, wanted, cancel);
}

Result<ReadMesh> read_off_file(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto file = FileContent::read(path, cancel);
  if (!file) return std::move(file).error();
  return read_off(file->bytes(), path.string(), cancel);
}

}  // namespace mesh_formats
