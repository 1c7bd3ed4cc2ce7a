#include "mesh_formats/off/off_writer.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>

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
using algebra3d::Status;
using algebra3d::Vec3;

namespace {

// Signed, since readers hold the counts so.
constexpr std::size_t kMostInBinaryOff = std::numeric_limits<std::int32_t>::max();

Status append_ascii_off(ByteSink& sink, const PolygonSoup& soup) {
  std::string line = fmt::format("OFF\n{} {} 0\n", soup.points.size(), soup.face_count());
  A3D_TRY(sink.append(line));
  for (const Vec3& point : soup.points) {
    line.clear();
    for (std::size_t axis = 0; axis < 3; ++axis) append_number(axis == 0 ? line : line += ' ', point[axis]);
    A3D_TRY(sink.append(line += '\n'));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    line.clear();
    append_number(line, static_cast<std::uint32_t>(soup.face(i).size()));
    for (const std::uint32_t corner : soup.face(i)) append_number(line += ' ', corner);
    A3D_TRY(sink.append(line += '\n'));
  }
  return {};
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((word >> shift) & 0xffU);
}

Status append_binary_off(ByteSink& sink, const PolygonSoup& soup) {
  std::string bytes = "OFF BINARY\n";
  append_word(bytes, static_cast<std::uint32_t>(soup.points.size()));
  append_word(bytes, static_cast<std::uint32_t>(soup.face_count()));
  append_word(bytes, 0);
  A3D_TRY(sink.append(bytes));
  for (const Vec3& point : soup.points) {
    bytes.clear();
    for (std::size_t axis = 0; axis < 3; ++axis)
      append_word(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(point[axis])));
    A3D_TRY(sink.append(bytes));
  }
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    bytes.clear();
    append_word(bytes, static_cast<std::uint32_t>(soup.face(i).size()));
    for (const std::uint32_t corner : soup.face(i)) append_word(bytes, corner);
    append_word(bytes, 0);
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
