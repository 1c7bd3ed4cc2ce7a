#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/kernel/validity/report.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// The findings in a triangle soup, before any repair. (The changes of a repair are in RepairReport; docs/import.md,
/// "The report".)
struct SoupReport {
  /// The defects after welding. The faces in its examples are triangles of the soup, numbered from 0.
  ValidityReport validity;
  double size = 0;  ///< diagonal of the box around the triangles
  /// Triangles whose given normal contradicts the order of their corners; zero normals are ignored.
  std::uint64_t contradicting_normal_count = 0;
  std::optional<std::size_t> first_contradicting_triangle;  ///< numbered from 0
  /// The soup was a solid turned inside out, and every triangle was flipped.
  bool was_flipped = false;

  /// Counts the given normals that contradict the order of corners. Cost: linear.
  void count_contradicting_normals(const TriangleSoup& soup);

  /// For people, one line, triangles numbered from 1: "no valid solid: 12 boundary edges (triangle 17, near (0 0.5 1)),
  /// 3 intersecting pairs (triangles 4 and 9, near (2 0 0))". Empty if the soup gave a solid.
  std::string defects() const;
  /// For people: remarks that changed no decision, one sentence each.
  std::vector<std::string> remarks() const;
};

}  // namespace algebra3d
