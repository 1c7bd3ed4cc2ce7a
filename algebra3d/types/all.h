#pragma once

#include <vector>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// Every type of this library, in the order in which people read about them.
std::vector<const Type*> all_types();

}  // namespace algebra3d
