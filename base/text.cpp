#include "base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

#include <fmt/format.h>

#include "base/interruption_scope.h"

namespace algebra3d {

namespace {

constexpr std::size_t kLongestFound = 24;

std::size_t digits_at_begin(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
}

/// True of "0,5" and "-12,25e3".
bool has_decimal_comma(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  const std::size_t whole = digits_at_begin(word);
  if (whole == 0 || whole == word.size() || word[whole] != ',') return false;
  word.remove_prefix(whole + 1);
  const std::size_t fraction = digits_at_begin(word);
  return fraction > 0 && (fraction == word.size() || word[fraction] == 'e' || word[fraction] == 'E');
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string found_text(std::string_view text) {
  if (text.empty()) return "end of file";
  std::string found = "'";
  std::size_t length = 0;
  for (; length < text.size() && length < kLongestFound && !is_blank(text[length]); ++length) {
    const char c = text[length];
    if (c >= ' ' && c <= '~')
      found += c;
    else
      fmt::format_to(std::back_inserter(found), "\\x{:02x}", static_cast<unsigned char>(c));
  }
  if (length < text.size() && !is_blank(text[length])) found += "...";
  return found + (has_decimal_comma(text.substr(0, length)) ? "' with a decimal comma" : "'");
}

std::size_t find_either(std::string_view text, char a, char b) {
  constexpr std::size_t kBlock = 65536;
  for (std::size_t begin = 0; begin < text.size(); begin += kBlock) {
    poll_interruption();
    const std::string_view block = text.substr(begin, kBlock);
    const std::size_t first_a = block.find(a);
    if (const std::size_t found = std::min(first_a, block.substr(0, first_a).find(b)); found != std::string_view::npos)
      return begin + found;
  }
  return std::string_view::npos;
}

std::string with_replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  return std::string(trimmed(line));
}

std::size_t line_number(std::string_view bytes, std::size_t offset) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < offset; ++i)
    if (bytes[i] == '\n' || (bytes[i] == '\r' && !(i + 1 < bytes.size() && bytes[i + 1] == '\n'))) ++line;
  return line;
}

}  // namespace algebra3d
