#pragma once

#include <span>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"

namespace queries {

/// The text of `help`: commands, functions of the prompt, and operators, each in one line.
std::string shell_help(const algebra3d::Registry& registry);
/// The help for an operator or command of exactly this name; empty if there is none.
std::string exact_help(const std::string& name, const algebra3d::Registry& registry);
/// The text of `help NAME`: an operator, a command, the operators of a family, tables, or else everything with NAME in
/// its name or description. Errors: unknown_name with the operator of the most similar name.
algebra3d::Result<std::string> shell_help(const std::string& name, const algebra3d::Registry& registry);

}  // namespace queries
