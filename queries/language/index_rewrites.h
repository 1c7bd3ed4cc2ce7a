#pragma once

#include "queries/language/rewriting.h"

namespace queries {

/// `R feed filter[...]`: reads the relation by an index that the condition allows.
Status read_by_index(const BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting);

}  // namespace queries
