#include "algebra3d/kernel/repair/detail/stitching.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/kernel/repair/detail/edge_splits.h"
#include "algebra3d/kernel/repair/detail/split_selection.h"
#include "algebra3d/kernel/repair/detail/vertex_merging.h"

namespace algebra3d {
namespace {

/// True if the vertex is near the inside of an edge, and not near its ends.
bool is_near_inside(const Vec3& from, const Vec3& p, const Vec3& to, double tolerance) {
  const Vec3 along = to - from;
  const double parameter = dot(p - from, along) / dot(along, along);
  if (!(parameter > 0 && parameter < 1)) return false;
  const double reach = std::min(tolerance, std::sqrt(dot(along, along)) / 3);
  return length(p - (from + parameter * along)) <= reach && std::min(length(p - from), length(p - to)) > reach;
}

}  // namespace

void split_t_junctions(IndexedSoup& soup, RepairReport& report) {
  while (!split_edges(soup, find_splits(soup, 0, is_exactly_on), report)) {
  }
}

void merge_rounded_corners(IndexedSoup& soup, double noise, RepairReport& report) {
  if (noise > 0) merge_boundary_vertices(soup, noise, report);
}

void stitch_gaps(IndexedSoup& soup, double tolerance, RepairReport& report) {
  merge_boundary_vertices(soup, tolerance, report);
  const auto lies_on = [&](const Vec3& from, const Vec3& p, const Vec3& to) {
    return is_near_inside(from, p, to, tolerance);
  };
  split_edges(soup, splits_that_stitch(soup, find_splits(soup, tolerance, lies_on)), report);
}

}  // namespace algebra3d
