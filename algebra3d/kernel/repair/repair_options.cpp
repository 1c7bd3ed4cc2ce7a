#include "algebra3d/kernel/repair/repair_options.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "base/number_text.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// An option as it was written; it has no value if there is no `=`.
struct WrittenOption {
  std::string_view name;
  std::optional<std::string_view> value;
};

WrittenOption option_in(std::string_view part) {
  const std::size_t sign = part.find('=');
  if (sign == std::string_view::npos) return {part, std::nullopt};
  return {without_blanks(part.substr(0, sign)), without_blanks(part.substr(sign + 1))};
}

Error wrong_value(const WrittenOption& option, std::string_view expected) {
  if (!option.value || option.value->empty())
    return {ErrorCode::invalid_value, "option '{}' has no value; expected {}", option.name, expected};
  return {ErrorCode::invalid_value, "option '{}' is '{}'; expected {}", option.name, *option.value, expected};
}

/// The name of an option; `cracks` is what `gaps` was called before.
std::string_view current_name(std::string_view name) {
  return name == "cracks" ? "gaps" : name;
}

Result<double> parse_amount(const WrittenOption& option) {
  const std::optional<double> number = option.value ? parse_real(*option.value) : std::nullopt;
  if (!number || *number < 0) return wrong_value(option, "a number of at least 0 without a unit");
  return *number;
}

/// Null if no option of this name has an amount.
double* amount_option(RepairOptions& options, std::string_view name) {
  if (name == "gaps") return &options.gap_tolerance.emplace();
  if (name == "holes") return &options.largest_hole.emplace();
  if (name == "smallest") return &options.smallest_shell;
  if (name == "added") return &options.most_added.emplace();
  if (name == "work") return &options.work_limit;
  return nullptr;
}

Status set_cavities(RepairOptions& options, const WrittenOption& option) {
  if (option.value != "keep" && option.value != "drop") return wrong_value(option, "'keep' or 'drop'");
  options.keeps_cavities = option.value == "keep";
  return {};
}

Status set_strict(RepairOptions& options, const WrittenOption& option) {
  if (option.value)
    return Error{ErrorCode::invalid_value, "option 'strict' takes no value, not even an empty one; found 'strict={}'",
                 *option.value};
  options.is_strict = true;
  return {};
}

Result<double> parse_dropped(const WrittenOption& option) {
  const std::optional<double> part = option.value ? parse_real(*option.value) : std::nullopt;
  if (!part || !(*part >= 0 && *part <= 1))
    return wrong_value(option, "a number from 0 to 1, the part of the area seen");
  return *part;
}

Status set_option(RepairOptions& options, const WrittenOption& option) {
  const std::string_view name = current_name(option.name);
  if (name == "cavities") return set_cavities(options, option);
  if (name == "strict") return set_strict(options, option);
  if (name == "dropped") {
    A3D_ASSIGN(options.most_dropped, parse_dropped(option));
    return {};
  }
  RepairOptions changed = options;
  double* amount = amount_option(changed, name);
  if (amount == nullptr)
    return Error{ErrorCode::invalid_value,
                 "there is no option '{}'; expected gaps, holes, cavities, smallest, dropped, added, work or strict",
                 name};
  A3D_ASSIGN(*amount, parse_amount(option));
  options = changed;
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
    const WrittenOption option = option_in(part);
    if (!names.insert(current_name(option.name)).second)
      return Error{ErrorCode::invalid_value, "option '{}' is given twice", option.name};
    A3D_TRY(set_option(options, option));
  }
  return options;
}

std::string text_of(const RepairOptions& options) {
  const RepairOptions defaults;
  std::string text;
  const auto add = [&](std::string_view option) { (text += text.empty() ? "" : ";") += option; };
  const auto add_amount = [&](std::string_view name, double amount) {
    add(std::string(name) + "=" + real_text(amount + 0.0));  // -0 is 0
  };
  if (options.gap_tolerance) add_amount("cracks", *options.gap_tolerance);
  if (options.largest_hole) add_amount("holes", *options.largest_hole);
  if (!options.keeps_cavities) add("cavities=drop");
  if (options.smallest_shell != defaults.smallest_shell) add_amount("smallest", options.smallest_shell);
  if (options.most_dropped != defaults.most_dropped) add_amount("dropped", options.most_dropped);
  if (options.most_added) add_amount("added", *options.most_added);
  if (options.work_limit != defaults.work_limit) add_amount("work", options.work_limit);
  if (options.is_strict) add("strict");
  return text;
}

}  // namespace algebra3d
