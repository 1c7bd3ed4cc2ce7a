#pragma once

#include "queries/language/rewriting.h"

namespace queries {

/// A filter on tuples: asks conditions on attributes that an operator below it hands on before that operator [predicate
/// pushdown], so that this has less to do, and an index can answer them. The first conditions go down as far as they
/// can; of the others those that cannot note anything, since they are asked of other tuples then.
Status move_conditions_down(const algebra3d::Operator& op, BoundOperator& bound, std::vector<TypedPtr>& arguments,
                            const RewriteContext& rewriting);

}  // namespace queries
