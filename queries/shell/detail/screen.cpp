#include "queries/shell/detail/screen.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/text.h"

namespace queries {

ScreenSize screen_size() {
  winsize size{};
  ScreenSize result;
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return result;
  if (size.ws_col > 0) result.columns = size.ws_col;
  if (size.ws_row > 0) result.rows = size.ws_row;
  return result;
}

std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return !algebra3d::is_utf8_continuation(c); }));
}

// In UTF-8 the control characters from U+0080 to U+009F are the byte C2 and one from 80 to 9F.
std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if ((byte < ' ' && byte != '\n' && byte != '\t') || byte == 0x7F)
      result += fmt::format("\\x{:02x}", byte);
    else if (byte == 0xC2 && next >= 0x80 && next <= 0x9F)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
    else
      result += text[i];
  }
  return result;
}

std::string printable_line(std::string_view text) {
  const std::string line = algebra3d::with_replaced(algebra3d::shown_as_text(text), "\n", "\\x0a");
  return printable(algebra3d::with_replaced(line, "\t", "\\x09"));
}

std::string shell_word(std::string_view name) {
  constexpr std::string_view kPlain = "_-./+,:@%=";
  const auto is_plain = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80 ||
           kPlain.find(c) != std::string_view::npos;
  };
  // A name that begins with a hyphen would be an option.
  const std::string path = (name.starts_with('-') ? "./" : "") + std::string(name);
  if (!path.empty() && std::ranges::all_of(path, is_plain)) return path;
  return "'" + algebra3d::with_replaced(path, "'", "'\\''") + "'";
}

}  // namespace queries
