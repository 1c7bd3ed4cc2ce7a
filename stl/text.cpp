#include "stl/text.h"

#include <iterator>

#include <fmt/format.h>

namespace stl {

namespace {

constexpr std::size_t kLongestFound = 24;

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
  return found + "'";
}

std::string bad_normals_remark(std::size_t count) {
  return fmt::format("{} a normal that is not finite, read as zero",
                     count == 1 ? "1 facet has" : fmt::format("{} facets have", count));
}

algebra3d::Error interrupted(std::string_view file_name) {
  return {algebra3d::ErrorCode::interrupted, "read_stl: {}: interrupted", file_name};
}

}  // namespace stl
