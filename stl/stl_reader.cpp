#include "stl/stl_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "stl/ascii_cursor.h"
#include "stl/file_content.h"
#include "stl/stl_ascii_reader.h"
#include "stl/stl_binary_reader.h"

namespace stl {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

namespace {

// Enough to hold, in a binary file, several facets with their zero bytes.
constexpr std::size_t kSampleBytes = 1024;

bool is_text(std::string_view sample) {
  return std::none_of(sample.begin(), sample.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' ' && !is_blank(c); });
}

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

Result<Format> detect_format(std::string_view bytes, std::string_view file_name) {
  if (bytes.size() >= kBinaryPrefixBytes &&
      bytes.size() == kBinaryPrefixBytes + announced_facet_count(bytes) * kBinaryFacetBytes)
    return Format::binary;
  if (std::all_of(bytes.begin(), bytes.end(), is_blank))
    return Error{ErrorCode::file_format, "{}: empty file; expected an STL file", file_name};
  const std::string_view sample = bytes.substr(0, kSampleBytes);
  if (is_text(sample) || begins_like_ascii(sample)) return Format::ascii;
  if (bytes.size() >= kBinaryPrefixBytes) return Format::binary;
  return Error{ErrorCode::file_format,
               "{}: byte {}: file ends; expected 'solid', or the 84 bytes before the facets of a binary file",
               file_name, bytes.size()};
}

Result<ReadStl> read_stl(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(const Format format, detect_format(bytes, file_name));
  if (format == Format::binary) return read_binary(bytes, file_name, cancel);
  return read_ascii(bytes, file_name, cancel);
}

Result<ReadStl> read_stl_file(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto file = FileContent::read(path, cancel);
  if (!file) return std::move(file).error();
  return read_stl(file->bytes(), path.string(), cancel);
}

}  // namespace stl
