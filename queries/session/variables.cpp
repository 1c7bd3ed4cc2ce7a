#include "queries/session/variables.h"

#include <cstdlib>

namespace queries {

std::string with_variables(std::string_view text) {
  std::string result;
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t begin = text.find("$(", position);
    const std::size_t end = begin == std::string_view::npos ? begin : text.find(')', begin);
    result += text.substr(position, end == std::string_view::npos ? end : begin - position);
    if (end == std::string_view::npos) break;
    const std::string name(text.substr(begin + 2, end - begin - 2));
    if (const char* value = std::getenv(name.c_str())) result += value;  // NOLINT(concurrency-mt-unsafe)
    position = end + 1;
  }
  return result;
}

}  // namespace queries
