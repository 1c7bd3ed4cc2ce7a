#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/types/nested_list.h"

namespace queries {

/// Walks through the text of a nested list element by element, so that a list that is larger than memory can be read
/// piece by piece. Knows only as much of the notation as is needed to find where an element ends; `NestedList::parse`
/// reads the pieces. The text outlives the reader. Used by one thread. Cost: linear, no recursion.
class ListPieces {
 public:
  /// `file` is the name for messages.
  ListPieces(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// Steps over `(`. Errors: invalid_value if something else comes next.
  algebra3d::Status enter();
  /// Steps over `)`. Errors: invalid_value if the list goes on.
  algebra3d::Status leave();
  /// Steps over the next element, a list or an atom, and gives its text; nothing before `)`.
  /// Errors: invalid_value at the end of the text.
  algebra3d::Result<std::optional<std::string_view>> next();
  /// An element that `next` gave, read as a nested list. Errors have their place in the whole text.
  algebra3d::Result<algebra3d::NestedList> parse(std::string_view piece) const;
  /// `next`, which must be there, read as a nested list.
  algebra3d::Result<algebra3d::NestedList> read(std::string_view what);
  /// Whether nothing but blanks and comments follows.
  bool is_at_end();
  /// The place of the next element.
  algebra3d::SourcePlace place();

 private:
  void skip_blanks();
  std::size_t end_of_element(std::size_t begin) const;
  std::size_t end_of_quoted(std::size_t begin) const;
  algebra3d::SourcePlace place_of(std::size_t offset) const;
  algebra3d::Error error(std::string_view expected);

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
};

}  // namespace queries
