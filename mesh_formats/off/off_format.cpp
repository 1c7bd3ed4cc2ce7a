#include "mesh_formats/off/off_format.h"

#include <array>
#include <utility>

#include "base/propagate.h"
#include "mesh_formats/off/off_header.h"
#include "mesh_formats/off/off_reader.h"
#include "mesh_formats/off/off_writer.h"

namespace mesh_formats {

using algebra3d::PolygonSoup;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::array<std::string_view, 1> kOffEndings{".off"};
constexpr std::array<FileForm, 2> kOffForms{
    {{Encoding::ascii, CoordinateRange::doubles}, {Encoding::binary, CoordinateRange::floats}}};

Match detect_off(std::string_view head, std::size_t /*size*/) {
  const auto header = off_header(head);
  return header && (header->is_binary || begins_as_text(head)) ? Match::sure : Match::none;
}

template <Wanted wanted>
Result<MeshContent> read_off_content(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel) {
  A3D_ASSIGN(ReadMesh read, read_off(bytes, file_name, cancel, wanted));
  const auto header = off_header(bytes);
  const Encoding encoding = header && header->is_binary ? Encoding::binary : Encoding::ascii;
  return MeshContent{std::move(read.soup), encoding, std::move(read.remarks), std::nullopt, std::move(read.unread)};
}

Status write_off_content(algebra3d::ByteSink& sink, const Facets& facets, std::string_view /*name*/,
                         Encoding encoding) {
  return write_off(sink, std::get<PolygonSoup>(facets), encoding);
}

}  // namespace

MeshFormat off_format() {
  return {.name = "OFF",
          .title = "an OFF file",
          .variants = " (also COFF, NOFF, binary ones)",
          .endings = kOffEndings,
          .media_type = "application/octet-stream",
          .forms = kOffForms,
          .stores_triangles = false,
          .stores_name = false,
          .detect = detect_off,
          .read = read_off_content<Wanted::shape>,
          .write = write_off_content,
          .attributes = AttributePlaces::points,
          .read_with_attributes = read_off_content<Wanted::attributes>};
}

}  // namespace mesh_formats
