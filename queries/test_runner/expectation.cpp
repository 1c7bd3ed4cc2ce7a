#include "queries/test_runner/expectation.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace queries {
namespace {

using algebra3d::NestedList;

std::string difference(const std::string& path, const NestedList& expected, const NestedList& found) {
  return fmt::format("{}expected {}, found {}", path.empty() ? "" : "at " + path + ": ", expected.print_short(200),
                     found.print_short(200));
}

// Depth is that of the expected list, which the parser limits.
std::string compare_at(const std::string& path, const NestedList& expected, const NestedList& found,
                       Tolerance tolerance) {
  if (expected.is_real() && found.is_real())
    return tolerance.accepts(expected.as_real(), found.as_real()) ? "" : difference(path, expected, found);
  if (!expected.is_list() || !found.is_list()) return expected == found ? "" : difference(path, expected, found);
  const auto& wanted = expected.elements();
  const auto& given = found.elements();
  for (std::size_t i = 0; i < std::min(wanted.size(), given.size()); ++i) {
    std::string result = compare_at(fmt::format("{}/{}", path, i + 1), wanted[i], given[i], tolerance);
    if (!result.empty()) return result;
  }
  if (wanted.size() == given.size()) return "";
  return fmt::format("{}expected {} elements, found {}", path.empty() ? "" : "at " + path + ": ", wanted.size(),
                     given.size());
}

}  // namespace

bool Tolerance::accepts(double expected, double found) const {
  if (expected == found) return true;
  const double difference = std::abs(expected - found);
  if (!is_relative) return difference < value;
  return value > 0 && difference < std::max(value, 1e-15) * std::abs(expected);
}

std::string first_difference(const NestedList& expected, const NestedList& found, Tolerance tolerance) {
  return compare_at("", expected, found, tolerance);
}

NestedList with_sorted_tuples(NestedList result) {
  if (!result.is_list() || result.elements().size() != 2 || !result.elements()[1].is_list()) return result;
  std::ranges::sort(result.elements()[1].elements(), {}, [](const NestedList& tuple) { return tuple.print(); });
  return result;
}

}  // namespace queries
