#include "queries/server/detail/download_name.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "queries/server/detail/percent_coding.h"

namespace queries {
namespace {

constexpr std::size_t kLongestDownloadName = 120;

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

}  // namespace

std::string safe_file_name(std::string_view name) {
  static constexpr std::string_view kForbidden = "/\\:*?\"<>|";
  std::string result = algebra3d::shown_as_text(name);
  std::ranges::replace_if(
      result,
      [](char c) {
        return (is_ascii(c) && std::iscntrl(static_cast<unsigned char>(c)) != 0) ||
               kForbidden.find(c) != std::string_view::npos;
      },
      '_');
  result = algebra3d::utf8_prefix(result, kLongestDownloadName);
  const std::size_t begin = result.find_first_not_of(". ");
  if (begin == std::string::npos) return {};
  return result.substr(begin, result.find_last_not_of(". ") + 1 - begin);
}

std::string attachment(std::string_view file_name) {
  std::string plain;
  for (const char c : file_name)
    if (!algebra3d::is_utf8_continuation(c)) plain += is_ascii(c) && c != '%' && c != '"' && c != '\\' ? c : '_';
  const std::string header = fmt::format("attachment; filename=\"{}\"", plain);
  return plain == file_name ? header : fmt::format("{}; filename*=UTF-8''{}", header, percent_encoded(file_name));
}

}  // namespace queries
