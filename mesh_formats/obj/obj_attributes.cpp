#include "mesh_formats/obj/obj_attributes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "base/ascii_cursor.h"
#include "base/indices.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::kNone;
using algebra3d::NumberKind;
using algebra3d::SoupAttributes;

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// The numbers in the rest of a statement, which may be continued and may end in a comment; NaN for each that is not a
/// number. Returns how many words there are, at most `numbers.size()`.
std::size_t read_numbers(std::string_view rest, std::span<double> numbers) {
  std::string line;
  if (rest.find_first_of("\\#") != std::string_view::npos) {
    line = rest.substr(0, rest.find('#'));
    std::ranges::replace_if(
        line, [](char c) { return c == '\\' || c == '\r' || c == '\n'; }, ' ');
    rest = line;
  }
  AsciiCursor cursor(rest.data(), rest.data() + rest.size());
  std::ranges::fill(numbers, kNoNumber);
  for (std::size_t count = 0; count < numbers.size(); ++count) {
    cursor.skip_space();
    if (cursor.is_at_end()) return count;
    double value = 0;
    if (cursor.take_number(value) != NumberKind::finite) return count + 1;
    numbers[count] = value;
  }
  return numbers.size();
}

/// The number of an element from 1; 0 for none. An index below 0 counts back from the last of `count`; beyond the first
/// there is no element, which a number that no file reaches stands for.
ObjAttributes::Index from_first(ObjAttributes::Index index, std::size_t count) {
  if (index >= 0) return index;
  const ObjAttributes::Index number = static_cast<ObjAttributes::Index>(count) + 1 + index;
  return number > 0 ? number : std::numeric_limits<ObjAttributes::Index>::max();
}

/// Indices from 0, or kNone; empty if all are kNone.
std::vector<std::uint32_t> resolved(const std::vector<ObjAttributes::Index>& indices, std::size_t count,
                                    std::size_t& unknown_count) {
  std::vector<std::uint32_t> result(indices.size(), kNone);
  bool is_used = false;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] == 0) continue;
    const bool is_known = static_cast<std::uint64_t>(indices[i]) <= count;
    if (is_known) result[i] = static_cast<std::uint32_t>(indices[i] - 1);
    unknown_count += is_known ? 0 : 1;
    is_used = is_used || is_known;
  }
  if (!is_used) result.clear();
  return result;
}

void drop_if_unused(SoupAttributes::FaceNames& names) {
  if (std::ranges::all_of(names.of_face, [](std::uint32_t number) { return number == kNone; })) names = {};
}

}  // namespace

void ObjAttributes::add_texture(std::string_view rest) {
  SoupAttributes::TextureCoordinate texture{};
  if (read_numbers(rest, texture) == 1) texture[1] = 0;
  attributes_.textures.push_back(texture);
}

void ObjAttributes::add_normal(std::string_view rest) {
  std::array<double, 3> normal{};
  read_numbers(rest, normal);
  attributes_.normals.push_back({normal[0], normal[1], normal[2]});
}

void ObjAttributes::begin_library(std::string_view names) {
  auto& [libraries, of_face] = attributes_.libraries;
  if (!libraries.empty() && libraries.back() == names) return;
  const bool is_named_by_faces = !libraries.empty() && !of_face.empty() && of_face.back() == libraries.size() - 1;
  if (libraries.empty() || is_named_by_faces)
    libraries.emplace_back(names);
  else if (!names.empty())
    libraries.back().append(libraries.back().empty() ? "" : " ").append(names);
}

void ObjAttributes::add_corner(Index texture, Index normal) {
  textures_.push_back(from_first(texture, attributes_.textures.size()));
  normals_.push_back(from_first(normal, attributes_.normals.size()));
}

void ObjAttributes::end_face(SoupAttributes::FaceNames& names) {
  const bool has_name = !names.names.empty() && !names.names.back().empty();
  names.of_face.push_back(has_name ? static_cast<std::uint32_t>(names.names.size() - 1) : kNone);
}

void ObjAttributes::end_face() {
  for (SoupAttributes::FaceNames* names : attributes_.face_names()) end_face(*names);
}

void ObjAttributes::drop_corners(std::size_t count) {
  textures_.resize(textures_.size() - count);
  normals_.resize(normals_.size() - count);
}

SoupAttributes ObjAttributes::finish(std::size_t& unknown_count) && {
  unknown_count = 0;
  attributes_.corner_textures = resolved(textures_, attributes_.textures.size(), unknown_count);
  attributes_.corner_normals = resolved(normals_, attributes_.normals.size(), unknown_count);
  for (SoupAttributes::FaceNames* names : attributes_.face_names()) drop_if_unused(*names);
  return std::move(attributes_);
}

}  // namespace mesh_formats
