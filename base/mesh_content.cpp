#include "base/mesh_content.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/ascii_cursor.h"
#include "base/text.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::is_blank;

namespace {

// Enough to hold, in a binary STL file, several facets with their zero bytes.
constexpr std::size_t kTextSampleBytes = 1024;

// Programs that write while they do not know the count yet leave 0 or the largest number; these say nothing.
bool is_placeholder(std::uint64_t count) {
  return count == 0 || count == std::numeric_limits<std::uint32_t>::max() ||
         count == std::numeric_limits<std::int32_t>::max();
}

}  // namespace

std::string WrongCount::text() const {
  if (missing_ends > 0)
    return fmt::format("missing endsolid{}: the file may be cut short",
                       missing_ends == 1 ? "" : fmt::format(" in {} solids", missing_ends));
  if (trailing_bytes > 0)
    return fmt::format("wrong count: header announces {}, after which {}", algebra3d::counted(announced, "triangle"),
                       trailing_bytes == 1 ? "1 byte follows" : fmt::format("{} bytes follow", trailing_bytes));
  return fmt::format("wrong count: header announces {}, file has {}{}{}", algebra3d::counted(announced, "triangle"),
                     read == by_size ? "" : "room for ", by_size,
                     announced > by_size && !is_placeholder(announced) ? ", and may be cut short" : "");
}

bool begins_as_text(std::string_view bytes) {
  const std::string_view sample = bytes.substr(0, kTextSampleBytes);
  return std::ranges::none_of(sample, [](char c) { return static_cast<unsigned char>(c) < ' ' && !is_blank(c); });
}

std::string_view first_word(std::string_view bytes) {
  AsciiCursor cursor(bytes.data(), bytes.data() + bytes.size());
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.move_to(bytes.data() + 3);
  cursor.skip_space();
  const char* const begin = cursor.position();
  cursor.skip_word();
  return {begin, static_cast<std::size_t>(cursor.position() - begin)};
}

}  // namespace mesh_formats
