#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// What can be wrong with a triangle mesh that is to be a surface3d or volume3d (language.md 7.2).
enum class Defect : std::uint8_t {
  degenerate_triangle,     ///< corners repeat or are collinear
  duplicate_triangle,      ///< the same three corners as an earlier triangle, in any order
  boundary_edge,           ///< volume: an edge with one triangle only
  nonmanifold_edge,        ///< volume: the triangles along the edge cannot be paired
  inconsistent_edge,       ///< volume: the two triangles of the edge run along it in the same direction
  intersecting_triangles,  ///< the common part is neither one point nor a whole edge of both
  wrong_winding,           ///< volume: a shell whose winding number is not 0 in front of it, or not 1 behind it
};
inline constexpr std::size_t kDefectKinds = 7;

/// One defect with its place, for people.
struct DefectExample {
  Defect kind;
  FaceId first;
  FaceId second;  ///< invalid where one triangle is concerned only
  Vec3 where;     ///< a point of the place, or of the overlap of the two triangles' boxes; rounded
};

/// The outcome of a proof: nothing found, or every defect counted and the first ones named.
struct ValidityReport {
  static constexpr std::size_t kExamplesPerKind = 3;

  std::array<std::uint64_t, kDefectKinds> counts{};
  /// Ascending by kind, then by faces; of each kind the kExamplesPerKind first, whatever the order of `add`.
  std::vector<DefectExample> examples;
  /// True if counting ended before all intersecting pairs were met: the count is a lower bound then, and the examples
  /// are some of the pairs.
  bool is_cut_short = false;

  bool is_valid() const { return total() == 0; }
  std::uint64_t total() const;
  std::uint64_t count(Defect kind) const { return counts[static_cast<std::size_t>(kind)]; }
  /// Counts one defect. Each defect is added once.
  void add(const DefectExample& defect);
  /// For people, one line, triangles numbered from 0; empty if valid. For example
  /// "2 boundary edges (first at triangle 12, near (1.0 2.0 3.0)); 3 intersecting pairs (first triangles 4 and 17, near
  /// (0.5 0.0 0.0))".
  std::string text() const;
};

}  // namespace algebra3d
