#include "queries/server/detail/content_coding.h"

#include <algorithm>
#include <string>

#include "queries/server/detail/lower_case.h"

namespace queries {
namespace {

/// One of the codings of the header, such as `gzip;q=0.5`.
struct Coding {
  std::string_view name;
  bool is_accepted;  ///< its weight is above 0
};

Coding coding_of(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(';'));
  const std::size_t weight = text.find("q=");
  const bool is_zero =
      weight != std::string_view::npos && text.substr(weight + 2).find_first_not_of("0.") == std::string_view::npos;
  return {name, !is_zero};
}

}  // namespace

bool takes_gzip(std::string_view accept_encoding) {
  std::string text = in_lower_case(accept_encoding);
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  bool takes_others = false;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto [name, is_accepted] = coding_of(std::string_view(text).substr(begin, end - begin));
    if (name == "gzip" || name == "x-gzip") return is_accepted;
    if (name == "*") takes_others = is_accepted;
    begin = end + 1;
  }
  return takes_others;
}

}  // namespace queries
