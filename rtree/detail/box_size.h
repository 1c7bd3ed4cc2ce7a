#pragma once

#include "rtree/detail/node.h"

namespace rtree {

inline double volume(const Box3& box) {
  return (box.max.x - box.min.x) * (box.max.y - box.min.y) * (box.max.z - box.min.z);
}

/// Half the surface of a box.
inline double surface(const Box3& box) {
  const double x = box.max.x - box.min.x, y = box.max.y - box.min.y, z = box.max.z - box.min.z;
  return x * y + y * z + z * x;
}

/// The margin of a box: the sum of its three edge lengths.
inline double margin(const Box3& box) {
  return (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
}

}  // namespace rtree
