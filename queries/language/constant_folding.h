#pragma once

#include "queries/language/typed_tree.h"

namespace queries {

/// The call of a pure operator on constants as a constant [constant folding], if all of them are numbers, truth values
/// or strings, and the result is defined without notes; else the call.
TypedPtr folded(TypedPtr call, Context& context);

}  // namespace queries
