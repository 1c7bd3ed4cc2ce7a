#include "stl/solid_names.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::Keyword;
using algebra3d::NumberKind;

namespace {

constexpr Keyword kEnd("end");

// Comments are not skipped here: they reach to the end of the line, and looking past them for each word would make long
// lines of them quadratic.
bool take_next(AsciiCursor& cursor, const Keyword& keyword) {
  cursor.skip_blanks();
  return cursor.take(keyword);
}

bool begins_a_facet(AsciiCursor word) {
  if (!word.take(kFacet) || !take_next(word, kNormal)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    double value = 0;
    word.skip_blanks();
    if (word.take_number(value) == NumberKind::none) return false;
  }
  return take_next(word, kOuter);
}

}  // namespace

bool take_end(AsciiCursor& cursor, const Keyword& joined, const Keyword& second) {
  if (cursor.take(joined)) return true;
  AsciiCursor both = cursor;
  if (!both.take(kEnd) || !take_next(both, second)) return false;
  cursor = both;
  return true;
}

void SolidNames::load_line(const char* position) {
  if (line_end_ != nullptr && line_begin_ <= position && position <= line_end_) return;
  line_begin_ = position;
  line_end_ = position;
  while (line_end_ != end_ && *line_end_ != '\n' && *line_end_ != '\r') ++line_end_;
  next_ = AsciiCursor(line_end_, end_);
  next_.skip_space();
}

bool SolidNames::ends_a_solid(AsciiCursor word) {
  if (!take_end(word, kEndsolid, kSolid) || word.position() > line_end_) return false;
  return next_.is_at_end() || next_.is_at(kSolid);
}

const char* SolidNames::end_of_solid_name(const char* name) {
  load_line(name);
  for (AsciiCursor word(name, end_);; word.skip_word()) {
    word.skip_blanks();
    if (word.position() >= line_end_) return line_end_;
    if (begins_a_facet(word) || ends_a_solid(word)) return word.position();
  }
}

const char* SolidNames::end_of_endsolid_name(const char* name) {
  load_line(name);
  for (AsciiCursor word(name, end_);; word.skip_word()) {
    word.skip_blanks();
    if (word.position() >= line_end_) return line_end_;
    if (!word.is_at(kSolid)) continue;
    const bool facets_follow = next_.is_at(kFacet) || next_.is_at(kEndsolid);
    const bool begins_here = facets_follow || end_of_solid_name(word.position() + kSolid.size()) < line_end_;
    return begins_here ? word.position() : line_end_;
  }
}

}  // namespace mesh_formats
