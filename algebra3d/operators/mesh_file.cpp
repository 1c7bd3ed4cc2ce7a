#include "algebra3d/operators/mesh_file.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/repair/polygon_triangles.h"
#include "stl/file_content.h"
#include "stl/foreign_file.h"
#include "stl/obj_reader.h"
#include "stl/off_header.h"
#include "stl/off_reader.h"
#include "stl/stl_reader.h"
#include "stl/unwritten_file.h"

namespace algebra3d {
namespace {

using stl::MeshFormat;

Result<MeshFile> read_as(MeshFormat format, std::string_view bytes, const std::string& name,
                         const std::atomic<bool>* cancel) {
  if (format == MeshFormat::stl) {
    ASSIGN_OR_RETURN(stl::ReadStl read, stl::read_stl(bytes, name, cancel));
    return MeshFile{std::move(read.soup), std::move(read.remarks), format, read.format == stl::Format::binary,
                    read.wrong_count};
  }
  auto read = format == MeshFormat::obj ? stl::read_obj(bytes, name, cancel) : stl::read_off(bytes, name, cancel);
  if (!read) return std::move(read).error();
  const auto header = format == MeshFormat::off ? stl::off_header(bytes) : std::nullopt;
  return MeshFile{triangles_of(read->soup), std::move(read->remarks), format, header && header->is_binary,
                  std::nullopt};
}

}  // namespace

Result<MeshFile> read_mesh_file(const std::filesystem::path& path, std::optional<MeshFormat> format,
                                const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(const stl::InputFile input, stl::InputFile::open(path));
  RETURN_IF_ERROR(stl::refuse_unwritten(input));
  ASSIGN_OR_RETURN(const stl::FileContent file, stl::FileContent::read(input, cancel));
  return read_mesh(file.bytes(), path.string(), format, cancel);
}

Result<MeshFile> read_mesh(std::string_view bytes, const std::string& name, std::optional<MeshFormat> format,
                           const std::atomic<bool>* cancel) {
  if (!format) {
    ASSIGN_OR_RETURN(const MeshFormat detected, stl::detect_mesh_format(bytes, name));
    return read_as(detected, bytes, name, cancel);
  }
  const auto known = stl::format_of_content(bytes);
  if (!known) RETURN_IF_ERROR(stl::refuse_foreign(bytes, name));
  const MeshFormat found = known.value_or(*format);
  auto read = read_as(found, bytes, name, cancel);
  if (found == *format) return read;
  const std::string other = fmt::format("the content is {}, not {}", name_of(found), name_of(*format));
  if (!read) return Error{read.error().code, "{} ({})", read.error().message, other};
  read->remarks.insert(read->remarks.begin(), other + ", and is read as that");
  return read;
}

}  // namespace algebra3d
