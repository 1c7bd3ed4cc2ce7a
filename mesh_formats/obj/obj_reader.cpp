#include "mesh_formats/obj/obj_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "base/ascii_cursor.h"
#include "base/file_content.h"
#include "base/line_ends.h"
#include "base/padding.h"
#include "base/reading.h"
#include "base/soup_capacity.h"
#include "mesh_formats/obj/obj_attributes.h"
#include "mesh_formats/obj/obj_statement.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::counted;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FileContent;
using algebra3d::found_text;
using algebra3d::is_blank;
using algebra3d::is_line_break;
using algebra3d::kGreatestInteger;
using algebra3d::line_number;
using algebra3d::LineEnds;
using algebra3d::NumberKind;
using algebra3d::Result;
using algebra3d::trimmed;
using algebra3d::Vec3;

namespace {

constexpr std::size_t kStatementsPerPoll = 65536;
// After so many vertices or faces the length of one is known well enough to reserve room for the rest.
constexpr std::size_t kElementsForEstimate = 256;
constexpr std::size_t kMostInSoup = std::numeric_limits<std::uint32_t>::max();

class ObjReader : Reading {
 public:
  /// `point_limit` is the number of vertices, or kGreatestInteger while it is not known.
  ObjReader(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel, Wanted wanted,
            std::uint64_t point_limit)
      : Reading(bytes, file_name, cancel),
        wants_attributes_(wanted == Wanted::attributes),
        point_limit_(point_limit),
        cursor_(bytes.data(), bytes.data() + bytes.size()),
        end_(bytes.data() + bytes.size()),
        line_ends_(end_) {}

  Result<ReadMesh> read() {
    if (is_padding(bytes_)) return Error{ErrorCode::file_format, "empty file; expected an OBJ file"}.about(file_name_);
    if (bytes_.starts_with("\xef\xbb\xbf")) cursor_.move_to(bytes_.data() + 3);
    if (!read_statements()) return take_error();
    if (read_.soup.points.size() > kMostInSoup) return too_many("vertices");
    add_remarks();
    if (wants_attributes_) add_attributes();
    return std::move(read_);
  }

  /// The greatest index of a corner that counts from the first vertex, from 1; 0 if there is none.
  [[nodiscard]] std::uint64_t greatest_index() const { return greatest_index_; }

 private:
  bool read_statements() {
    for (std::size_t statement_count = 0;; ++statement_count) {
      statement_count += take_plain_lines();
      if (statement_count >= kStatementsPerPoll) {
        statement_count = 0;
        if (is_cancelled()) return false;
      }
      cursor_.skip_space();
      if (cursor_.is_at_end()) return knows_some_statement();
      if (!read_statement()) return false;
    }
  }

  // Goes over lines that are plain vertices and faces, as most are, up to the first other one; gives their number, at
  // most kStatementsPerPoll. The cursor is not a member, so that the place stays in a register.
  std::size_t take_plain_lines() {
    AsciiCursor cursor = cursor_;
    for (std::size_t count = 0; count < kStatementsPerPoll; ++count) {
      cursor.skip_blanks();
      const bool is_taken = cursor.take_text("v ")
                                ? take_plain_vertex(cursor)
                                : !wants_attributes_ && cursor.take_text("f ") && take_plain_face(cursor);
      if (!is_taken) return count;
      cursor_ = cursor;
    }
    return kStatementsPerPoll;
  }

  // Behind `v`: three plain numbers and nothing else in the line.
  [[gnu::always_inline]] bool take_plain_vertex(AsciiCursor& cursor) {
    Vec3 point;
    if (!cursor.take_plain_numbers(point)) return false;
    cursor.skip_blanks_in_line();
    if (!cursor.is_at_line_break()) return false;
    add_point(point, cursor);
    return true;
  }

  // Behind `f`: a triangle or quadrilateral of indices from 1 to 9999999, perhaps with attributes, and nothing else.
  [[gnu::always_inline]] bool take_plain_face(AsciiCursor& cursor) {
    std::array<std::uint32_t, 4> indices{};
    std::size_t count = 0;
    const char* const behind_keyword = cursor.position();
    for (cursor.skip_blanks_in_line(); !cursor.is_at_line_break(); cursor.skip_blanks_in_line()) {
      if (count == indices.size() || !cursor.take_few_digits(indices[count]) || !pass_plain_attributes(cursor))
        return false;
      if (indices[count] == 0 || indices[count] > point_limit_) return false;
      ++count;
    }
    auto& corners = read_.soup.corners;
    if (count < 3 || corners.size() > kMostInSoup - count) return false;
    if (face_count_++ == 0) first_face_ = behind_keyword;
    for (std::size_t i = 0; i < count; ++i) {
      greatest_index_ = std::max<std::uint64_t>(greatest_index_, indices[i]);
      corners.push_back(indices[i] - 1);
    }
    read_.soup.face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    if (face_count_ == kElementsForEstimate) reserve_remaining_faces(cursor);
    return true;
  }

  // False before anything but an index, `/`, white space or a line break; then the cursor is of no use.
  static bool pass_plain_attributes(AsciiCursor& cursor) {
    std::uint32_t ignored = 0;
    for (int slash = 0; slash < 2 && *cursor.position() == '/'; ++slash) {
      cursor.move_to(cursor.position() + 1);
      cursor.take_few_digits(ignored);
    }
    return is_blank(*cursor.position());
  }

  // The two statements that most of the file is made of are recognised by their first two bytes.
  bool read_statement() {
    const char* const first = cursor_.position();
    if (end_ - first > 1 && is_blank(first[1])) [[likely]] {
      cursor_.move_to(first + 1);
      if (*first == 'v') return read_vertex();
      if (*first == 'f') return read_face();
      cursor_.move_to(first);
    }
    return read_other_statement();
  }

  bool read_other_statement() {
    const char* const first = cursor_.position();
    if (is_at_continuation()) return skip_in_line(), true;
    while (!cursor_.is_at_end() && !is_blank(*cursor_.position()) && !is_at_continuation())
      cursor_.move_to(cursor_.position() + 1);
    const std::string_view keyword(first, static_cast<std::size_t>(cursor_.position() - first));
    const ObjStatement statement = obj_statement(keyword);
    if (statement == ObjStatement::vertex) return read_vertex();
    if (statement == ObjStatement::face) return read_face();
    if (statement == ObjStatement::unknown && !note_unknown(first, keyword)) return !has_failed();
    ++counts_[static_cast<std::size_t>(statement)];
    const char* const behind_keyword = cursor_.position();
    skip_statement();
    const std::string_view rest(behind_keyword, static_cast<std::size_t>(cursor_.position() - behind_keyword));
    if (statement == ObjStatement::object || statement == ObjStatement::group) note_name(statement, rest);
    if (wants_attributes_) note_attribute(statement, keyword, rest);
    return true;
  }

  void note_attribute(ObjStatement statement, std::string_view keyword, std::string_view rest) {
    if (statement == ObjStatement::texture_coordinates && keyword == "vt") attributes_.add_texture(rest);
    if (statement == ObjStatement::normal) attributes_.add_normal(rest);
    if (statement == ObjStatement::group) attributes_.begin_group(name_in(rest));
    if (statement == ObjStatement::object) attributes_.begin_object(name_in(rest));
    if (keyword == "usemtl") attributes_.begin_material(name_in(rest));
    if (keyword == "mtllib") attributes_.begin_library(name_in(rest));
  }

  // Behind `v`.
  bool read_vertex() {
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      skip_in_line();
      const char* const number = cursor_.position();
      const NumberKind kind = take_number(point[axis]);
      if (kind != NumberKind::finite) [[unlikely]]
        return fail_coordinate(number, kind, axis);
    }
    skip_in_line();
    if (!cursor_.is_at_line_end() && !read_weight_or_colour()) return false;
    add_point(point, cursor_);
    return true;
  }

  void add_point(const Vec3& point, const AsciiCursor& cursor) {
    read_.soup.points.push_back(point);
    if (read_.soup.points.size() == kElementsForEstimate)
      reserve_points(read_.soup, estimated_count(bytes_.data(), kElementsForEstimate, cursor));
  }

  bool read_weight_or_colour() {
    std::array<double, 4> numbers{};
    std::size_t count = 0;
    for (; !cursor_.is_at_line_end(); ++count, skip_in_line()) {
      if (count == numbers.size()) return fail_expected("the end of the line");
      if (take_number(numbers[count]) == NumberKind::none) return fail_expected("a number or the end of the line");
    }
    if (count == 2)
      return fail_at_cursor(
          fmt::format("vertex {} has 5 numbers; expected 3, or with a weight 4, or with a colour 6 or 7",
                      read_.soup.points.size() + 1));
    if (count > 2) ++coloured_count_;
    if (count == 1 && numbers[0] != 1) ++weighted_count_;
    return true;
  }

  // Behind `f`.
  bool read_face() {
    auto& corners = read_.soup.corners;
    const std::size_t first_corner = corners.size();
    if (face_count_ == 0) first_face_ = cursor_.position();
    ++face_count_;
    for (;;) {
      skip_in_line();
      if (cursor_.is_at_line_end()) break;
      if (!read_corner(corners.size() - first_corner)) [[unlikely]]
        return false;
    }
    if (corners.size() - first_corner < 3) [[unlikely]] {
      if (wants_attributes_) attributes_.drop_corners(corners.size() - first_corner);
      corners.resize(first_corner);
      ++short_face_count_;
      return true;
    }
    if (corners.size() > kMostInSoup) [[unlikely]]
      return fail(too_many("corners of faces"));
    read_.soup.face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    if (wants_attributes_) attributes_.end_face();
    if (face_count_ == kElementsForEstimate) reserve_remaining_faces(cursor_);
    return true;
  }

  bool read_corner(std::size_t corner) {
    const char* const word = cursor_.position();
    const bool counts_back = *word == '-';
    if (counts_back || *word == '+') cursor_.move_to(word + 1);
    std::uint64_t index = 0;
    std::array<ObjAttributes::Index, 2> attributes{};
    if (!cursor_.take_digits(index) || !take_attributes(attributes)) [[unlikely]]
      return fail_corner(word, corner, "expected an index such as 1, 1/2, 1//3 or 1/2/3");
    const std::uint64_t limit = counts_back ? read_.soup.points.size() : point_limit_;
    if (index == 0) [[unlikely]]
      return fail_corner(word, corner, "expected an index from 1, or below 0 counted from the last vertex");
    if (index > limit) [[unlikely]]
      return fail_index(word, corner, counts_back, limit);
    if (!counts_back) greatest_index_ = std::max(greatest_index_, index);
    read_.soup.corners.push_back(static_cast<std::uint32_t>(counts_back ? limit - index : index - 1));
    if (wants_attributes_) attributes_.add_corner(attributes[0], attributes[1]);
    return true;
  }

  // Behind the first index of a corner: `/t`, `//n` or `/t/n`, where t and n may also be missing.
  bool take_attributes(std::array<ObjAttributes::Index, 2>& indices) {
    for (std::size_t slash = 0; slash < 2 && !cursor_.is_at_end() && *cursor_.position() == '/'; ++slash) {
      cursor_.move_to(cursor_.position() + 1);
      std::uint64_t index = 0;
      const bool has_sign = !cursor_.is_at_end() && (*cursor_.position() == '-' || *cursor_.position() == '+');
      const bool counts_back = has_sign && *cursor_.position() == '-';
      if (has_sign) cursor_.move_to(cursor_.position() + 1);
      if (!cursor_.take_digits(index) && has_sign) return false;
      indices[slash] = static_cast<ObjAttributes::Index>(index) * (counts_back ? -1 : 1);
    }
    return cursor_.is_at_end() || is_blank(*cursor_.position()) || *cursor_.position() == '#' || is_at_continuation();
  }

  bool fail_corner(const char* word, std::size_t corner, std::string_view expected) {
    cursor_.move_to(word);
    return fail_at_cursor(
        fmt::format("face {}, corner {} is {}; {}", face_count_, corner + 1, found_text(cursor_.rest()), expected));
  }
  bool fail_index(const char* word, std::size_t corner, bool counts_back, std::uint64_t limit) {
    if (counts_back && limit == 0) return fail_corner(word, corner, "expected a vertex before it");
    if (counts_back)
      return fail_corner(word, corner, fmt::format("expected -{} to -1, since {} before it", limit, vertices(limit)));
    if (limit == 0) return fail_corner(word, corner, "expected a vertex in the file");
    return fail_corner(word, corner, fmt::format("expected 1 to {}, since {} in the file", limit, vertices(limit)));
  }
  static std::string vertices(std::uint64_t count) {
    return count == 1 ? "1 vertex stands" : fmt::format("{} vertices stand", count);
  }

  bool fail_coordinate(const char* number, NumberKind kind, std::size_t axis) {
    if (kind == NumberKind::none) return fail_expected("a number");
    cursor_.move_to(number);
    const std::string_view expected =
        kind == NumberKind::too_large ? "a number within the range of double" : "a finite number";
    return fail_at_cursor(fmt::format("vertex {}: {} is {}; expected {}", read_.soup.points.size() + 1, "xyz"[axis],
                                      found_text(cursor_.rest()), expected));
  }

  // A number may also end at a comment or where the line is continued.
  NumberKind take_number(double& value) {
    const NumberKind kind = cursor_.take_number(value);
    if (kind != NumberKind::none) [[likely]]
      return kind;
    const char* stop = cursor_.position();
    while (stop != end_ && !is_blank(*stop) && *stop != '\\' && *stop != '#') ++stop;
    AsciiCursor word(cursor_.position(), stop);
    const NumberKind kind_of_word = word.take_number(value);
    cursor_.move_to(word.position());
    return kind_of_word;
  }

  void skip_in_line() {
    cursor_.skip_blanks_in_line();
    while (is_at_continuation()) [[unlikely]] {
        move_behind_line_break(cursor_.position() + 1);
        cursor_.skip_blanks_in_line();
      }
  }
  [[nodiscard]] bool is_at_continuation() const {
    const char* const p = cursor_.position();
    return p != end_ && *p == '\\' && (p + 1 == end_ || is_line_break(p[1]));
  }
  void move_behind_line_break(const char* position) {
    if (position != end_ && *position == '\r') ++position;
    if (position != end_ && *position == '\n' && (position[-1] == '\r' || position[-1] == '\\')) ++position;
    cursor_.move_to(position);
  }
  // To the end of the line, or of the last of those that are joined.
  void skip_statement() {
    for (;;) {
      const char* const first = cursor_.position();
      cursor_.move_to(line_ends_.find(first));
      if (cursor_.position() == first || cursor_.position()[-1] != '\\') return;
      move_behind_line_break(cursor_.position());
    }
  }

  void note_name(ObjStatement statement, std::string_view rest) {
    const bool is_first = counts_[static_cast<std::size_t>(statement)] == 1;
    const bool has_object = counts_[static_cast<std::size_t>(ObjStatement::object)] > 0;
    if (!is_first || (statement == ObjStatement::group && has_object)) return;
    read_.soup.name = name_in(rest);
  }
  /// The rest of the statement; lines that a backslash joins are one.
  static std::string name_in(std::string_view rest) {
    std::string name(rest);
    for (std::size_t end = name.find_first_of("\r\n"); end != std::string::npos; end = name.find_first_of("\r\n"))
      name.erase(end - 1, name.find_first_not_of("\r\n", end) - (end - 1));
    return std::string(trimmed(name));
  }

  // False if this is padding behind the last statement, or an error.
  bool note_unknown(const char* first, std::string_view keyword) {
    if (!is_obj_keyword(keyword)) {
      cursor_.move_to(first);
      const std::string_view rest = cursor_.rest();
      if (!is_padding(rest)) return fail_expected("a statement of an OBJ file such as 'v' or 'f'");
      read_.remarks.push_back(
          fmt::format("{} after the last statement ignored", counted(rest.size(), "trailing byte")));
      cursor_.move_to(end_);
      return false;
    }
    if (first_unknown_ == nullptr) first_unknown_ = first;
    return true;
  }

  // A text of unknown words alone is something else than an OBJ file.
  bool knows_some_statement() {
    const auto unknown = counts_[static_cast<std::size_t>(ObjStatement::unknown)];
    std::size_t known = read_.soup.points.size() + face_count_;
    for (const std::size_t count : counts_) known += count;
    if (unknown == 0 || known > unknown) return true;
    cursor_.move_to(first_unknown_);
    return fail_expected("a statement of an OBJ file such as 'v' or 'f'");
  }

  // Estimates that are too low cost a reallocation; room that is not used is only addresses.
  [[nodiscard]] static std::size_t estimated_count(const char* begin, std::size_t count, const AsciiCursor& cursor) {
    const auto taken = static_cast<std::size_t>(cursor.position() - begin);
    const std::size_t rest = cursor.rest().size() / (taken / count + 1);
    return count + rest + rest / 16;
  }
  void reserve_remaining_faces(const AsciiCursor& cursor) {
    const std::size_t corner_count = read_.soup.corners.size();
    if (corner_count == 0) return;
    reserve_faces(read_.soup, estimated_count(first_face_, kElementsForEstimate, cursor),
                  estimated_count(first_face_, corner_count, cursor));
  }

  void add_remarks() {
    if (!wants_attributes_) add_count(ObjStatement::texture_coordinates, "texture coordinate", "");
    if (!wants_attributes_) add_count(ObjStatement::normal, "normal", "");
    add_remark(coloured_count_, "colour", "");
    add_remark(weighted_count_, "vertex weight", " other than 1");
    add_count(ObjStatement::line, "line element", " (l)");
    add_count(ObjStatement::point, "point element", " (p)");
    const std::size_t before = read_.remarks.size();
    add_count(ObjStatement::free_form, "statement", " on curves and surfaces");
    add_remark(short_face_count_, "face", " with fewer than 3 corners");
    read_.unread.assign(read_.remarks.begin() + static_cast<std::ptrdiff_t>(before), read_.remarks.end());
    if (first_unknown_ == nullptr) return;
    cursor_.move_to(first_unknown_);
    add_count(ObjStatement::unknown, "statement",
              fmt::format(" with an unknown keyword, the first {} in line {},", found_text(cursor_.rest()),
                          line_number(bytes_, offset_of_cursor())));
  }
  void add_attributes() {
    std::size_t unknown_count = 0;
    read_.soup.attributes =
        std::make_shared<const algebra3d::SoupAttributes>(std::move(attributes_).finish(unknown_count));
    if (unknown_count > 0)
      read_.remarks.push_back(fmt::format("{} of corners to missing texture coordinates or normals ignored",
                                          counted(unknown_count, "reference")));
  }
  void add_count(ObjStatement statement, std::string_view noun, std::string_view which) {
    add_remark(counts_[static_cast<std::size_t>(statement)], noun, which);
  }
  void add_remark(std::size_t count, std::string_view noun, std::string_view which) {
    if (count > 0) read_.remarks.push_back(fmt::format("{}{} ignored", counted(count, noun), which));
  }

  [[nodiscard]] std::size_t offset_of_cursor() const {
    return static_cast<std::size_t>(cursor_.position() - bytes_.data());
  }
  bool fail_expected(std::string_view expected) {
    const std::string found =
        !cursor_.is_at_end() && cursor_.is_at_line_end() ? "end of line" : found_text(cursor_.rest());
    return fail_at_cursor(fmt::format("expected {}, found {}", expected, found));
  }
  bool fail_at_cursor(std::string_view what) {
    const std::size_t offset = offset_of_cursor();
    return fail(Error{ErrorCode::file_format, "byte {}, line {}: {}", offset, line_number(bytes_, offset), what}.about(
        file_name_));
  }
  [[nodiscard]] Error too_many(std::string_view what) const {
    return Error{ErrorCode::limit_exceeded, "more than {} {}", kMostInSoup, what}.about(file_name_);
  }

  bool wants_attributes_;
  ObjAttributes attributes_;
  std::uint64_t point_limit_;
  AsciiCursor cursor_;
  const char* end_;
  LineEnds line_ends_;
  ReadMesh read_;
  std::array<std::size_t, kObjStatementCount> counts_{};  // not of vertices and faces
  std::size_t face_count_ = 0;                            // statements, also of faces that are left out
  std::size_t coloured_count_ = 0;
  std::size_t weighted_count_ = 0;
  std::size_t short_face_count_ = 0;
  std::uint64_t greatest_index_ = 0;
  const char* first_face_ = nullptr;
  const char* first_unknown_ = nullptr;
};

}  // namespace

Result<ReadMesh> read_obj(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel,
                          Wanted wanted) {
  ObjReader reader(bytes, file_name, cancel, wanted, kGreatestInteger);
  auto read = reader.read();
  if (!read || reader.greatest_index() <= read->soup.points.size()) return read;
  // Vertices may come behind the faces that name them. Only now is it known that some never came: read again, so that
  // the error names the place.
  return ObjReader(bytes, file_name, cancel, wanted, read->soup.points.size()).read();
}

Result<ReadMesh> read_obj_file(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto file = FileContent::read(path, cancel);
  if (!file) return std::move(file).error();
  return read_obj(file->bytes(), path.string(), cancel);
}

}  // namespace mesh_formats
