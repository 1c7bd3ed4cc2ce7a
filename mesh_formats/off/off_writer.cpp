#include "mesh_formats/off/off_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "mesh_formats/detail/soup_check.h"

namespace mesh_formats {

using algebra3d::append_number;
using algebra3d::ByteSink;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::OutputPath;
using algebra3d::PolygonSoup;
using algebra3d::SoupAttributes;
using algebra3d::Status;
using algebra3d::Vec3;

namespace {

// Signed, since readers hold the counts so.
constexpr std::size_t kMostInBinaryOff = std::numeric_limits<std::int32_t>::max();

/// The attributes of a soup that the format has.
class WrittenAttributes {
 public:
  explicit WrittenAttributes(const SoupAttributes* attributes) : attributes_(attributes) {}

  std::string keyword() const {
    const auto letter = [&](const auto SoupAttributes::*list, const char* name) { return has(list) ? name : ""; };
    return std::string(letter(&SoupAttributes::point_textures, "ST")) + letter(&SoupAttributes::point_colours, "C") +
           letter(&SoupAttributes::point_normals, "N") + "OFF";
  }
  /// The numbers of a point in the order of the format. Where there is none, those of a normal are 0, and so are those
  /// of a colour; it is opaque unless it says something else.
  std::vector<double> of_point(std::size_t i) const {
    std::vector<double> numbers;
    if (has(&SoupAttributes::point_normals)) {
      const Vec3& normal = attributes_->point_normals[i];
      for (const double number : {normal.x, normal.y, normal.z}) add(numbers, number);
    }
    if (has(&SoupAttributes::point_colours)) add(numbers, attributes_->point_colours[i]);
    if (has(&SoupAttributes::point_textures))
      for (const double number : attributes_->point_textures[i]) add(numbers, number);
    return numbers;
  }
  /// The numbers of the colour of a face, three without an opacity; empty if it has none.
  std::vector<double> of_face(std::size_t i) const {
    std::vector<double> numbers;
    if (has(&SoupAttributes::face_colours) && std::isfinite(attributes_->face_colours[i].rgb.x))
      add(numbers, attributes_->face_colours[i]);
    if (!numbers.empty() && !std::isfinite(attributes_->face_colours[i].opacity)) numbers.pop_back();
    return numbers;
  }

 private:
  template <typename List>
  bool has(List SoupAttributes::*list) const {
    return attributes_ != nullptr && !(attributes_->*list).empty();
  }
  static void add(std::vector<double>& numbers, double number) {
    numbers.push_back(std::isfinite(number) ? number : 0);
  }
  static void add(std::vector<double>& numbers, const SoupAttributes::Colour& colour) {
    for (const double number : {colour.rgb.x, colour.rgb.y, colour.rgb.z}) add(numbers, number);
    const bool is_opaque = std::isfinite(colour.rgb.x) && !std::isfinite(colour.opacity);
    add(numbers, is_opaque ? 1 : colour.opacity);
  }

  const SoupAttributes* attributes_;
};

/// With a point, so that programs which tell parts of 1 from parts of 255 by it take it for the former.
void append_real(std::string& line, double number) {
  const std::size_t begin = line.size();
  append_number(line, number);
  if (line.find_first_of(".e", begin) == std::string::npos) line += ".0";
}

Status append_ascii_off(ByteSink& sink, const PolygonSoup& soup) {
  const WrittenAttributes attributes(soup.attributes.get());
  std::string line = fmt::format("{}\n{} {} 0\n", attributes.keyword(), soup.points.size(), soup.face_count());
  A3D_TRY(sink.append(line));
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    line.clear();
    for (std::size_t axis = 0; axis < 3; ++axis) append_number(axis == 0 ? line : line += ' ', soup.points[i][axis]);
    for (const double number : attributes.of_point(i)) append_real(line += ' ', number);
    A3D_TRY(sink.append(line += '\n'));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    line.clear();
    append_number(line, static_cast<std::uint32_t>(soup.face(i).size()));
    for (const std::uint32_t corner : soup.face(i)) append_number(line += ' ', corner);
    for (const double number : attributes.of_face(i)) append_real(line += ' ', number);
    A3D_TRY(sink.append(line += '\n'));
  }
  return {};
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((word >> shift) & 0xffU);
}
void append_float(std::string& bytes, double number) {
  append_word(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
}

Status append_binary_off(ByteSink& sink, const PolygonSoup& soup) {
  const WrittenAttributes attributes(soup.attributes.get());
  std::string bytes = attributes.keyword() + " BINARY\n";
  append_word(bytes, static_cast<std::uint32_t>(soup.points.size()));
  append_word(bytes, static_cast<std::uint32_t>(soup.face_count()));
  append_word(bytes, 0);
  A3D_TRY(sink.append(bytes));
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    bytes.clear();
    for (std::size_t axis = 0; axis < 3; ++axis) append_float(bytes, soup.points[i][axis]);
    for (const double number : attributes.of_point(i)) append_float(bytes, number);
    A3D_TRY(sink.append(bytes));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    bytes.clear();
    append_word(bytes, static_cast<std::uint32_t>(soup.face(i).size()));
    for (const std::uint32_t corner : soup.face(i)) append_word(bytes, corner);
    const std::vector<double> colour = attributes.of_face(i);
    append_word(bytes, static_cast<std::uint32_t>(colour.size()));
    for (const double number : colour) append_float(bytes, number);
    A3D_TRY(sink.append(bytes));
  }
  return {};
}

}  // namespace

Status write_off(ByteSink& sink, const PolygonSoup& soup, Encoding format) {
  const bool is_binary = format == Encoding::binary;
  if (is_binary && std::max(soup.points.size(), soup.face_count()) > kMostInBinaryOff)
    return Error{ErrorCode::limit_exceeded,
                 "{} points and {} faces, but a binary file holds at most 2147483647; ASCII holds more",
                 soup.points.size(), soup.face_count()};
  A3D_TRY(check_soup(soup, is_binary ? CoordinateRange::floats : CoordinateRange::doubles));
  return is_binary ? append_binary_off(sink, soup) : append_ascii_off(sink, soup);
}

Status write_off_file(const OutputPath& path, const PolygonSoup& soup, Encoding format) {
  return algebra3d::write_file(path, [&](ByteSink& sink) { return write_off(sink, soup, format); });
}

}  // namespace mesh_formats
