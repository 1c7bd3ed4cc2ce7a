#include "algebra3d/values/types/utf8.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace algebra3d {

namespace {

// The meaning of a first byte: the length of its sequence and the range of the second byte, which is where overlong
// forms (E0, F0), surrogates (ED) and values beyond U+10FFFF (F4) are shut out. Length 0: no first byte.
struct Lead {
  std::size_t length = 0;
  unsigned char second_min = 0x80;
  unsigned char second_max = 0xBF;
};

Lead lead_of(unsigned char byte) {
  if (byte < 0x80) return {1};
  if (byte < 0xC2) return {0};
  if (byte < 0xE0) return {2};
  if (byte == 0xE0) return {3, 0xA0};
  if (byte == 0xED) return {3, 0x80, 0x9F};
  if (byte < 0xF0) return {3};
  if (byte == 0xF0) return {4, 0x90};
  if (byte < 0xF4) return {4};
  if (byte == 0xF4) return {4, 0x80, 0x8F};
  return {0};
}

// Length of the well-formed sequence at the start of `text`, which is not empty; 0 if there is none.
std::size_t sequence_length(std::string_view text) {
  const auto lead = lead_of(static_cast<unsigned char>(text[0]));
  if (lead.length > text.size()) return 0;
  if (lead.length < 2) return lead.length;
  const auto second = static_cast<unsigned char>(text[1]);
  if (second < lead.second_min || second > lead.second_max) return 0;
  for (std::size_t i = 2; i < lead.length; ++i) {
    if (!is_utf8_continuation(text[i])) return 0;
  }
  return lead.length;
}

bool is_ascii_block(const char* bytes) {
  std::uint64_t block = 0;
  std::memcpy(&block, bytes, sizeof block);
  return (block & 0x8080808080808080U) == 0;
}

}  // namespace

std::size_t first_invalid_utf8(std::string_view text) {
  std::size_t position = 0;
  while (position < text.size()) {
    if (text.size() - position >= sizeof(std::uint64_t) && is_ascii_block(text.data() + position)) {
      position += sizeof(std::uint64_t);
      continue;
    }
    const auto length = sequence_length(text.substr(position));
    if (length == 0) return position;
    position += length;
  }
  return std::string_view::npos;
}

std::size_t first_no_text(std::string_view text) {
  return std::min(first_invalid_utf8(text), text.find('\0'));
}

std::string no_text_message(char byte) {
  if (byte == '\0') return "expected text, found a zero byte";
  return fmt::format("expected UTF-8, found the byte 0x{:02x}", static_cast<unsigned char>(byte));
}

std::string shown_as_text(std::string_view bytes) {
  std::string text;
  while (true) {
    const std::size_t wrong = first_no_text(bytes);
    text += bytes.substr(0, wrong);
    if (wrong == std::string_view::npos) return text;
    text += fmt::format("\\x{:02x}", static_cast<unsigned char>(bytes[wrong]));
    bytes.remove_prefix(wrong + 1);
  }
}

SourcePlace place_behind(std::string_view text, SourcePlace start) {
  const auto line_begin = text.rfind('\n') + 1;  // 0 if there is none
  const auto line = text.substr(line_begin);
  start.line += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  if (line_begin != 0) start.column = 1;
  start.column +=
      static_cast<int>(std::count_if(line.begin(), line.end(), [](char byte) { return !is_utf8_continuation(byte); }));
  return start;
}

std::string_view utf8_prefix(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  while (limit > 0 && is_utf8_continuation(text[limit])) --limit;
  return text.substr(0, limit);
}

}  // namespace algebra3d
