#pragma once

#include "queries/language/rewriting.h"

namespace queries {

/// Lets the scans below an operator read only the attributes that it needs, as far down as operators have roles.
void read_needed_attributes(BoundOperator& bound, std::vector<TypedPtr>& arguments);

}  // namespace queries
