#include "base/ascii_cursor.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fast_float/fast_float.h>

namespace algebra3d {

namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
}

bool contains_letters(std::string_view word, std::string_view letters) {
  return std::search(word.begin(), word.end(), letters.begin(), letters.end(),
                     [](char a, char b) { return lower(a) == b; }) != word.end();
}

bool is_number_character(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

}  // namespace

void AsciiCursor::skip_comments() {
  while (position_ != end_ && *position_ == '#') {
    while (position_ != end_ && *position_ != '\n' && *position_ != '\r') ++position_;
    skip_blanks();
  }
}

bool AsciiCursor::is_at_near_end(const Keyword& keyword, std::size_t left) const {
  if (left < keyword.size()) return false;
  std::uint64_t word = 0;
  std::memcpy(&word, position_, left);
  return keyword.matches(word) && (left == keyword.size() || is_blank(position_[keyword.size()]));
}

NumberKind AsciiCursor::take_number(double& value) {
  if (take_plain_number(value)) return NumberKind::finite;
  const char* first = position_;
  if (end_ - first > 1 && *first == '+' && first[1] != '-') ++first;
  const auto [behind, error] = fast_float::from_chars(first, end_, value);
  if (error == std::errc{} && (behind == end_ || is_blank(*behind)) && std::isfinite(value)) [[likely]] {
    position_ = behind;
    return NumberKind::finite;
  }
  return take_odd_number();
}

NumberKind AsciiCursor::take_odd_number() {
  AsciiCursor behind = *this;
  behind.skip_word();
  std::string_view word(position_, static_cast<std::size_t>(behind.position_ - position_));
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  const bool starts_with_digit = !word.empty() && word.front() >= '0' && word.front() <= '9';
  NumberKind kind = NumberKind::none;
  if (starts_with_digit ? contains_letters(word, "#ind") || contains_letters(word, "#qnan") ||
                              contains_letters(word, "#snan") || contains_letters(word, "#inf")
                        : contains_letters(word.substr(0, 3), "nan") || contains_letters(word.substr(0, 3), "inf")) {
    kind = NumberKind::not_finite;
  } else {
    // The parser gives infinity, or an error, only for words that are numbers as a whole.
    double value = 0;
    const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number =
        end == word.data() + word.size() && std::all_of(word.begin(), word.end(), is_number_character);
    if (is_number && !word.empty() && word.front() != '-' &&
        (std::isinf(value) || error == std::errc::result_out_of_range))
      kind = NumberKind::too_large;
  }
  if (kind != NumberKind::none) position_ = behind.position_;
  return kind;
}

std::uint64_t AsciiCursor::integer_of_many_digits(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  if (digits.size() > 18) return kGreatestInteger;
  std::uint64_t value = 0;
  for (const char digit : digits) value = 10 * value + static_cast<std::uint64_t>(digit - '0');
  return value;
}

}  // namespace algebra3d
