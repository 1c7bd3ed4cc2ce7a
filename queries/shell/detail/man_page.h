#pragma once

#include <string>

#include "algebra3d/operators/registry/registry.h"
#include "queries/shell/detail/command_line.h"

namespace queries {

/// The manual page of the program, as roff: its command line, the commands of the language, and the operators by
/// family.
std::string man_page(const CommandLine& program, const algebra3d::Registry& registry);

}  // namespace queries
