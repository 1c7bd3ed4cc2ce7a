#include "queries/language/scanner.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/utf8.h"
#include "base/interruption_scope.h"
#include "base/number_text.h"

namespace queries {
namespace {

using Kind = Token::Kind;

constexpr std::uint64_t kLargestMagnitude = std::uint64_t{1} << 63U;

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return is_letter(c) || is_digit(c);
}
// The text that an unclosed literal has swallowed, if that may be further commands.
std::string swallowed_text(std::string_view literal, const SourcePlace& place) {
  const auto line_count = std::ranges::count(literal, '\n');
  if (line_count == 0 && literal.find(';') == std::string_view::npos) return "";
  const std::string_view why = "was read as part of it, and not run";
  if (line_count == 0) return fmt::format("; the rest of the line {}", why);
  return fmt::format("; everything from there to the end of line {} {}", place.line + line_count, why);
}

bool is_operator_character(char c) {
  return std::string_view("+-*/<>=#:!?%&^~|@\\").find(c) != std::string_view::npos;
}

}  // namespace

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool is_identifier(std::string_view text) {
  return !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), is_word);
}

std::string int_range_text(std::string_view digits) {
  constexpr std::size_t kShown = 40;
  return fmt::format(
      "the integer {}{} is beyond the range of ints (-9223372036854775808 to 9223372036854775807); write it with a "
      "point for a real",
      digits.substr(0, kShown), digits.size() > kShown ? "..." : "");
}

std::string Token::shown() const {
  switch (kind) {
    case Kind::end:
      return "the end of the command";
    case Kind::integer:
      return fmt::format("'{}'", integer);
    case Kind::real:
      return fmt::format("'{}'", algebra3d::real_text(real));
    case Kind::string:
      return fmt::format(R"(the string "{}")", text);
    case Kind::text:
      return fmt::format("the text '{}{}'", algebra3d::utf8_prefix(text, 40), text.size() > 40 ? "..." : "");
    case Kind::file:
      return fmt::format("the file atom '{}'", text);
    case Kind::attribute:
      return fmt::format("'{}{}'", parameter == 2 ? ".." : ".", text);
    case Kind::parameter:
      return parameter == 1 ? "'.'" : parameter == 2 ? "'..'" : fmt::format("'${}'", parameter);
    case Kind::name:
      return fmt::format("`{}`", text);
    case Kind::constant:
      return fmt::format("'${}'", text);
    default:
      return fmt::format("'{}'", text);
  }
}

Scanner::Scanner(std::string_view source, SourcePlace start) : source_(source), place_(std::move(start)) {}

// Offsets are asked for in ascending order, from where the scanner was set back to.
SourcePlace Scanner::place_of(std::size_t offset) {
  for (; known_offset_ < offset; ++known_offset_) {
    const char c = source_[known_offset_];
    if (c == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if (!algebra3d::is_utf8_continuation(c)) {
      ++place_.column;
    }
  }
  return place_;
}

const Token& Scanner::peek(std::size_t ahead) {
  while (buffer_.size() <= ahead) buffer_.push_back(scan());
  return buffer_[ahead];
}

Token Scanner::take() {
  Token token = peek();
  buffer_.pop_front();
  return token;
}

void Scanner::fail(const Token& token, std::string message) {
  if (!error_) error_ = algebra3d::Error(algebra3d::ErrorCode::syntax_error, std::move(message)).at(token.place);
  position_ = source_.size();
}

void Scanner::skip_blanks() {
  while (position_ < source_.size() && is_blank(source_[position_])) ++position_;
}

Token Scanner::scan() {
  algebra3d::poll_interruption();
  skip_blanks();
  Token token;
  token.begin = position_;
  token.place = place_of(position_);
  const char c = at(position_);
  if (position_ >= source_.size())
    token.kind = Kind::end;
  else if (is_letter(c)) {
    while (is_word(at(position_))) ++position_;
    token.text = source_.substr(token.begin, position_ - token.begin);
    token.kind = token.text == "TRUE" || token.text == "FALSE" ? Kind::boolean : Kind::word;
  } else if (is_digit(c) || (c == '.' && is_digit(at(position_ + 1))))
    token = scan_number(std::move(token));
  else if (c == '"' || c == '\'')
    token = scan_quoted(std::move(token), c);
  else if (starts_with("<text>"))
    token = scan_tagged(std::move(token), Kind::text);
  else if (starts_with(algebra3d::kFileAtomBegin))
    token = scan_tagged(std::move(token), Kind::file);
  else if (c == '.')
    token = scan_dots(std::move(token));
  else if (c == '`')
    token = scan_name(std::move(token));
  else if (c == '$' && is_digit(at(position_ + 1)))
    token = scan_dollar(std::move(token));
  else if (c == '$' && is_letter(at(position_ + 1)))
    token = scan_constant(std::move(token));
  else
    token = scan_special(std::move(token));
  token.end = position_;
  return token;
}

Token Scanner::scan_number(Token token) {
  const auto digits = [&] {
    while (is_digit(at(position_))) ++position_;
  };
  bool is_real = false;
  digits();
  // A second dot belongs to what follows; `5.` itself is a real, `5.Name` is not a number with an attribute.
  if (at(position_) == '.' && at(position_ + 1) != '.') {
    is_real = true;
    ++position_;
    digits();
  }
  const char e = at(position_);
  const char sign = at(position_ + 1);
  if ((e == 'e' || e == 'E') && (is_digit(sign) || ((sign == '+' || sign == '-') && is_digit(at(position_ + 2))))) {
    is_real = true;
    position_ += 2;
    digits();
  }
  const std::string_view spelling = source_.substr(token.begin, position_ - token.begin);
  if (is_word(at(position_))) {
    fail(token, "a number ends with '" + std::string(1, at(position_)) + "' after '" + std::string(spelling) + "'");
    return token;
  }
  if (is_real) {
    const auto value = algebra3d::parse_real(spelling);
    if (!value) fail(token, "the number " + std::string(spelling.substr(0, 40)) + " is beyond the range of reals");
    token.kind = Kind::real;
    token.real = value.value_or(0);
    return token;
  }
  // The magnitude of the smallest int is one more than that of the largest; the parser puts the sign in front.
  const auto [end, error] = std::from_chars(spelling.data(), spelling.data() + spelling.size(), token.integer);
  if (error != std::errc() || token.integer > kLargestMagnitude) fail(token, int_range_text(spelling));
  token.kind = Kind::integer;
  token.real = static_cast<double>(token.integer);
  return token;
}

// A quote that was forgotten is noticed late: each that follows closes what it should open.
std::string Scanner::other_unclosed_quote() const {
  if (!long_literal_) return "";
  return fmt::format("; perhaps it is the one at {}:{} that is not closed, whose text runs over a line end",
                     long_literal_->line, long_literal_->column);
}

Token Scanner::scan_quoted(Token token, char quote) {
  token.kind = quote == '"' ? Kind::string : Kind::text;
  ++position_;
  while (position_ < source_.size() && source_[position_] != quote) {
    if (source_[position_] == '\\' && (at(position_ + 1) == quote || at(position_ + 1) == '\\')) ++position_;
    token.text += source_[position_++];
  }
  if (position_ >= source_.size()) {
    fail(token, std::string("a ") + (quote == '"' ? "string" : "text") + " is not closed: expected " + quote +
                    swallowed_text(source_.substr(token.begin), token.place) + other_unclosed_quote());
    return token;
  }
  ++position_;
  const bool has_line_end = source_.substr(token.begin, position_ - token.begin).find('\n') != std::string_view::npos;
  if (!long_literal_ && has_line_end) long_literal_ = token.place;
  return token;
}

Token Scanner::scan_tagged(Token token, Token::Kind kind) {
  const bool is_file = kind == Kind::file;
  const std::string_view close = is_file ? algebra3d::kFileAtomEnd : "</text--->";
  const std::size_t begin =
      position_ + (is_file ? algebra3d::kFileAtomBegin.size() : std::string_view("<text>").size());
  token.kind = kind;
  const std::size_t end = source_.find(close, begin);
  if (end == std::string_view::npos) {
    fail(token, std::string(is_file ? "a file atom" : "a text") + " is not closed: expected " + std::string(close) +
                    swallowed_text(source_.substr(token.begin), token.place));
    return token;
  }
  token.text = source_.substr(begin, end - begin);
  position_ = end + close.size();
  return token;
}

Token Scanner::scan_dots(Token token) {
  token.parameter = at(position_ + 1) == '.' ? 2 : 1;
  position_ += static_cast<std::size_t>(token.parameter);
  const std::size_t begin = position_;
  if (is_letter(at(position_)))
    while (is_word(at(position_))) ++position_;
  token.text = source_.substr(begin, position_ - begin);
  token.kind = token.text.empty() ? Kind::parameter : Kind::attribute;
  return token;
}

Token Scanner::scan_name(Token token) {
  token.kind = Kind::name;
  const std::size_t begin = ++position_;
  while (is_word(at(position_))) ++position_;
  token.text = source_.substr(begin, position_ - begin);
  if (at(position_) == '`' && is_identifier(token.text))
    ++position_;
  else
    fail(token, "expected a name between backquotes: a letter, then letters, digits and _");
  return token;
}

Token Scanner::scan_dollar(Token token) {
  token.parameter = at(position_ + 1) - '0';
  position_ += 2;
  token.kind = Kind::parameter;
  if (at(position_) == '.' && is_letter(at(position_ + 1))) {
    const std::size_t begin = ++position_;
    while (is_word(at(position_))) ++position_;
    token.text = source_.substr(begin, position_ - begin);
    token.kind = Kind::attribute;
  }
  return token;
}

Token Scanner::scan_constant(Token token) {
  token.kind = Kind::constant;
  const std::size_t begin = ++position_;
  while (is_word(at(position_))) ++position_;
  token.text = source_.substr(begin, position_ - begin);
  return token;
}

Token Scanner::scan_special(Token token) {
  token.kind = Kind::special;
  if (starts_with("{{") || starts_with("}}")) {
    position_ += 2;
  } else if (!is_operator_character(at(position_))) {
    ++position_;
  } else {
    // Runs such as <=, :=, :: are one token; a minus or plus in front of a number is left to the parser.
    while (is_operator_character(at(position_)) &&
           (position_ == token.begin || (at(position_) != '-' && at(position_) != '+')))
      ++position_;
  }
  // The message shows all bytes of a character beyond ASCII.
  if (static_cast<unsigned char>(source_[token.begin]) >= 0x80)
    while (position_ < source_.size() && algebra3d::is_utf8_continuation(source_[position_])) ++position_;
  token.text = source_.substr(token.begin, position_ - token.begin);
  if (std::string_view("()[]{},;").find(token.text.front()) == std::string_view::npos &&
      !is_operator_character(token.text.front()))
    fail(token, "the character '" + token.text + "' does not belong to the language");
  return token;
}

void Scanner::rewind_to_next() {
  if (buffer_.empty()) return;
  position_ = buffer_.front().begin;
  known_offset_ = position_;
  place_ = buffer_.front().place;
  buffer_.clear();
  // Text that is not a token may be part of a nested list.
  error_.reset();
}

Token Scanner::literal_at(std::size_t offset) {
  Token token;
  token.begin = offset;
  token.place = place_of(offset);
  return token;
}

// Skips a quoted or tagged literal, or a comment of nested lists. False if something else stands here.
bool Scanner::skip_literal() {
  if (const char c = at(position_); c == '"' || c == '\'') {
    scan_quoted(literal_at(position_), c);
    return true;
  }
  if (starts_with("<text>") || starts_with(algebra3d::kFileAtomBegin)) {
    scan_tagged(literal_at(position_), starts_with("<text>") ? Kind::text : Kind::file);
    return true;
  }
  if (!starts_with("_!")) return false;
  const std::size_t end = source_.find("!_", position_ + 2);
  position_ = end == std::string_view::npos ? source_.size() : end + 2;
  return true;
}

bool Scanner::has_comma_in_next_parentheses() {
  const std::size_t begin = peek(1).begin;
  if (known_comma_.first == begin) return known_comma_.second;
  Scanner ahead(source_.substr(begin + 1));  // with errors of its own: the parser finds them again
  int depth = 0;
  bool has_comma = false;
  while (depth >= 0 && !has_comma && ahead.position_ < ahead.source_.size()) {
    algebra3d::poll_interruption_at(ahead.position_);
    if (ahead.skip_literal()) continue;
    const char c = ahead.source_[ahead.position_++];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    has_comma = c == ',' && depth == 0;
  }
  known_comma_ = {begin, has_comma};
  return has_comma;
}

std::optional<std::string_view> Scanner::take_raw_until(char closing) {
  rewind_to_next();
  const std::size_t begin = position_;
  int depth = 0;
  while (position_ < source_.size()) {
    algebra3d::poll_interruption_at(position_);
    const char c = source_[position_];
    if (depth == 0 && c == closing) return source_.substr(begin, position_ - begin);
    if (skip_literal()) continue;
    if (c == '(') ++depth;
    if (c == ')') --depth;
    ++position_;
    if (closing == ')' && depth < 0) break;
  }
  return std::nullopt;
}

std::optional<std::string_view> Scanner::take_raw_list() {
  rewind_to_next();
  skip_blanks();
  const std::size_t begin = position_;
  if (at(position_) != '(') return std::nullopt;
  ++position_;
  if (!take_raw_until(')')) return std::nullopt;
  ++position_;
  return source_.substr(begin, position_ - begin);
}

}  // namespace queries
