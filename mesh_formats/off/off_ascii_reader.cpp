#include "mesh_formats/off/off_ascii_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/ascii_cursor.h"
#include "base/padding.h"
#include "base/reading.h"
#include "base/soup_capacity.h"
#include "base/text.h"
#include "mesh_formats/off/off_attributes.h"
#include "mesh_formats/off/off_remarks.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::counted;
using algebra3d::ErrorCode;
using algebra3d::found_text;
using algebra3d::is_blank;
using algebra3d::line_number;
using algebra3d::NumberKind;
using algebra3d::Result;
using algebra3d::Vec3;

namespace {

constexpr std::size_t kOffElementsPerPoll = 65536;
constexpr std::size_t kMostSurplusOfVertex = 6;  // a colour of four, texture coordinates
constexpr std::size_t kMostSurplusOfFace = 4;
constexpr std::size_t kColourNumbers = 4;

// The shortest lines: `0 0 0` and `3 0 0 0`, the last without an end. Shorter lines are dropped or an error.
constexpr std::size_t kLeastVertexBytes = 6;
constexpr std::size_t kLeastFaceBytes = 8;
constexpr std::size_t kLeastCornerBytes = 2;

constexpr std::size_t kMostCornersBeforePlainFace = std::numeric_limits<std::uint32_t>::max() - 4;

class OffAsciiReader : Reading {
 public:
  OffAsciiReader(std::string_view bytes, const OffHeader& header, std::string_view file_name, Wanted wanted,
                 const std::atomic<bool>* cancel)
      : Reading(bytes, file_name, cancel),
        header_(header),
        cursor_(bytes.data() + header.bytes, bytes.data() + bytes.size()) {
    if (wanted == Wanted::attributes) attributes_.emplace(header);
    if (header.bytes == 0 && bytes.starts_with("\xef\xbb\xbf")) cursor_.move_to(bytes.data() + 3);
  }

  Result<ReadMesh> read() {
    if (!(read_dimension() && read_counts() && read_vertices() && read_faces())) return take_error();
    (header_.has_colours ? ignored_.vertex_colours : ignored_.surplus_vertices) = surplus_vertex_count_;
    if (attributes_) {
      ignored_.vertex_colours = 0;
      read_.soup.attributes = std::move(*attributes_).finish(read_.soup.face_count());
    } else {
      ignored_.texture_coordinates = header_.has_texture_coordinates ? vertex_count_ : 0;
      ignored_.normals = header_.has_normals ? vertex_count_ : 0;
    }
    add_remarks(ignored_, read_);
    note_rest();
    return std::move(read_);
  }

 private:
  bool read_dimension() {
    if (!header_.has_dimension) return true;
    std::uint64_t dimension = 0;
    if (!take_integer(dimension)) return fail_expected("the dimension of the space");
    if (dimension == 3) return true;
    return fail_here(ErrorCode::file_format, fmt::format("the dimension of the space is {}; expected 3", dimension));
  }

  bool read_counts() {
    // Without a keyword, whatever file this is, the message should show its first word.
    const bool has_keyword = header_.bytes > 0;
    if (!take_integer(vertex_count_))
      return fail_expected(has_keyword ? "the number of vertices" : "'OFF' or the number of vertices");
    if (!take_integer(face_count_)) return fail_expected("the number of faces");
    if (vertex_count_ > std::numeric_limits<std::uint32_t>::max())
      return fail_here(ErrorCode::limit_exceeded,
                       fmt::format("{} vertices announced; expected at most 4294967295", vertex_count_));
    return skip_edge_count();
  }

  bool skip_edge_count() {
    double ignored = 0;
    std::uint64_t ignored_count = 0;
    cursor_.skip_blanks_in_line();
    if (!cursor_.is_at_line_end()) {
      if (!take_integer(ignored_count) && cursor_.take_number(ignored) == NumberKind::none)
        return fail_expected("the number of edges");
      vertices_go_on_ = vertex_count_ > 0 && line_has(3 * vertex_count_);
      return true;
    }
    AsciiCursor next_line = cursor_;
    next_line.skip_space();
    const bool has_number = next_line.take_number(ignored) != NumberKind::none;
    next_line.skip_blanks_in_line();
    if (has_number && next_line.is_at_line_end()) cursor_ = next_line;
    return true;
  }

  bool read_vertices() {
    auto& points = read_.soup.points;
    reserve_points(read_.soup, std::min<std::size_t>(vertex_count_, cursor_.rest().size() / kLeastVertexBytes + 1));
    while (points.size() < vertex_count_) {
      take_plain_vertices();
      if (is_cancelled()) return false;
      if (points.size() < vertex_count_ && !read_vertex()) return false;
    }
    return true;
  }

  // Takes vertices of three plain numbers that fill their line, as most are, up to the first other one, and at most
  // kOffElementsPerPoll. The cursor is not a member, so that the place stays in a register.
  void take_plain_vertices() {
    if (header_.has_weights || header_.has_normals || header_.has_texture_coordinates) return;
    if (attributes_ && header_.has_colours) return;
    auto& points = read_.soup.points;
    const std::size_t most = std::min<std::size_t>(vertex_count_, points.size() + kOffElementsPerPoll);
    AsciiCursor cursor = cursor_;
    while (points.size() < most) {
      Vec3 point;
      cursor.skip_blanks();
      if (!cursor.take_plain_numbers(point)) return;
      cursor.skip_blanks_in_line();
      if (!cursor.is_at_line_break()) return;
      points.push_back(point);
      cursor_ = cursor;
    }
  }

  bool read_vertex() {
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cursor_.skip_space();
      const char* const number = cursor_.position();
      const NumberKind kind = cursor_.take_number(point[axis]);
      if (kind != NumberKind::finite) [[unlikely]]
        return fail_coordinate(number, kind, axis);
    }
    if (header_.has_weights && !read_weight()) return false;
    number_count_ = 0;
    if (header_.has_normals && !take_numbers(3)) return false;
    if (read_.soup.points.empty() && !vertices_go_on_)
      vertices_go_on_ = line_has(std::max<std::uint64_t>(kMostSurplusOfVertex + 1, 3 * (vertex_count_ - 1)));
    if (vertices_go_on_ && header_.has_colours && !take_numbers(kColourNumbers)) return false;
    const bool has_textures_alone = header_.has_texture_coordinates && (vertices_go_on_ || !header_.has_colours);
    if (has_textures_alone && !take_numbers(2)) return false;
    read_.soup.points.push_back(point);
    cursor_.skip_blanks_in_line();
    if (!cursor_.is_at_line_end() && !vertices_go_on_) [[unlikely]] {
      ++surplus_vertex_count_;
      if (!take_surplus(kMostSurplusOfVertex)) return false;
    }
    if (attributes_) attributes_->add_vertex(taken_numbers());
    return true;
  }

  bool read_weight() {
    double weight = 0;
    cursor_.skip_space();
    const char* const number = cursor_.position();
    if (cursor_.take_number(weight) == NumberKind::none) return fail_in_vertex("expected a number");
    if (weight == 1) return true;
    cursor_.move_to(number);
    return fail_here(ErrorCode::file_format, fmt::format("vertex {} of {}: the weight is {}; expected 1",
                                                         vertex_number(), vertex_count_, found_text(cursor_.rest())));
  }

  // Attributes of a vertex or face, behind those that were taken before.
  bool take_numbers(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      cursor_.skip_space();
      if (!take_attribute_number()) return fail_in_vertex("expected a number");
    }
    return true;
  }

  // Likewise, to the end of the line.
  bool take_surplus(std::size_t most) {
    for (std::size_t i = 0; !cursor_.is_at_line_end(); ++i, cursor_.skip_blanks_in_line()) {
      if (i == most || !take_attribute_number())
        return fail_expected(i == most ? "the end of the line" : "a number or the end of the line");
    }
    return true;
  }

  // One that is not finite counts as none.
  bool take_attribute_number() {
    double number = 0;
    const NumberKind kind = cursor_.take_number(number);
    numbers_[number_count_++] = kind == NumberKind::finite ? number : std::numeric_limits<double>::quiet_NaN();
    return kind != NumberKind::none;
  }
  [[nodiscard]] std::span<const double> taken_numbers() const { return std::span(numbers_).first(number_count_); }

  // Whether the rest of the line has at least `count` numbers: so all vertices, or all faces, may stand in one line, as
  // geomview reads them.
  [[nodiscard]] bool line_has(std::uint64_t count) const {
    AsciiCursor cursor = cursor_;
    double ignored = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      cursor.skip_blanks_in_line();
      if (cursor.is_at_line_end() || cursor.take_number(ignored) == NumberKind::none) return false;
    }
    return true;
  }

  bool read_faces() {
    faces_go_on_ = vertices_go_on_ && face_count_ > 0 && line_has(4 * face_count_);
    const std::size_t bytes = cursor_.rest().size();
    const auto faces = std::min<std::size_t>(face_count_, bytes / kLeastFaceBytes + 1);
    // Room for quadrilaterals, unless the text is too short for them. It is not touched before it is used.
    reserve_faces(read_.soup, faces, std::min(4 * faces, bytes / kLeastCornerBytes + 1));
    while (face_index_ < face_count_) {
      take_plain_faces();
      if (is_cancelled()) return false;
      if (face_index_ == face_count_) break;
      if (!read_face()) return false;
      ++face_index_;
    }
    return true;
  }

  // Takes triangles and quadrilaterals that fill their line, with indices below 10000000.
  void take_plain_faces() {
    const std::uint64_t most = std::min(face_count_, face_index_ + kOffElementsPerPoll);
    AsciiCursor cursor = cursor_;
    while (face_index_ < most && take_plain_face(cursor)) {
      ++face_index_;
      cursor_ = cursor;
    }
  }

  [[gnu::always_inline]] bool take_plain_face(AsciiCursor& cursor) {
    std::uint32_t degree = 0;
    std::array<std::uint32_t, 4> indices{};
    cursor.skip_blanks();
    if (!cursor.take_few_digits(degree) || degree < 3 || degree > indices.size()) return false;
    for (std::uint32_t i = 0; i < degree; ++i) {
      cursor.skip_blanks_in_line();
      if (!cursor.take_few_digits(indices[i]) || indices[i] >= vertex_count_) return false;
    }
    cursor.skip_blanks_in_line();
    auto& corners = read_.soup.corners;
    if (!cursor.is_at_line_break() || corners.size() > kMostCornersBeforePlainFace) return false;
    for (std::uint32_t i = 0; i < degree; ++i) corners.push_back(indices[i]);
    read_.soup.face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    return true;
  }

  bool read_face() {
    std::uint64_t degree = 0;
    if (!take_integer(degree)) [[unlikely]]
      return fail_in_face("expected the number of its corners");
    auto& corners = read_.soup.corners;
    const std::size_t first_corner = corners.size();
    for (std::uint64_t corner = 0; corner < degree; ++corner) {
      std::uint64_t index = 0;
      if (!take_integer(index)) [[unlikely]]
        return fail_in_face(fmt::format("expected the index of corner {} of {}", corner + 1, degree));
      if (index >= vertex_count_) [[unlikely]]
        return fail_index(corner, index);
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (corners.size() > std::numeric_limits<std::uint32_t>::max()) [[unlikely]]
      return fail_here(ErrorCode::limit_exceeded, "more than 4294967295 corners of faces");
    if (degree < 3) [[unlikely]] {
      corners.resize(first_corner);
      ++ignored_.short_faces;
    } else {
      read_.soup.face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    cursor_.skip_blanks_in_line();
    if (face_index_ == 0 && !faces_go_on_)
      faces_go_on_ = line_has(std::max<std::uint64_t>(kMostSurplusOfFace + 1, 4 * (face_count_ - 1)));
    if (cursor_.is_at_line_end() || faces_go_on_) [[likely]]
      return true;
    number_count_ = 0;
    if (!take_surplus(kMostSurplusOfFace)) return false;
    const bool is_colour = attributes_ && number_count_ >= 3;
    if (!is_colour) ++ignored_.face_colours;
    if (is_colour && degree >= 3) attributes_->set_face_colour(read_.soup.face_count() - 1, taken_numbers());
    return true;
  }

  // Takes the integer that is the next word, wherever it stands; else stays before that word.
  bool take_integer(std::uint64_t& value) {
    cursor_.skip_space();
    const char* const word = cursor_.position();
    if (cursor_.take_digits(value) &&
        (cursor_.is_at_end() || is_blank(*cursor_.position()) || *cursor_.position() == '#')) [[likely]]
      return true;
    cursor_.move_to(word);
    return false;
  }

  void note_rest() {
    cursor_.skip_space();
    const std::string_view rest = cursor_.rest();
    if (rest.empty()) return;
    const bool has_text = !is_padding(rest);
    const std::string what = has_text ? fmt::format("text from line {}", line_number(bytes_, offset()))
                                      : counted(rest.size(), "trailing byte");
    read_.remarks.push_back(fmt::format("{} after the last face ignored", what));
    if (has_text) read_.unread.push_back(read_.remarks.back());
  }

  [[nodiscard]] std::size_t vertex_number() const { return read_.soup.points.size() + 1; }
  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(cursor_.position() - bytes_.data()); }

  bool fail_coordinate(const char* number, NumberKind kind, std::size_t axis) {
    if (kind == NumberKind::none) return fail_in_vertex("expected a number");
    cursor_.move_to(number);
    const std::string_view expected =
        kind == NumberKind::too_large ? "a number within the range of double" : "a finite number";
    return fail_here(ErrorCode::file_format,
                     fmt::format("vertex {} of {}: {} is {}; expected {}", vertex_number(), vertex_count_, "xyz"[axis],
                                 found_text(cursor_.rest()), expected));
  }
  bool fail_in_vertex(std::string_view expected) {
    return fail_here(ErrorCode::file_format, fmt::format("vertex {} of {}: {}, found {}", vertex_number(),
                                                         vertex_count_, expected, found_text(cursor_.rest())));
  }
  bool fail_in_face(std::string_view expected) {
    return fail_here(ErrorCode::file_format, fmt::format("face {} of {}: {}, found {}", face_index_ + 1, face_count_,
                                                         expected, found_text(cursor_.rest())));
  }
  // Behind the index.
  bool fail_index(std::uint64_t corner, std::uint64_t index) {
    const char* word = cursor_.position();
    while (word[-1] >= '0' && word[-1] <= '9') --word;  // a blank stands before it
    cursor_.move_to(word);
    return fail_here(ErrorCode::file_format,
                     off_index_message(face_index_ + 1, face_count_, corner + 1, index, vertex_count_));
  }
  bool fail_expected(std::string_view expected) {
    return fail_here(ErrorCode::file_format,
                     fmt::format("expected {}, found {}", expected, found_text(cursor_.rest())));
  }
  bool fail_here(ErrorCode code, std::string_view what) {
    return fail(algebra3d::Error{code, "byte {}, line {}: {}", offset(), line_number(bytes_, offset()), what}.about(
        file_name_));
  }

  OffHeader header_;
  AsciiCursor cursor_;
  ReadMesh read_;
  IgnoredInOff ignored_;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::uint64_t face_index_ = 0;
  std::size_t surplus_vertex_count_ = 0;
  bool vertices_go_on_ = false, faces_go_on_ = false;           // several stand in one line
  std::optional<OffAttributes> attributes_;                     // nothing if they are not wanted
  std::array<double, 3 + kMostSurplusOfVertex + 1> numbers_{};  // attributes of the vertex or face that is being read
  std::size_t number_count_ = 0;
};

}  // namespace

Result<ReadMesh> read_ascii_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                Wanted wanted, const std::atomic<bool>* cancel) {
  return OffAsciiReader(bytes, header, file_name, wanted, cancel).read();
}

}  // namespace mesh_formats
