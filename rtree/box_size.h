#pragma once

#include "rtree/node.h"

namespace rtree {

inline double volume(const Box3& box) {
  return (box.max.x - box.min.x) * (box.max.y - box.min.y) * (box.max.z - box.min.z);
}

/// Sum of the edge lengths, a quarter of what all twelve edges measure.
inline double margin(const Box3& box) {
  return (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
}

}  // namespace rtree
