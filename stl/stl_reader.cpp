#include "stl/stl_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/ascii_cursor.h"
#include "base/file_content.h"
#include "base/mesh_content.h"
#include "base/propagate.h"
#include "stl/stl_ascii_reader.h"
#include "stl/stl_binary_reader.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FileContent;
using algebra3d::is_blank;
using algebra3d::Keyword;
using algebra3d::Result;

namespace {

// Enough to hold, in a binary file, several facets with their zero bytes.
constexpr std::size_t kSampleBytes = 1024;

bool contains_keyword(std::string_view sample, const Keyword& keyword) {
  AsciiCursor cursor(sample.data(), sample.data() + sample.size());
  for (; !cursor.is_at_end(); cursor.skip_word()) {
    cursor.skip_blanks();
    if (cursor.is_at(keyword)) return true;
  }
  return false;
}

bool begins_like_ascii(std::string_view sample) {
  AsciiCursor cursor(sample.data(), sample.data() + sample.size());
  cursor.skip_blanks();
  return cursor.is_at(Keyword("solid")) && contains_keyword(sample, Keyword("facet")) &&
         contains_keyword(sample, Keyword("vertex"));
}

}  // namespace

Result<Encoding> detect_encoding(std::string_view head, std::size_t size, std::string_view file_name) {
  if (has_announced_size(head, size) || is_big_endian(head, size)) return Encoding::binary;
  if (std::ranges::all_of(head, is_blank))
    return Error{ErrorCode::file_format, "empty file; expected an STL file"}.about(file_name);
  if (begins_as_text(head) || begins_like_ascii(head.substr(0, kSampleBytes))) return Encoding::ascii;
  if (head.size() >= kBinaryPrefixBytes) return Encoding::binary;
  return Error{ErrorCode::file_format,
               "byte {}: file ends; expected 'solid', or the 84 bytes before the facets of a binary file", size}
      .about(file_name);
}

Result<ReadStl> read_stl(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const Encoding format, detect_encoding(bytes, bytes.size(), file_name));
  if (format == Encoding::binary) return read_binary(bytes, file_name, cancel);
  return read_ascii(bytes, file_name, cancel);
}

Result<ReadStl> read_stl_file(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto file = FileContent::read(path, cancel);
  if (!file) return std::move(file).error();
  return read_stl(file->bytes(), path.string(), cancel);
}

}  // namespace mesh_formats
