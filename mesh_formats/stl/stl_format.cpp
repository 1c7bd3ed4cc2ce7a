#include "mesh_formats/stl/stl_format.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/propagate.h"
#include "stl/stl_binary_reader.h"
#include "stl/stl_reader.h"
#include "stl/stl_writer.h"

namespace mesh_formats {

using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TriangleSoup;

namespace {

constexpr std::array<std::string_view, 1> kStlEndings{".stl"};
constexpr std::array<FileForm, 2> kStlForms{
    {{Encoding::binary, CoordinateRange::floats}, {Encoding::ascii, CoordinateRange::floats}}};

bool is_solid_keyword(std::string_view word) {
  const std::string_view solid = "solid";
  return std::ranges::equal(word, solid, [](char a, char b) { return (a | 0x20) == b; });
}

Match detect_stl(std::string_view head, std::size_t size) {
  const auto encoding = detect_encoding(head, size, "");
  if (!encoding) return Match::none;
  if (*encoding == Encoding::ascii) return is_solid_keyword(first_word(head)) ? Match::sure : Match::none;
  return has_announced_size(head, size) || is_big_endian(head, size) ? Match::sure : Match::possible;
}

Result<MeshContent> read_stl_content(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel) {
  A3D_ASSIGN(ReadStl read, read_stl(bytes, file_name, cancel));
  return MeshContent{std::move(read.soup), read.format, std::move(read.remarks), read.wrong_count};
}

Status write_stl_content(algebra3d::ByteSink& sink, const Facets& facets, std::string_view name, Encoding encoding) {
  return write_stl(sink, std::get<TriangleSoup>(facets), name, encoding);
}

}  // namespace

MeshFormat stl_format() {
  return {.name = "STL",
          .title = "an STL file",
          .variants = ", ASCII or binary",
          .endings = kStlEndings,
          .media_type = "model/stl",
          .forms = kStlForms,
          .stores_triangles = true,
          .stores_name = true,
          .detect = detect_stl,
          .read = read_stl_content,
          .write = write_stl_content};
}

}  // namespace mesh_formats
