#include "mesh_formats/obj/obj_writer.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/indices.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "base/text.h"
#include "mesh_formats/detail/soup_check.h"

namespace mesh_formats {

using algebra3d::append_number;
using algebra3d::ByteSink;
using algebra3d::kNone;
using algebra3d::one_line;
using algebra3d::OutputPath;
using algebra3d::PolygonSoup;
using algebra3d::SoupAttributes;
using algebra3d::Status;
using algebra3d::Vec3;

namespace {

// A backslash at the end of the line would join the next one to it.
std::string object_line(std::string_view name) {
  return "o " + std::string(name) + (name.ends_with('\\') ? " \n" : "\n");
}

Status append_faces(ByteSink& sink, const PolygonSoup& soup) {
  std::string line;
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    line = "f";
    for (const std::uint32_t corner : soup.face(i)) append_number(line += ' ', corner + 1);
    A3D_TRY(sink.append(line += '\n'));
  }
  return {};
}

Status append_elements(ByteSink& sink, std::string_view keyword, std::span<const double> numbers) {
  std::string line(keyword);
  for (const double number : numbers) append_number(line += ' ', std::isfinite(number) ? number : 0);
  return sink.append(line += '\n');
}

/// The number of an entry that a list may have; kNone if it has none.
std::uint32_t number_in(const std::vector<std::uint32_t>& numbers, std::size_t i) {
  return numbers.empty() ? kNone : numbers[i];
}

void append_corner(std::string& line, std::uint32_t point, std::uint32_t texture, std::uint32_t normal) {
  append_number(line += ' ', point + 1);
  if (texture == kNone && normal == kNone) return;
  line += '/';
  if (texture != kNone) append_number(line, texture + 1);
  if (normal != kNone) append_number(line += '/', normal + 1);
}

/// Statements that give the name of a kind where it changes, and an empty one where it ends, if that ends it.
class NameStatements {
 public:
  enum class Empty : bool { ends_name, means_nothing };

  NameStatements(std::string_view keyword, const SoupAttributes::FaceNames& names, Empty empty = Empty::ends_name)
      : keyword_(keyword), names_(&names), empty_(empty) {}

  void append_if_new(std::string& lines, std::size_t face) {
    const std::uint32_t number = number_in(names_->of_face, face);
    if (number == current_ || (number == kNone && empty_ == Empty::means_nothing)) return;
    current_ = number;
    lines += keyword_;
    if (number != kNone) lines += ' ' + one_line(names_->names[number]);
    // A backslash at the end of the line would join the next one to it.
    lines += lines.ends_with('\\') ? " \n" : "\n";
  }

 private:
  std::string_view keyword_;
  const SoupAttributes::FaceNames* names_;
  Empty empty_;
  std::uint32_t current_ = kNone;
};

Status append_with_attributes(ByteSink& sink, const PolygonSoup& soup) {
  const SoupAttributes& attributes = *soup.attributes;
  for (const auto& texture : attributes.textures) A3D_TRY(append_elements(sink, "vt", texture));
  for (const Vec3& normal : attributes.normals)
    A3D_TRY(append_elements(sink, "vn", std::array{normal.x, normal.y, normal.z}));
  std::array names{NameStatements("o", attributes.objects), NameStatements("g", attributes.groups),
                   NameStatements("mtllib", attributes.libraries, NameStatements::Empty::means_nothing),
                   NameStatements("usemtl", attributes.materials)};
  std::string lines;
  for (std::size_t face = 0; face < soup.face_count(); ++face) {
    lines.clear();
    for (NameStatements& statements : names) statements.append_if_new(lines, face);
    lines += 'f';
    for (std::uint32_t i = soup.face_starts[face]; i < soup.face_starts[face + 1]; ++i)
      append_corner(lines, soup.corners[i], number_in(attributes.corner_textures, i),
                    number_in(attributes.corner_normals, i));
    A3D_TRY(sink.append(lines += '\n'));
  }
  return {};
}

Status append_obj(ByteSink& sink, const PolygonSoup& soup, std::string_view name) {
  if (!name.empty()) A3D_TRY(sink.append(object_line(name)));
  // Readers refuse a file without bytes.
  if (name.empty() && soup.points.empty()) A3D_TRY(sink.append("# no vertices\n"));
  std::string line;
  for (const Vec3& point : soup.points) {
    line = "v";
    for (std::size_t axis = 0; axis < 3; ++axis) append_number(line += ' ', point[axis]);
    A3D_TRY(sink.append(line += '\n'));
  }
  return soup.attributes == nullptr ? append_faces(sink, soup) : append_with_attributes(sink, soup);
}

}  // namespace

Status write_obj(ByteSink& sink, const PolygonSoup& soup, std::string_view name) {
  A3D_TRY(check_soup(soup, CoordinateRange::doubles));
  return append_obj(sink, soup, one_line(name));
}

Status write_obj_file(const OutputPath& path, const PolygonSoup& soup, std::string_view name) {
  return algebra3d::write_file(path, [&](ByteSink& sink) { return write_obj(sink, soup, name); });
}

}  // namespace mesh_formats
