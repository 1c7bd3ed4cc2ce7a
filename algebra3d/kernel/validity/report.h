#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// The kinds of defects that make a triangle mesh invalid as a surface3d or volume3d.
enum class Defect : std::uint8_t {
  degenerate_triangle,     ///< corners repeat or are collinear
  duplicate_triangle,      ///< the same three corners as an earlier triangle, in any order
  boundary_edge,           ///< volume: an edge with one triangle only
  nonmanifold_edge,        ///< volume: the triangles along the edge cannot be paired
  inconsistent_edge,       ///< volume: the two triangles of the edge run along it in the same direction
  intersecting_triangles,  ///< the intersection is neither one point nor a whole edge of both
  wrong_winding,           ///< volume: a shell whose winding number is not 0 in front of it, or not 1 behind it
};
inline constexpr std::size_t kDefectKinds = 7;

/// The name of the defect for people: "boundary edges".
std::string_view name_of(Defect kind);

/// A defect with its place, for people.
struct DefectExample {
  Defect kind;
  FaceId first;
  FaceId second;  ///< invalid if only one triangle is concerned
  Vec3 where;     ///< a point at the defect, or in the overlap of the two triangles' boxes; rounded
};

/// The result of a proof: the number of defects of each kind, with the first ones as examples.
struct ValidityReport {
  static constexpr std::size_t kExamplesPerKind = 3;

  std::array<std::uint64_t, kDefectKinds> counts{};
  /// The kExamplesPerKind first examples of each kind, ascending by kind, then by faces, whatever the order of `add`.
  std::vector<DefectExample> examples;
  /// True if counting ended before all intersecting pairs were found: the count is then a lower bound, and the examples
  /// are arbitrary pairs.
  bool is_cut_short = false;
  /// How many vertices lie in faces without being their corners (contacts.h), where the face or one at the vertex is
  /// not known (ProofOptions). Only of valid meshes; else 0.
  std::size_t contact_vertices = 0;

  bool is_valid() const { return total() == 0; }
  std::uint64_t total() const;
  std::uint64_t count(Defect kind) const { return counts[static_cast<std::size_t>(kind)]; }
  /// Adds a defect; call once per defect.
  void add(const DefectExample& defect);
  /// The report for people, one line, triangles numbered from 0; empty if valid. For example "2 boundary edges (first
  /// at triangle 12, near (1.0 2.0 3.0)); 3 intersecting pairs (first triangles 4 and 17, near (0.5 0.0 0.0))".
  std::string text() const;
  /// Likewise with another separator and other words for the places.
  std::string text(std::string_view separator, const std::function<std::string(const DefectExample&)>& place) const;
};

}  // namespace algebra3d
