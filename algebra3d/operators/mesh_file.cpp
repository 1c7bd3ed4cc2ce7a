#include "algebra3d/operators/mesh_file.h"

#include <utility>

#include "algebra3d/repair/polygon_triangles.h"
#include "stl/obj_reader.h"
#include "stl/off_reader.h"
#include "stl/stl_reader.h"

namespace algebra3d {

Result<MeshFile> read_mesh_file(const std::filesystem::path& path, std::optional<stl::MeshFormat> format,
                                const std::atomic<bool>* cancel) {
  if (!format) {
    ASSIGN_OR_RETURN(format, stl::detect_mesh_format_of_file(path));
  }
  if (*format == stl::MeshFormat::stl) {
    ASSIGN_OR_RETURN(stl::ReadStl read, stl::read_stl_file(path, cancel));
    return MeshFile{std::move(read.soup), std::move(read.remarks)};
  }
  auto read = *format == stl::MeshFormat::obj ? stl::read_obj_file(path, cancel) : stl::read_off_file(path, cancel);
  if (!read) return std::move(read).error();
  return MeshFile{triangles_of(read->soup), std::move(read->remarks)};
}

}  // namespace algebra3d
