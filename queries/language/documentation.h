#pragma once

#include <string>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"

namespace queries {

/// The text of `help OPERATOR`: syntax, meaning, signatures, exactness, examples with their results, errors, sources.
std::string help_text(const algebra3d::Operator& op, const algebra3d::Registry& registry);
/// One line per operator: its syntax and result.
std::string help_overview(const std::vector<const algebra3d::Operator*>& operators);
/// One line per family: its name and description.
std::string family_overview(const algebra3d::Registry& registry);
/// docs/operators.md: the reference page of all types and operators, by family, with a table of contents.
std::string reference_page(const algebra3d::Registry& registry);

}  // namespace queries
