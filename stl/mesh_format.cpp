#include "stl/mesh_format.h"

#include <algorithm>
#include <optional>
#include <string>

#include "stl/ascii_cursor.h"
#include "stl/file_content.h"
#include "stl/foreign_file.h"
#include "stl/obj_statement.h"
#include "stl/off_header.h"
#include "stl/stl_binary_reader.h"
#include "stl/stl_reader.h"

namespace stl {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

namespace {

std::string_view first_word(std::string_view bytes) {
  AsciiCursor cursor(bytes.data(), bytes.data() + bytes.size());
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.move_to(bytes.data() + 3);
  cursor.skip_space();
  const char* const begin = cursor.position();
  cursor.skip_word();
  return {begin, static_cast<std::size_t>(cursor.position() - begin)};
}

bool is_solid_keyword(std::string_view word) {
  const std::string_view solid = "solid";
  return std::equal(word.begin(), word.end(), solid.begin(), solid.end(),
                    [](char a, char b) { return (a | 0x20) == b; });
}

std::optional<MeshFormat> format_of_text(std::string_view bytes) {
  if (off_header(bytes)) return MeshFormat::off;
  const std::string_view word = first_word(bytes);
  if (is_solid_keyword(word)) return MeshFormat::stl;
  if (obj_statement(word) != ObjStatement::unknown) return MeshFormat::obj;
  return std::nullopt;
}

}  // namespace

std::optional<MeshFormat> format_of_name(std::string_view file_name) {
  std::string ending = std::filesystem::path(file_name).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".off") return MeshFormat::off;
  return std::nullopt;
}

std::string_view name_of(MeshFormat format) {
  return format == MeshFormat::stl ? "STL" : format == MeshFormat::obj ? "OBJ" : "OFF";
}

std::optional<MeshFormat> format_of_content(std::string_view bytes) {
  if (bytes.size() >= kBinaryPrefixBytes &&
      bytes.size() == kBinaryPrefixBytes + announced_facet_count(bytes) * kBinaryFacetBytes)
    return MeshFormat::stl;
  if (const auto header = off_header(bytes); header && header->is_binary) return MeshFormat::off;
  // The header of a binary STL file may begin with any word.
  const auto format = detect_format(bytes, "");
  return format && *format == Format::ascii ? format_of_text(bytes) : std::nullopt;
}

Result<MeshFormat> detect_mesh_format(std::string_view bytes, std::string_view file_name) {
  if (const auto format = format_of_content(bytes)) return *format;
  RETURN_IF_ERROR(refuse_foreign(bytes, file_name));
  if (const auto format = format_of_name(file_name)) return *format;
  if (const auto format = detect_format(bytes, file_name); format && *format == Format::binary) return MeshFormat::stl;
  return Error{ErrorCode::file_format, "{}: neither content nor name is that of a mesh file; expected STL, OBJ or OFF",
               file_name};
}

Result<MeshFormat> detect_mesh_format_of_file(const std::filesystem::path& path) {
  auto file = FileContent::read(path);
  if (!file) return std::move(file).error();
  return detect_mesh_format(file->bytes(), path.string());
}

}  // namespace stl
