#pragma once

#include <cstddef>

#include "algebra3d/values/display/shape.h"

namespace algebra3d {

/// Shapes with fewer triangles are searched as fast without a tree.
inline constexpr std::size_t kLeastTrianglesOfTree = 1000;

/// Builds the bounding volume hierarchy of the triangles of a shape, unless these are fewer than kLeastTrianglesOfTree.
/// Triangles that are not in spatial order are brought into it, and `face_ids` holds their numbers (not in a coarser
/// level, whose triangles have none).
///
/// The nodes have 32 bytes each, in the memory layout of three-mesh-bvh 0.9 (`version: 1` of its serialized form): six
/// floats, the smallest and the largest corner of a box that is slightly larger than the triangles in it. Then of a
/// leaf (16 bits each the last two): the first triangle (32 bits), the number of triangles, 0xffff; of an inner node
/// (32 bits each): the distance to its right child in nodes, and the axis along which its children lie beside each
/// other; its left child comes next. The root is the first node. Leaves have at most 16 triangles, in order; all are at
/// about the same depth, the logarithm of their number.
///
/// Cost: linear, in parallel; n log n for triangles that are out of order. Source: [lauterbach2009].
void add_tree(DrawnShape& shape);

}  // namespace algebra3d
