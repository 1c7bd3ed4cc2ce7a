#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// What a repair does, in the order in which it does it.
enum class RepairStep : std::uint8_t {
  repeated_corners,   ///< facets that repeat a corner, dropped
  collinear_corners,  ///< facets with collinear corners, dropped
  duplicate_facets,   ///< facets with the corners of another one, dropped
  divided_edges,      ///< boundary edges divided at vertices that lie on them
  cracks,             ///< vertices moved to others across a crack
  turned_facets,      ///< facets turned over to agree with their neighbours
  holes,              ///< holes closed
  open_holes,         ///< holes left open
  turned_shells,      ///< facets of shells turned right side out
  intersections,      ///< facets that passed through others or lay upon them, divided
  inner_shells,       ///< shells that bound nothing, dropped
  cavities,           ///< cavities filled, because the options say so
  small_shells,       ///< shells dropped, because the options say so
};
inline constexpr std::size_t kRepairSteps = 13;

/// The step's name as people see it: "cracks".
std::string_view name_of(RepairStep step);

/// What one step found and did.
struct RepairEntry {
  RepairStep step;
  std::uint64_t count = 0;
  Vec3 where;          ///< the place of the first one
  double largest = 0;  ///< how far a point was moved or added away from the surface, at most
};

/// All that a repair found and did. Steps that had nothing to do are left out; entries are in the order of the steps.
struct RepairReport {
  std::vector<RepairEntry> entries;
  std::optional<double> volume_before;  ///< of the facets as given; none if they are not closed
  std::optional<double> volume_after;   ///< of the solid; none if there is none

  void add(RepairStep step, const Vec3& where, double distance = 0);
  const RepairEntry* find(RepairStep step) const;
  bool is_empty() const { return entries.empty(); }
  /// The largest distance over all steps.
  double deviation() const;
  /// For people, one line: "3 duplicate facets dropped (near (0 0 1)), 1 hole closed (near (2 0 0)); at most 0.01 from
  /// the facets"; empty if there is no entry.
  std::string text() const;
};

}  // namespace algebra3d
