#include "stl/obj_writer.h"

#include <string>

#include "stl/atomic_file.h"
#include "stl/soup_check.h"
#include "stl/text.h"

namespace stl {

using algebra3d::PolygonSoup;
using algebra3d::Status;
using algebra3d::Vec3;

namespace {

// A backslash at the end of the line would join the next one to it.
std::string object_line(std::string_view name) {
  return "o " + std::string(name) + (name.ends_with('\\') ? " \n" : "\n");
}

Status append_obj(AtomicFile& file, const PolygonSoup& soup, std::string_view name) {
  if (!name.empty()) RETURN_IF_ERROR(file.append(object_line(name)));
  std::string line;
  for (const Vec3& point : soup.points) {
    line = "v";
    for (std::size_t axis = 0; axis < 3; ++axis) append_number(line += ' ', point[axis]);
    RETURN_IF_ERROR(file.append(line += '\n'));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    line = "f";
    for (const std::uint32_t corner : soup.face(i)) append_number(line += ' ', corner + 1);
    RETURN_IF_ERROR(file.append(line += '\n'));
  }
  return {};
}

Status write_obj(const std::filesystem::path& path, const PolygonSoup& soup, std::string_view name) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  RETURN_IF_ERROR(append_obj(*file, soup, one_line(name)));
  return file->commit();
}

}  // namespace

Status write_obj_file(const std::filesystem::path& path, const PolygonSoup& soup, std::string_view name) {
  RETURN_IF_ERROR(check_soup(path, soup, CoordinateRange::doubles));
  return write_obj(path, soup, name);
}

}  // namespace stl
