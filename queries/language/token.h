#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace queries {

using algebra3d::SourcePlace;

/// One word of the language, decoded.
struct Token {
  enum class Kind : std::uint8_t {
    end,
    word,       ///< identifier, keyword or operator name
    integer,    ///< `integer` holds it
    real,       ///< `real` holds it
    boolean,    ///< `text` is TRUE or FALSE
    string,     ///< `text` is the decoded content
    text,       ///< the same for 'texts'
    file,       ///< a file atom; `text` is the path
    attribute,  ///< .Name, ..Name, $2.Name: `parameter` and `text`
    parameter,  ///< ., .., $2: `parameter`
    special,    ///< brackets, separators, and runs of special characters
    name,       ///< a name in backquotes: never an operator or a reserved word
    constant,   ///< $name, a parameter of the session: `text`
  };

  Kind kind = Kind::end;
  std::string text;
  std::uint64_t integer = 0;  ///< absolute value, at most 2^63
  double real = 0;
  int parameter = 0;
  SourcePlace place;
  std::size_t begin = 0;  ///< offset in the source
  std::size_t end = 0;    ///< offset after the token

  bool is_name() const { return kind == Kind::word || kind == Kind::name; }
  bool is(std::string_view spelling) const { return (kind == Kind::word || kind == Kind::special) && text == spelling; }
  /// The token for messages: as written, or "the end of the command".
  std::string shown() const;
};

}  // namespace queries
