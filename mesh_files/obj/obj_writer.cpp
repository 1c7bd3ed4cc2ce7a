#include "mesh_files/obj/obj_writer.h"

#include <string>

#include "algebra3d/base/atomic_file.h"
#include "algebra3d/base/number_text.h"
#include "algebra3d/base/text.h"
#include "mesh_files/detail/soup_check.h"

namespace mesh_files {

using algebra3d::append_number;
using algebra3d::AtomicFile;
using algebra3d::one_line;
using algebra3d::PolygonSoup;
using algebra3d::Status;
using algebra3d::Vec3;

namespace {

// A backslash at the end of the line would join the next one to it.
std::string object_line(std::string_view name) {
  return "o " + std::string(name) + (name.ends_with('\\') ? " \n" : "\n");
}

Status append_obj(AtomicFile& file, const PolygonSoup& soup, std::string_view name) {
  if (!name.empty()) ALGEBRA3D_RETURN_IF_ERROR(file.append(object_line(name)));
  std::string line;
  for (const Vec3& point : soup.points) {
    line = "v";
    for (std::size_t axis = 0; axis < 3; ++axis) append_number(line += ' ', point[axis]);
    ALGEBRA3D_RETURN_IF_ERROR(file.append(line += '\n'));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    line = "f";
    for (const std::uint32_t corner : soup.face(i)) append_number(line += ' ', corner + 1);
    ALGEBRA3D_RETURN_IF_ERROR(file.append(line += '\n'));
  }
  return {};
}

Status write_obj(const std::filesystem::path& path, const PolygonSoup& soup, std::string_view name) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  ALGEBRA3D_RETURN_IF_ERROR(append_obj(*file, soup, one_line(name)));
  return file->commit();
}

}  // namespace

Status write_obj_file(const std::filesystem::path& path, const PolygonSoup& soup, std::string_view name) {
  ALGEBRA3D_RETURN_IF_ERROR(check_soup(path, soup, CoordinateRange::doubles));
  return write_obj(path, soup, name);
}

}  // namespace mesh_files
