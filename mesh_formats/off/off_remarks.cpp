#include "mesh_formats/off/off_remarks.h"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"

namespace mesh_formats {

using algebra3d::counted;

void add_remarks(const IgnoredInOff& ignored, ReadMesh& read) {
  std::vector<std::string>& remarks = read.remarks;
  const auto add = [&](std::size_t count, std::string_view noun, std::string_view which) {
    if (count > 0) remarks.push_back(fmt::format("{}{} ignored", counted(count, noun), which));
  };
  add(ignored.normals, "normal", "");
  add(ignored.vertex_colours, "vertex colour", "");
  add(ignored.texture_coordinates, "texture coordinate", "");
  if (ignored.surplus_vertices > 0)
    remarks.push_back(
        fmt::format("surplus numbers after {} ignored",
                    ignored.surplus_vertices == 1 ? "1 vertex" : fmt::format("{} vertices", ignored.surplus_vertices)));
  add(ignored.face_colours, "face colour", "");
  add(ignored.short_faces, "face", " with fewer than 3 corners");
  if (ignored.short_faces > 0) read.unread.push_back(remarks.back());
}

std::string off_index_message(std::uint64_t face, std::uint64_t face_count, std::uint64_t corner, std::uint64_t index,
                              std::uint64_t vertex_count) {
  const std::string expected =
      vertex_count == 0 ? "no face, since there is no vertex" : fmt::format("0 to {}", vertex_count - 1);
  return fmt::format("face {} of {}, corner {}: the index is {}; expected {}", face, face_count, corner, index,
                     expected);
}

}  // namespace mesh_formats
