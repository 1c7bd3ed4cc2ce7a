#pragma once

#include "rtree/detail/node.h"

namespace rtree {

inline double volume(const Box3& box) {
  return (box.max.x - box.min.x) * (box.max.y - box.min.y) * (box.max.z - box.min.z);
}

/// The margin of a box: the sum of its three edge lengths.
inline double margin(const Box3& box) {
  return (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
}

}  // namespace rtree
