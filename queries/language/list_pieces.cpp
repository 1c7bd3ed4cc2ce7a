#include "queries/language/list_pieces.h"

#include <algorithm>

#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/utf8.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::NestedList;
using algebra3d::Result;
using algebra3d::SourcePlace;
using algebra3d::Status;

constexpr std::string_view kBlanks = " \t\n\r\v\f";
constexpr std::string_view kCommentBegin = "_!";
constexpr std::string_view kCommentEnd = "!_";
constexpr std::string_view kTagBegin = "<text>";
constexpr std::string_view kTagEnd = "</text--->";

// The end mark of a text in tags, a file atom or a comment that begins here; empty if none does.
std::string_view closing_of(std::string_view rest) {
  if (rest.starts_with(kTagBegin)) return kTagEnd;
  if (rest.starts_with(algebra3d::kFileAtomBegin)) return algebra3d::kFileAtomEnd;
  return rest.starts_with(kCommentBegin) ? kCommentEnd : "";
}

}  // namespace

Status ListPieces::enter() {
  skip_blanks();
  if (position_ == text_.size() || text_[position_] != '(') return error("'('");
  ++position_;
  return {};
}

Status ListPieces::leave() {
  skip_blanks();
  if (position_ == text_.size() || text_[position_] != ')') return error("')'");
  ++position_;
  return {};
}

Result<std::optional<std::string_view>> ListPieces::next() {
  skip_blanks();
  if (position_ == text_.size()) return error("')' or another element");
  if (text_[position_] == ')') return std::optional<std::string_view>();
  const std::size_t begin = position_;
  const std::size_t end = end_of_element(begin);
  if (end == std::string_view::npos) return error("the end of this list or text");
  position_ = end;
  return std::optional(text_.substr(begin, end - begin));
}

Result<NestedList> ListPieces::read(std::string_view what) {
  A3D_ASSIGN(const auto piece, next());
  if (!piece) return error(what);
  return parse(*piece);
}

Result<NestedList> ListPieces::parse(std::string_view piece) const {
  auto list = NestedList::parse(piece);
  if (list) return list;
  // Places are counted from the beginning of the text, so only where one is needed.
  return NestedList::parse(piece, place_of(static_cast<std::size_t>(piece.data() - text_.data())));
}

bool ListPieces::is_at_end() {
  skip_blanks();
  return position_ == text_.size();
}

SourcePlace ListPieces::place() {
  skip_blanks();
  return place_of(position_);
}

void ListPieces::skip_blanks() {
  while (position_ < text_.size()) {
    if (kBlanks.find(text_[position_]) != std::string_view::npos) {
      ++position_;
    } else if (text_.substr(position_).starts_with(kCommentBegin)) {
      const std::size_t end = text_.find(kCommentEnd, position_ + kCommentBegin.size());
      position_ = end == std::string_view::npos ? text_.size() : end + kCommentEnd.size();
    } else {
      return;
    }
  }
}

// The offset behind the element that begins here, or npos.
std::size_t ListPieces::end_of_element(std::size_t begin) const {
  std::size_t depth = 0;
  std::size_t position = begin;
  do {
    algebra3d::poll_interruption();
    if (position >= text_.size()) return std::string_view::npos;
    const char c = text_[position];
    const std::string_view rest = text_.substr(position);
    if (c == '"' || c == '\'') {
      position = end_of_quoted(position);
    } else if (const std::string_view close = closing_of(rest); !close.empty()) {
      const std::size_t end = text_.find(close, position + 2);
      position = end == std::string_view::npos ? end : end + close.size();
    } else if (c == '(' || c == ')') {
      depth = c == '(' ? depth + 1 : depth - 1;
      ++position;
    } else if (kBlanks.find(c) != std::string_view::npos) {
      ++position;
    } else {
      position = std::min(text_.find_first_of(" \t\n\r\v\f()\"'", position), text_.size());
    }
  } while (depth > 0);
  return position;
}

std::size_t ListPieces::end_of_quoted(std::size_t begin) const {
  for (std::size_t position = begin + 1; position < text_.size(); ++position) {
    if (text_[position] == text_[begin]) return position + 1;
    // A backslash escapes the quote and another backslash, and stands for itself before anything else.
    const char following = position + 1 < text_.size() ? text_[position + 1] : '\0';
    if (text_[position] == '\\' && (following == text_[begin] || following == '\\')) ++position;
  }
  return std::string_view::npos;
}

// Counted only for messages.
SourcePlace ListPieces::place_of(std::size_t offset) const {
  return algebra3d::place_behind(text_.substr(0, offset), {file_, 1, 1});
}

Error ListPieces::error(std::string_view expected) {
  const std::string_view rest = text_.substr(std::min(position_, text_.size()));
  const std::string found = rest.empty() ? "the end of the file" : "'" + std::string(rest.substr(0, 20)) + "'";
  return Error(ErrorCode::invalid_value, "expected {}, found {}", expected, found).at(place_of(position_));
}

}  // namespace queries
