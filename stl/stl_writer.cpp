#include "stl/stl_writer.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "base/atomic_file.h"
#include "base/float_range.h"
#include "base/propagate.h"
#include "base/text.h"
#include "stl/stl_binary_reader.h"

namespace mesh_formats {

using algebra3d::ByteSink;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::one_line;
using algebra3d::OutputPath;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;

static_assert(std::endian::native == std::endian::little, "floats are copied as the file has them");

namespace {

using Float3 = std::array<float, 3>;

/// A triangle as it is written.
struct Facet {
  Float3 normal;
  std::array<Float3, 3> corners;
};

// a d - b c with an error of at most 1.5 units in the last place, and 0 only if it is 0: Kahan's algorithm.
double determinant(double a, double b, double c, double d) {
  const double product = b * c;
  const double product_error = std::fma(-b, c, product);
  return std::fma(a, d, -product) + product_error;
}

Vec3 as_doubles(const Float3& v) {
  return {v[0], v[1], v[2]};
}

Float3 unit_normal(const std::array<Float3, 3>& corners) {
  const Vec3 u = as_doubles(corners[1]) - as_doubles(corners[0]);
  const Vec3 v = as_doubles(corners[2]) - as_doubles(corners[0]);
  const Vec3 n{determinant(u.y, u.z, v.y, v.z), determinant(u.z, u.x, v.z, v.x), determinant(u.x, u.y, v.x, v.y)};
  const double length = std::sqrt(dot(n, n));  // floats keep the squares within 2^-600 and 2^520
  if (length == 0) return {};
  return {static_cast<float>(n.x / length), static_cast<float>(n.y / length), static_cast<float>(n.z / length)};
}

Result<Facet> make_facet(const TriangleSoup& soup, std::size_t index) {
  Facet facet{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = soup.triangles[index][corner][axis];
      if (!(std::abs(value) < kBeyondFloat))
        return Error{ErrorCode::invalid_value,
                     "triangle {}, corner {}: {} is {}; expected a finite number within the range of float",
                     index + 1,
                     corner + 1,
                     "xyz"[axis],
                     value};
      facet.corners[corner][axis] = static_cast<float>(value);
    }
  }
  facet.normal = unit_normal(facet.corners);
  return facet;
}

// At most `limit` bytes, never the first half of a UTF-8 character.
std::string_view cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xc0U) == 0x80U) --limit;
  return text.substr(0, limit);
}

bool begins_with_solid(std::string_view text) {
  const std::string_view solid = "solid";
  if (text.size() < solid.size()) return false;
  for (std::size_t i = 0; i < solid.size(); ++i)
    if ((text[i] | 0x20) != solid[i]) return false;
  return true;
}

Status append_binary(ByteSink& sink, const TriangleSoup& soup, std::string_view name) {
  std::array<char, kBinaryPrefixBytes> prefix{};
  const std::string header = (begins_with_solid(name) ? "STL " : "") + std::string(name);
  const std::string_view kept = cut(header, kBinaryHeaderBytes);
  std::memcpy(prefix.data(), kept.data(), kept.size());
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  std::memcpy(prefix.data() + kBinaryHeaderBytes, &count, sizeof count);
  A3D_TRY(sink.append({prefix.data(), prefix.size()}));
  std::array<char, kBinaryFacetBytes> bytes{};  // the attribute stays 0
  static_assert(sizeof(Facet) == 48);
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    A3D_ASSIGN(const Facet facet, make_facet(soup, i));
    std::memcpy(bytes.data(), &facet, sizeof facet);
    A3D_TRY(sink.append({bytes.data(), bytes.size()}));
  }
  return {};
}

/// The text of one facet; allocates nothing.
class FacetText {
 public:
  explicit FacetText(const Facet& facet) {
    add("  facet normal", facet.normal);
    add("    outer loop\n");
    for (const Float3& corner : facet.corners) add("      vertex", corner);
    add("    endloop\n  endfacet\n");
  }
  [[nodiscard]] std::string_view text() const { return {text_.data(), size_}; }

 private:
  void add(std::string_view text) {
    std::memcpy(text_.data() + size_, text.data(), text.size());
    size_ += text.size();
  }
  void add(std::string_view keyword, const Float3& vector) {
    add(keyword);
    for (const float value : vector) {
      add(" ");
      char* const end = text_.data() + text_.size();
      // As a double: the shortest digits of the float itself would read back to another double.
      size_ = static_cast<std::size_t>(std::to_chars(text_.data() + size_, end, static_cast<double>(value)).ptr -
                                       text_.data());
    }
    add("\n");
  }

  std::array<char, 512> text_;  // 12 numbers of at most 24 characters, 110 for the rest
  std::size_t size_ = 0;
};

Status append_ascii(ByteSink& sink, const TriangleSoup& soup, std::string_view name) {
  const std::string named = name.empty() ? "solid\n" : fmt::format("solid {}\n", name);
  A3D_TRY(sink.append(named));
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    A3D_ASSIGN(const Facet facet, make_facet(soup, i));
    A3D_TRY(sink.append(FacetText(facet).text()));
  }
  return sink.append("end" + named);
}

}  // namespace

Status write_stl(ByteSink& sink, const TriangleSoup& soup, std::string_view name, Encoding format) {
  const std::string line = one_line(name);
  if (format == Encoding::ascii) return append_ascii(sink, soup, line);
  if (soup.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::limit_exceeded,
                 "{} triangles, but a binary file holds at most 4294967295; ASCII holds more", soup.triangles.size()};
  return append_binary(sink, soup, line);
}

Status write_stl_file(const OutputPath& path, const TriangleSoup& soup, std::string_view name, Encoding format) {
  return algebra3d::write_file(path, [&](ByteSink& sink) { return write_stl(sink, soup, name, format); });
}

}  // namespace mesh_formats
