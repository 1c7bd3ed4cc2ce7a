#include "queries/session/variables.h"

#include <cstdlib>
#include <set>

namespace queries {
namespace {

/// Calls `plain(text)` and `variable(name)` for the parts of a text, in order.
template <typename Plain, typename Variable>
void for_each_part(std::string_view text, Plain plain, Variable variable) {
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t begin = text.find("$(", position);
    const std::size_t end = begin == std::string_view::npos ? begin : text.find(')', begin);
    if (end == std::string_view::npos) return plain(text.substr(position));
    plain(text.substr(position, begin - position));
    variable(std::string(text.substr(begin + 2, end - begin - 2)));
    position = end + 1;
  }
}

}  // namespace

std::string with_variables(std::string_view text) {
  std::string result;
  for_each_part(
      text, [&](std::string_view part) { result += part; },
      [&](const std::string& name) {
        if (const char* value = std::getenv(name.c_str())) result += value;  // NOLINT(concurrency-mt-unsafe)
      });
  return result;
}

std::vector<std::string> variables_in(std::string_view text) {
  std::set<std::string> names;
  for_each_part(
      text, [](std::string_view) {}, [&](const std::string& name) { names.insert(name); });
  return {names.begin(), names.end()};
}

}  // namespace queries
