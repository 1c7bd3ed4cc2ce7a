#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "queries/language/token.h"

namespace queries {

/// True for a letter with letters, digits and `_` behind it: what names objects and attributes. Symbols of nested lists
/// may be anything.
bool is_identifier(std::string_view text);

bool is_blank(char c);

/// The message for an integer that is no int.
std::string int_range_text(std::string_view digits);

/// Cuts the text of one command into tokens, on demand, so that the parser may take raw text in between.
/// The text outlives the scanner. Places count from `start`; columns count characters, not bytes. Cost: linear.
class Scanner {
 public:
  explicit Scanner(std::string_view source, SourcePlace start = {"", 1, 1});

  /// The token `ahead` places after the next. Errors are given by `take` when they are reached.
  const Token& peek(std::size_t ahead = 0);
  /// The next token; steps over it.
  Token take();
  /// The first thing that is no token (an unterminated string, a number out of range), if `peek` has come across one.
  const std::optional<algebra3d::Error>& error() const { return error_; }

  /// The text from here to the bracket that closes the one around it, strings and comments of nested lists respected.
  /// Steps over the text, not over the bracket. `closing` is ']' or ')'. Empty optional if the bracket is missing.
  std::optional<std::string_view> take_raw_until(char closing);
  /// The text of the nested list `(...)` that begins at the next token; steps over it.
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
  bool starts_with(std::string_view text) const { return source_.substr(position_).starts_with(text); }
  char at(std::size_t offset) const { return offset < source_.size() ? source_[offset] : '\0'; }

  std::string_view source_;
  SourcePlace place_;             // of known_offset_
  std::size_t known_offset_ = 0;  // places are counted from here on, so that long commands cost linear time
  std::size_t position_ = 0;
  std::deque<Token> buffer_;
  std::optional<algebra3d::Error> error_;
  std::optional<SourcePlace> long_literal_;  // the first in quotes that runs over a line end
};

}  // namespace queries
