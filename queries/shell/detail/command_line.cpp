#include "queries/shell/detail/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

namespace queries {
namespace {

// "NAME:{auto,list}" and "N:INT in [1 - 256]": the placeholder stands before the colon, checks behind it.
std::string placeholder(const std::string& type_name) {
  const std::string name = type_name.substr(0, type_name.find(':'));
  return name.empty() ? "VALUE" : name;
}

std::vector<std::string> choices_of(const std::string& type_name) {
  const std::size_t begin = type_name.find(":{");
  const std::size_t end = type_name.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type_name.substr(begin + 2, end - begin - 2), ',');
}

CommandLineArgument argument_of(const CLI::Option& option) {
  CommandLineArgument argument;
  argument.meaning = option.get_description();
  argument.is_required = option.get_required();
  argument.is_repeated = option.get_expected_max() > 1;
  argument.is_positional = option.get_positional();
  if (argument.is_positional) {
    argument.names = {option.get_name(true)};
    return argument;
  }
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_items_expected_max() == 0) return argument;
  argument.value = placeholder(option.get_type_name());
  argument.choices = choices_of(option.get_type_name());
  return argument;
}

// A group of options is a subcommand without a name. It has an option for help of its own, which nobody sees.
void add_arguments(const CLI::App& app, std::vector<CommandLineArgument>& arguments) {
  for (const CLI::Option* option : app.get_options())
    if (!app.get_name().empty() || app.get_parent() == nullptr || option != app.get_help_ptr())
      arguments.push_back(argument_of(*option));
  for (const CLI::App* part : app.get_subcommands({}))
    if (part->get_name().empty()) add_arguments(*part, arguments);  // NOLINT(misc-no-recursion): one level
}

}  // namespace

CommandLine command_line_of(const CLI::App& app) {  // NOLINT(misc-no-recursion): one level
  CommandLine line{app.get_name(), app.get_description(), {}, app.get_footer(), {}};
  add_arguments(app, line.arguments);
  std::stable_partition(line.arguments.begin(), line.arguments.end(),
                        [](const CommandLineArgument& argument) { return argument.is_positional; });
  for (const CLI::App* part : app.get_subcommands({})) {
    if (part->get_name().empty()) continue;
    line.subcommands.push_back(command_line_of(*part));
    // A subcommand that has no remarks of its own has those of the program.
    if (line.subcommands.back().remarks == line.remarks) line.subcommands.back().remarks.clear();
  }
  return line;
}

std::string_view completed_as(const CommandLineArgument& argument) {
  constexpr auto kFiles = std::to_array<std::string_view>({"FILE", "FILES", "PATH", "OUT"});
  const std::string& name = argument.is_positional ? argument.names.front() : argument.value;
  if (name == "DIR") return "folder";
  return std::ranges::find(kFiles, name) != kFiles.end() ? "file" : "";
}

}  // namespace queries
