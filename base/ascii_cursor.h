#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "algebra3d/base/vec3.h"
#include "base/detail/plain_number.h"
#include "base/text.h"

namespace algebra3d {

/// A keyword of an ASCII format: at most eight lower-case letters. Matching ignores case.
class Keyword {
 public:
  explicit constexpr Keyword(std::string_view text) : text_(text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      letters_ |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[i])) << (8 * i);
      mask_ |= std::uint64_t{0xff} << (8 * i);
    }
  }
  [[nodiscard]] constexpr std::string_view text() const { return text_; }
  [[nodiscard]] constexpr std::size_t size() const { return text_.size(); }
  /// True if the low bytes of `word` spell the keyword. Setting bit 5 maps exactly a letter's two cases to
  /// the lower one.
  [[nodiscard]] constexpr bool matches(std::uint64_t word) const {
    return ((word | 0x2020202020202020U) & mask_) == letters_;
  }

 private:
  std::string_view text_;
  std::uint64_t letters_ = 0;
  std::uint64_t mask_ = 0;
};

/// The result of `AsciiCursor::take_number`.
enum class NumberKind { finite, not_finite, too_large, none };

/// The greatest integer that `take_digits` returns: 18 digits, beyond any count or index.
inline constexpr std::uint64_t kGreatestInteger = 999'999'999'999'999'999;

/// A cursor in the text of an ASCII file that reads tokens. Does not allocate. The text must outlive it.
class AsciiCursor {
 public:
  AsciiCursor(const char* position, const char* end) : position_(position), end_(end) {}

  [[nodiscard]] const char* position() const { return position_; }
  [[nodiscard]] bool is_at_end() const { return position_ == end_; }
  [[nodiscard]] std::string_view rest() const { return {position_, static_cast<std::size_t>(end_ - position_)}; }
  void move_to(const char* position) { position_ = position; }

  void skip_blanks() {
    const char* p = position_;  // not the member: characters may alias it, so it would be stored at every step
    while (p != end_ && is_blank(*p)) ++p;
    position_ = p;
  }
  /// Skips white space, and comments from `#` to the end of the line.
  void skip_space() {
    skip_blanks();
    if (position_ != end_ && *position_ == '#') skip_comments();
  }
  void skip_word() {
    while (position_ != end_ && !is_blank(*position_)) ++position_;
  }

  /// Skips white space other than line breaks.
  void skip_blanks_in_line() {
    const char* p = position_;
    // Mostly a single blank.
    if (end_ - p > 1 && *p == ' ' && p[1] > ' ') [[likely]] {
      position_ = p + 1;
      return;
    }
    while (p != end_ && is_blank(*p) && !is_line_break(*p)) ++p;
    position_ = p;
  }
  /// True before a line break or a comment, and at the end.
  [[nodiscard]] bool is_at_line_end() const {
    return position_ == end_ || is_line_break(*position_) || *position_ == '#';
  }

  [[nodiscard]] bool is_at_line_break() const { return position_ != end_ && is_line_break(*position_); }

  /// True if the word here is `keyword`.
  [[nodiscard]] bool is_at(const Keyword& keyword) const {
    const auto left = static_cast<std::size_t>(end_ - position_);
    if (left > sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, position_, sizeof word);
      return keyword.matches(word) && is_blank(position_[keyword.size()]);
    }
    return is_at_near_end(keyword, left);
  }
  /// Skips the next word if it is `keyword`.
  bool take(const Keyword& keyword) {
    if (!is_at(keyword)) return false;
    position_ += keyword.size();
    return true;
  }

  /// Reads a number that is a whole word: decimal digits with sign, point and exponent as usual. Spellings of NaN and
  /// infinity (also `1.#QNAN`) are not_finite, numbers beyond the range of double too_large; both are skipped.
  /// Exactness: the double nearest to the digits. Source: [lemire2021].
  NumberKind take_number(double& value);

  /// Reads a number that `pass_plain_number` accepts, as nearly all are; else does not move. Faster than `take_number`
  /// if the cursor is a local variable, which stays in registers.
  bool take_plain_number(double& value) {
    if (end_ - position_ < kPlainNumberBytes) [[unlikely]]
      return false;
    const char* const behind = pass_plain_number(position_, value);
    if (behind != nullptr) [[likely]]
      position_ = behind;
    return behind != nullptr;
  }
  /// Reads three numbers, each after white space in the line.
  bool take_plain_numbers(Vec3& values) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      skip_blanks_in_line();
      if (!take_plain_number(values[axis])) [[unlikely]]
        return false;
    }
    return true;
  }
  /// Reads a number of 1 to 7 digits; else does not move.
  bool take_few_digits(std::uint32_t& value) {
    if (end_ - position_ < kPlainNumberBytes) [[unlikely]]
      return false;
    const EightDigits digits(position_);
    const unsigned count = digits.count();
    if (count - 1 >= 7) [[unlikely]]
      return false;
    value = static_cast<std::uint32_t>(digits.front(count));
    position_ += count;
    return true;
  }
  /// Skips `text` if it is next.
  bool take_text(std::string_view text) {
    if (rest().size() < text.size() || std::memcmp(position_, text.data(), text.size()) != 0) return false;
    position_ += text.size();
    return true;
  }

  /// Reads decimal digits, at least one, whatever follows; at most kGreatestInteger.
  bool take_digits(std::uint64_t& value) {
    const char* const first = position_;
    const char* p = first;
    std::uint64_t sum = 0;
    for (; p != end_; ++p) {
      const unsigned digit = static_cast<unsigned char>(*p) - unsigned{'0'};
      if (digit > 9) break;
      sum = 10 * sum + digit;
    }
    if (p - first > 18) [[unlikely]]
      sum = integer_of_many_digits({first, static_cast<std::size_t>(p - first)});
    value = sum;
    position_ = p;
    return position_ != first;
  }

 private:
  void skip_comments();
  [[nodiscard]] bool is_at_near_end(const Keyword& keyword, std::size_t left) const;
  NumberKind take_odd_number();
  static std::uint64_t integer_of_many_digits(std::string_view digits);

  const char* position_;
  const char* end_;
};

}  // namespace algebra3d
