#pragma once

#include <span>
#include <string>
#include <string_view>

#include "algebra3d/registry/registry.h"

namespace queries {

/// A command as `help` shows it and as it is completed: words in capital letters stand for what the user writes there.
struct CommandDescription {
  std::string_view syntax;
  std::string_view meaning;
};

/// The commands of language.md 3.1 and 1.2 and ours.
std::span<const CommandDescription> command_table();
/// What `help` shows: commands, what the prompt can do, and operators, each in one line.
std::string shell_help(const algebra3d::Registry& registry);
/// What there is to say of an operator or command of exactly that name; empty if there is none.
std::string exact_help(const std::string& name, const algebra3d::Registry& registry);
/// What `help NAME` shows: an operator, a command, the operators of a family, or else whatever has NAME as a part of
/// its name or in its description. Errors: unknown_name with the operator whose name is nearest.
algebra3d::Result<std::string> shell_help(const std::string& name, const algebra3d::Registry& registry);

}  // namespace queries
