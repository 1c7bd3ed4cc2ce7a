#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace queries {

/// An option or a positional argument of the program or of one of its subcommands.
struct CommandLineArgument {
  std::vector<std::string> names = {};    ///< "-p", "--param"; for a positional argument its placeholder, "FILE"
  std::string value = {};                 ///< placeholder of an option's value, "NAME=VALUE"; empty for a flag
  std::vector<std::string> choices = {};  ///< all possible values; empty if any value is possible
  std::string meaning = {};
  bool is_positional = false;
  bool is_required = false;
  bool is_repeated = false;
};

/// The program or a subcommand.
struct CommandLine {
  std::string name = {};
  std::string meaning = {};
  std::vector<CommandLineArgument> arguments = {};
  std::string remarks = {};  ///< text below the options
  std::vector<CommandLine> subcommands = {};
};

/// Describes the command line by its parser, for the man page and the completion.
CommandLine command_line_of(const CLI::App& app);

/// The kind of path that a value is, by its placeholder: `file`, `folder` or empty.
std::string_view completed_as(const CommandLineArgument& argument);

}  // namespace queries
