#pragma once

#include <span>
#include <string_view>

namespace queries {

/// A command for help and completion: words in capital letters are placeholders.
struct CommandDescription {
  std::string_view syntax;
  std::string_view meaning;
};

/// All commands, those of the shell at the end (docs/language.md, "What there is").
std::span<const CommandDescription> command_list();
/// The commands of the language, which every host has: all but those of the shell.
std::span<const CommandDescription> language_commands();

}  // namespace queries
