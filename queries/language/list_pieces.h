#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/nested_list.h"

namespace queries {

/// Splits the text of a nested list into its elements, so that a list larger than memory can be read element by
/// element. Finds only the ends of elements; `NestedList::parse` parses them. The text outlives the reader. Used by one
/// thread. Cost: linear, no recursion.
class ListPieces {
 public:
  /// `file` is the name for messages.
  ListPieces(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// Skips `(`. Errors: invalid_value if the next character is another.
  algebra3d::Status enter();
  /// Skips `)`. Errors: invalid_value if the list has more elements.
  algebra3d::Status leave();
  /// Skips the next element, a list or an atom, and returns its text; nothing if the list ends. Errors: invalid_value
  /// at the end of the text.
  algebra3d::Result<std::optional<std::string_view>> next();
  /// Parses an element from `next`. Errors have the position in the whole text.
  algebra3d::Result<algebra3d::NestedList> parse(std::string_view piece) const;
  /// Parses the next element. Errors: also "expected WHAT" if there is none.
  algebra3d::Result<algebra3d::NestedList> read(std::string_view what);
  /// Whether only blanks and comments follow.
  bool is_at_end();
  /// The position of the next element.
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
