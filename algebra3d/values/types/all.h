#pragma once

#include <vector>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// All types, in the order of the documentation.
std::vector<const Type*> all_types();

}  // namespace algebra3d
