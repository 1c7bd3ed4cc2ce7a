#pragma once

#include <array>

#include "algebra3d/base/box3.h"
#include "base/indices.h"

namespace algebra3d {

/// Corner i of a box, 0 to 7: bits 0, 1 and 2 of i select the maximum of x, y and z.
inline Vec3 corner_of(const Box3& box, unsigned i) {
  return {((i & 1U) != 0 ? box.max : box.min).x, ((i & 2U) != 0 ? box.max : box.min).y,
          ((i & 4U) != 0 ? box.max : box.min).z};
}

/// The sides of a box as triangles of its corners, counter-clockwise from outside.
inline constexpr std::array<IndexTriangle, 12> kBoxTriangles{{{0, 2, 3},
                                                              {0, 3, 1},
                                                              {4, 5, 7},
                                                              {4, 7, 6},
                                                              {0, 1, 5},
                                                              {0, 5, 4},
                                                              {2, 6, 7},
                                                              {2, 7, 3},
                                                              {0, 4, 6},
                                                              {0, 6, 2},
                                                              {1, 3, 7},
                                                              {1, 7, 5}}};

}  // namespace algebra3d
