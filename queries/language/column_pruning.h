#pragma once

#include <vector>

#include "queries/language/rewriting.h"

namespace queries {

/// The attributes of its tuple, by their places, that a function reads; the tuple has `count`.
std::vector<bool> attributes_read(const TypedNode& function, std::size_t count);

/// Tells an operator that changes tuples of a relation that they are of it, if the plan says so: then they are not
/// compared with it, and scans below may read only what its functions, and operators above, need.
void take_own_tuples(BoundOperator& bound, std::vector<TypedPtr>& arguments);

/// Lets the scans below an operator read only the attributes that it needs, as far down as operators have roles.
void read_needed_attributes(BoundOperator& bound, std::vector<TypedPtr>& arguments);

}  // namespace queries
