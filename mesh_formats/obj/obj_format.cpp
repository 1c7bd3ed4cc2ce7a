#include "mesh_formats/obj/obj_format.h"

#include <array>
#include <utility>

#include "base/propagate.h"
#include "mesh_formats/obj/obj_reader.h"
#include "mesh_formats/obj/obj_statement.h"
#include "mesh_formats/obj/obj_writer.h"

namespace mesh_formats {

using algebra3d::PolygonSoup;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::array<std::string_view, 1> kObjEndings{".obj"};
constexpr std::array<FileForm, 1> kObjForms{{{Encoding::ascii, CoordinateRange::doubles}}};

Match detect_obj(std::string_view head, std::size_t /*size*/) {
  return begins_as_text(head) && obj_statement(first_word(head)) != ObjStatement::unknown ? Match::sure : Match::none;
}

Result<MeshContent> read_obj_content(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel) {
  A3D_ASSIGN(ReadMesh read, read_obj(bytes, file_name, cancel));
  return MeshContent{std::move(read.soup), Encoding::ascii, std::move(read.remarks), std::nullopt,
                     std::move(read.unread)};
}

Result<MeshContent> read_obj_with_attributes(std::string_view bytes, std::string_view file_name,
                                             const std::atomic<bool>* cancel) {
  A3D_ASSIGN(ReadMesh read, read_obj(bytes, file_name, cancel, Wanted::attributes));
  return MeshContent{std::move(read.soup), Encoding::ascii, std::move(read.remarks), std::nullopt,
                     std::move(read.unread)};
}

Status write_obj_content(algebra3d::ByteSink& sink, const Facets& facets, std::string_view name,
                         Encoding /*encoding*/) {
  return write_obj(sink, std::get<PolygonSoup>(facets), name);
}

}  // namespace

MeshFormat obj_format() {
  return {.name = "OBJ",
          .title = "a Wavefront OBJ file",
          .variants = "",
          .endings = kObjEndings,
          .media_type = "model/obj",
          .forms = kObjForms,
          .stores_triangles = false,
          .stores_name = true,
          .detect = detect_obj,
          .read = read_obj_content,
          .write = write_obj_content,
          .attributes = AttributePlaces::corners,
          .read_with_attributes = read_obj_with_attributes};
}

}  // namespace mesh_formats
