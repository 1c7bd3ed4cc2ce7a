#include "algebra3d/values/conversions/wkt.h"

#include <cstdint>
#include <utility>

#include "algebra3d/values/conversions/detail/closed_rings.h"
#include "base/ascii_cursor.h"
#include "base/interruption_scope.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

bool is_wkt_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
bool is_number_part(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

class WktReader {
 public:
  explicit WktReader(std::string_view text) : text_(text) {}
  Result<Polygons> read();

 private:
  Status skip_srid();
  Result<bool> read_tag();
  Status read_mark(std::string mark);
  /// Calls `read_item` for each of a bracketed list.
  Status read_list(Status (WktReader::*read_item)());
  Status read_polygon();
  Status read_ring();
  Status read_point();
  Result<double> read_number();

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  bool take(char sign) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }
  /// The letters here, in upper case; they are passed by `pass`.
  std::string word();
  void pass(const std::string& word) { at_ += word.size(); }
  /// As many parts of a number as stand here.
  std::string_view number_text() const;
  std::string found() const;
  // All bytes before are ASCII, so this one's character has the same number.
  Error expected(std::string_view what) const {
    return {ErrorCode::invalid_value, "character {}: found {}, expected {}", at_ + 1, found(), what};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t least_coordinates_ = 2, most_coordinates_ = 4;
  ClosedRings rings_;
};

std::string WktReader::word() {
  skip_blanks();
  std::string letters;
  for (std::size_t i = at_; i < text_.size() && is_wkt_letter(text_[i]); ++i) letters += upper(text_[i]);
  return letters;
}

std::string_view WktReader::number_text() const {
  std::size_t end = at_;
  while (end < text_.size() && is_number_part(text_[end])) ++end;
  return text_.substr(at_, end - at_);
}

std::string WktReader::found() const {
  if (at_ == text_.size()) return "the end of the text";
  std::size_t end = at_;
  while (end < text_.size() && (is_wkt_letter(text_[end]) || is_number_part(text_[end]))) ++end;
  if (end == at_ && is_blank(text_[at_])) return "white space";
  return found_text(text_.substr(at_, end == at_ ? 1 : end - at_));
}

Status WktReader::skip_srid() {
  const std::string name = word();
  if (name != "SRID") return {};
  pass(name);
  if (!take('=')) return expected("'='");
  skip_blanks();
  if (at_ < text_.size() && text_[at_] == '-') ++at_;
  AsciiCursor cursor(text_.data() + at_, text_.data() + text_.size());
  std::uint64_t ignored = 0;
  if (!cursor.take_digits(ignored)) return expected("an integer");
  at_ = static_cast<std::size_t>(cursor.position() - text_.data());
  return take(';') ? Status() : expected("';'");
}

Status WktReader::read_mark(std::string mark) {
  if (mark.empty()) {
    const std::string next = word();
    if (next != "Z" && next != "M" && next != "ZM") return {};
    pass(next);
    mark = next;
  }
  least_coordinates_ = most_coordinates_ = 2 + mark.size();
  return {};
}

// Whether there may be several polygons.
Result<bool> WktReader::read_tag() {
  const std::string tag = word();
  for (const std::string_view name : {"MULTIPOLYGON", "POLYGON"}) {
    if (!tag.starts_with(name)) continue;
    const std::string mark = tag.substr(name.size());
    if (!mark.empty() && mark != "Z" && mark != "M" && mark != "ZM") break;
    pass(tag);
    A3D_TRY(read_mark(mark));
    return name == "MULTIPOLYGON";
  }
  return expected("POLYGON or MULTIPOLYGON");
}

Status WktReader::read_list(Status (WktReader::*read_item)()) {
  if (!take('(')) return expected("'('");
  do {
    A3D_TRY((this->*read_item)());
  } while (take(','));
  return take(')') ? Status() : expected("',' or ')'");
}

Status WktReader::read_polygon() {
  const std::string next = word();
  if (next == "EMPTY") return pass(next), Status();
  if (!next.empty()) return expected("'(' or EMPTY");
  A3D_TRY(read_list(&WktReader::read_ring));
  rings_.end_face();
  return {};
}

Status WktReader::read_ring() {
  A3D_TRY(read_list(&WktReader::read_point));
  Status ended = rings_.end_ring();
  if (!ended) return std::move(ended).error().about(fmt::format("character {}", at_));
  return {};
}

Status WktReader::read_point() {
  A3D_ASSIGN(const double x, read_number());
  A3D_ASSIGN(const double y, read_number());
  for (std::size_t count = 2; count < most_coordinates_; ++count) {
    skip_blanks();
    if (count >= least_coordinates_ && number_text().empty()) break;
    A3D_TRY(read_number());
  }
  rings_.add_point(x, y);
  return {};
}

Result<double> WktReader::read_number() {
  skip_blanks();
  const std::string_view digits = number_text();
  double value = 0;
  const auto kind = AsciiCursor(digits.data(), digits.data() + digits.size()).take_number(value);
  if (kind == NumberKind::too_large) return expected("a number within the range of doubles");
  if (kind != NumberKind::finite) return expected("a number");
  at_ += digits.size();
  return value;
}

Result<Polygons> WktReader::read() {
  A3D_TRY(skip_srid());
  A3D_ASSIGN(const bool is_multiple, read_tag());
  if (is_multiple) {
    const std::string next = word();
    if (next == "EMPTY") {
      pass(next);
    } else {
      if (!next.empty()) return expected("'(' or EMPTY");
      A3D_TRY(read_list(&WktReader::read_polygon));
    }
  } else {
    A3D_TRY(read_polygon());
  }
  skip_blanks();
  if (at_ != text_.size()) return expected("the end of the text");
  return std::move(rings_).polygons();
}

void append_corner(std::string& text, const Vec3& corner) {
  append_number(text, corner.x);
  text += ' ';
  append_number(text, corner.y);
}

void append_face(std::string& text, const Polygons& polygons, std::size_t face) {
  text += '(';
  for (std::uint32_t cycle = polygons.first_cycle(face); cycle < polygons.face_ends[face]; ++cycle) {
    text += cycle == polygons.first_cycle(face) ? "(" : ", (";
    const std::uint32_t first = polygons.first_corner(cycle);
    for (std::uint32_t corner = first; corner < polygons.cycle_ends[cycle]; ++corner) {
      append_corner(text, polygons.corners[corner].approx);
      text += ", ";
    }
    append_corner(text, polygons.corners[first].approx);
    text += ')';
  }
  text += ')';
}

}  // namespace

Result<Polygons> polygons_from_wkt(std::string_view text) {
  return WktReader(text).read();
}

std::string wkt_of(const Polygons& polygons) {
  if (polygons.face_count() == 0) return "MULTIPOLYGON EMPTY";
  const bool is_multiple = polygons.face_count() > 1;
  std::string text = is_multiple ? "MULTIPOLYGON (" : "POLYGON ";
  for (std::size_t face = 0; face < polygons.face_count(); ++face) {
    poll_interruption_at(face);
    if (face > 0) text += ", ";
    append_face(text, polygons, face);
  }
  if (is_multiple) text += ')';
  return text;
}

}  // namespace algebra3d
