#pragma once

#include <string>

#include "algebra3d/registry/registry.h"

namespace algebra3d {

/// What `help OPERATOR` shows: syntax, meaning, signatures, exactness, examples with their results, errors, sources.
std::string help_text(const Operator& op);
/// What `help` shows: every operator in one line.
std::string help_overview(const Registry& registry);
/// docs/operators.md: the reference page of all types and operators.
std::string reference_page(const Registry& registry);

}  // namespace algebra3d
