#include "algebra3d/repair/repair_options.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "algebra3d/base/number_text.h"

namespace algebra3d {
namespace {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

Result<double> parse_amount(std::string_view name, std::string_view text) {
  const std::optional<double> number = parse_real(text);
  if (!number || !std::isfinite(*number) || *number < 0)
    return Error{ErrorCode::invalid_value,
                 "option '{}' is '{}'; expected a number from 0 on within the range of doubles", name, text};
  return *number;
}

Status set_option(RepairOptions& options, std::string_view name, std::string_view value) {
  if (name == "cavities") {
    if (value != "keep" && value != "drop")
      return Error{ErrorCode::invalid_value, "option 'cavities' is '{}'; expected 'keep' or 'drop'", value};
    options.keeps_cavities = value == "keep";
    return {};
  }
  if (name == "strict") {
    if (!value.empty()) return Error{ErrorCode::invalid_value, "option 'strict' is '{}'; it takes no value", value};
    options.is_strict = true;
    return {};
  }
  if (name != "cracks" && name != "holes" && name != "smallest" && name != "work")
    return Error{ErrorCode::invalid_value,
                 "there is no option '{}'; expected cracks, holes, cavities, smallest, work or strict", name};
  ASSIGN_OR_RETURN(const double amount, parse_amount(name, value));
  if (name == "cracks") options.crack_tolerance = amount;
  if (name == "holes") options.largest_hole = amount;
  if (name == "smallest") options.smallest_shell = amount;
  if (name == "work") options.work_limit = amount;
  return {};
}

}  // namespace

Result<RepairOptions> parse_repair_options(std::string_view text) {
  RepairOptions options;
  std::set<std::string_view> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string_view part = without_blanks(text.substr(begin, end - begin));
    begin = end + 1;
    if (part.empty()) continue;
    const std::size_t sign = std::min(part.find('='), part.size());
    const std::string_view name = without_blanks(part.substr(0, sign));
    if (!names.insert(name).second) return Error{ErrorCode::invalid_value, "option '{}' is given twice", name};
    RETURN_IF_ERROR(
        set_option(options, name, sign < part.size() ? without_blanks(part.substr(sign + 1)) : std::string_view()));
  }
  return options;
}

}  // namespace algebra3d
