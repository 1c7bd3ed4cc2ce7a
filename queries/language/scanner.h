#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "queries/language/token.h"

namespace queries {

/// True for a name of an object or attribute: a letter, then letters, digits and `_`. Symbols of nested lists are not
/// restricted.
bool is_identifier(std::string_view text);

bool is_blank(char c);

/// The message for an integer beyond the range of int.
std::string int_range_text(std::string_view digits);

/// Splits the text of one command into tokens, on demand, so that the parser can take raw text in between. The text
/// outlives the scanner. Positions are relative to `start`; columns count characters, not bytes. Cost: linear.
class Scanner {
 public:
  explicit Scanner(std::string_view source, SourcePlace start = {"", 1, 1});

  /// The token `ahead` positions after the next. `take` returns errors when it reaches them.
  const Token& peek(std::size_t ahead = 0);
  /// Returns and skips the next token.
  Token take();
  /// The first invalid token (an unterminated string, a number out of range) that `peek` has found, if any.
  const std::optional<algebra3d::Error>& error() const { return error_; }

  /// Whether the parentheses that begin at the token after the next hold a comma outside of further brackets, as those
  /// of a call with several arguments do; raw text in them is not read as tokens. Domain: that token is `(`.
  bool has_comma_in_next_parentheses();

  /// Returns and skips the text up to the enclosing bracket `closing` (']' or ')'), which stays. Brackets within
  /// strings and comments of nested lists are ignored. Nothing if the bracket is missing.
  std::optional<std::string_view> take_raw_until(char closing);
  /// Returns and skips the text of the nested list `(...)` that begins at the next token.
  std::optional<std::string_view> take_raw_list();

  std::string_view source() const { return source_; }

 private:
  Token scan();
  void skip_blanks();
  Token scan_number(Token token);
  Token scan_quoted(Token token, char quote);
  Token scan_tagged(Token token, Token::Kind kind);
  Token scan_dots(Token token);
  Token scan_name(Token token);
  Token scan_dollar(Token token);
  Token scan_constant(Token token);
  Token scan_special(Token token);
  SourcePlace place_of(std::size_t offset);
  Token literal_at(std::size_t offset);
  std::string other_unclosed_quote() const;
  void fail(const Token& token, std::string message);
  void rewind_to_next();
  bool skip_literal();
  bool starts_with(std::string_view text) const { return source_.substr(position_).starts_with(text); }
  char at(std::size_t offset) const { return offset < source_.size() ? source_[offset] : '\0'; }

  std::string_view source_;
  SourcePlace place_;             // of known_offset_
  std::size_t known_offset_ = 0;  // positions are counted from here, so that long commands cost linear time
  std::size_t position_ = 0;
  std::deque<Token> buffer_;
  std::optional<algebra3d::Error> error_;
  std::pair<std::size_t, bool> known_comma_{std::string_view::npos, false};  // of the parentheses asked for last
  std::optional<SourcePlace> long_literal_;  // the first quoted literal with a line break
};

}  // namespace queries
