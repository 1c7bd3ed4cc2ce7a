#pragma once

#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"

namespace algebra3d {

/// What `help OPERATOR` shows: syntax, meaning, signatures, exactness, examples with their results, errors, sources.
std::string help_text(const Operator& op);
/// One line for each of the given operators.
std::string help_overview(const std::vector<const Operator*>& operators);
/// The text of `help`: every operator in one line, family by family.
std::string help_overview(const Registry& registry);
/// The operators of a family, by name.
std::vector<const Operator*> operators_of_family(const Registry& registry, const std::string& family);
/// docs/operators.md: the reference page of all types and operators.
std::string reference_page(const Registry& registry);

}  // namespace algebra3d
