#pragma once

#include "queries/language/rewriting.h"

namespace queries {

/// `R feed S feed product filter[...]` and `R feed S feed symmjoin[...]`: finds pairs with equal attributes by a hash
/// table, if the condition wants some to be equal.
void pair_by_hash(BoundOperator& bound, std::vector<TypedPtr>& arguments);

/// `sortby[K] groupby[K; ...]` and `sort rdup`: finds the groups by a hash table, and sorts these.
void group_by_hash(BoundOperator& bound, std::vector<TypedPtr>& arguments);

}  // namespace queries
