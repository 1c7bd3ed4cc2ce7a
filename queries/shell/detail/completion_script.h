#pragma once

#include <string>

#include "algebra3d/operators/registry/registry.h"
#include "queries/shell/detail/command_line.h"

namespace queries {

/// Scripts for the completion of the program's command line in a shell: subcommands, options, their values, file names,
/// and after `help` the operators and commands.
std::string bash_completion(const CommandLine& program, const algebra3d::Registry& registry);
std::string zsh_completion(const CommandLine& program, const algebra3d::Registry& registry);

}  // namespace queries
