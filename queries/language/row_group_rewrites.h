#pragma once

#include "queries/language/rewriting.h"

namespace queries {

/// `R feed filter[...]`: leaves out row groups whose least and greatest values tell that no tuple passes [zone maps].
void leave_out_groups(const BoundOperator& bound, std::vector<TypedPtr>& arguments);

}  // namespace queries
