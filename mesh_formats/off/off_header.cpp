#include "mesh_formats/off/off_header.h"

#include "base/ascii_cursor.h"
#include "base/text.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::is_blank;
using algebra3d::trimmed;

namespace {

// Takes `flag` off the front of `text`, unless it was there before.
bool take_flag(std::string_view& text, std::string_view flag, bool& is_set) {
  if (is_set || !text.starts_with(flag)) return false;
  text.remove_prefix(flag.size());
  return is_set = true;
}

bool ends_off_keyword(std::string_view rest) {
  return rest.empty() || is_blank(rest.front()) || rest.front() == '#' || (rest.front() >= '0' && rest.front() <= '9');
}

// Behind `OFF`: goes behind ` BINARY` and the end of the line. Binary numbers may begin with a byte that looks like a
// line feed, so exactly one line end is passed, and CR alone is not a line end.
bool take_binary_line(std::string_view& rest) {
  std::string_view line = rest.substr(0, rest.find('\n'));
  if (line.size() == rest.size() || trimmed(line) != "BINARY") return false;
  rest.remove_prefix(line.size() + 1);
  return true;
}

}  // namespace

std::optional<OffHeader> off_header(std::string_view bytes) {
  AsciiCursor cursor(bytes.data(), bytes.data() + bytes.size());
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.move_to(bytes.data() + 3);
  cursor.skip_space();
  std::string_view rest = cursor.rest();
  OffHeader header;
  while (take_flag(rest, "ST", header.has_texture_coordinates) || take_flag(rest, "C", header.has_colours) ||
         take_flag(rest, "N", header.has_normals) || take_flag(rest, "4", header.has_weights) ||
         take_flag(rest, "n", header.has_dimension)) {
  }
  const bool has_keyword = rest.starts_with("OFF") || rest.starts_with("off");
  if (!has_keyword || !ends_off_keyword(rest.substr(3))) return std::nullopt;
  rest.remove_prefix(3);
  header.is_binary = take_binary_line(rest);
  header.bytes = bytes.size() - rest.size();
  return header;
}

}  // namespace mesh_formats
