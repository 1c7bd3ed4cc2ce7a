#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"

namespace algebra3d {

/// The relation of two boxes, axis by axis.
void relate_boxes(const Box3& first, const Box3& second, Findings& findings);

}  // namespace algebra3d
