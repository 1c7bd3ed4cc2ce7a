#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/repair/amount.h"

namespace algebra3d {

/// What a repair does, in the order in which it does it.
enum class RepairStep : std::uint8_t {
  repeated_corners,   ///< facets that repeat a corner, dropped
  collinear_corners,  ///< facets with collinear corners, dropped
  duplicate_facets,   ///< facets with the corners of an earlier one, dropped
  opposed_facets,     ///< the last facets of those with the same corners, dropped since nothing lies between them
  divided_edges,      ///< boundary edges divided at vertices that lie on them
  cracks,             ///< vertices moved to others across a crack
  turned_facets,      ///< facets turned over to agree with their neighbours
  misfits,            ///< facets whose removal makes the rim of a hole shorter and its cover smaller, dropped
  fins,               ///< facets that end in the open and hang on a surface that needs them not, dropped
  holes,              ///< holes closed
  open_holes,         ///< holes left open, because the options say so
  sheets,             ///< sheets, dropped
  turned_shells,      ///< facets of shells turned right side out
  intersections,      ///< facets that passed through others or lay upon them, divided
  united_bodies,      ///< bodies that became one with others
  inner_shells,       ///< shells that bound nothing, dropped
  inner_facets,       ///< facets within the solid, removed
  outer_facets,       ///< facets that lie outside the solid, at least in part, and were not dropped by another step
  cavities,           ///< cavities filled, because the options say so
  small_shells,       ///< shells dropped, because the options say so
};
inline constexpr std::size_t kRepairSteps = 20;

/// A place in decimals that are short, but fine enough to find it: no coarser than a 100,000th of the size given, the
/// diagonal of a file.
Vec3 short_place(const Vec3& where, double size);

/// "near (0.5 0 1)", by a short place; of a size that is not known with six digits.
std::string near_text(const Vec3& where, double size);

/// A part of 1 in percent: "62.5 %"; less than all is never rounded to 100 %.
std::string percent_text(double part);

/// A part of 1 and a limit that it exceeds in percent, the part with so many digits that this can be seen.
std::pair<std::string, std::string> percents_above_limit(double part, double limit);

/// The step's name as people see it: "cracks".
std::string_view name_of(RepairStep step);

/// What one step found and did.
struct RepairEntry {
  RepairStep step;
  std::uint64_t count = 0;
  Vec3 where;          ///< the place of the first one
  double largest = 0;  ///< how far a point was moved or added away from the surface, at most
};

/// Triangles by which one hole was closed.
struct HoleCover {
  Vec3 where;
  double farthest = 0;  ///< no point of the cover is farther from the rim
  std::vector<std::array<Vec3, 3>> triangles;
};

/// How much of some facets, or of a solid, and how far away from the other one.
struct SurfaceAmount {
  std::uint64_t facet_count = 0;  ///< that lie there at least in part
  Amount area;
  double distance = 0;  ///< the largest one, as an upper bound (FarthestPoint); may be infinite
  Vec3 where;           ///< the point that is farthest away; of what lies inside any point
};

/// Amounts by which a solid differs from the facets that it was made of. Parts of facets that are no farther from the
/// other surface than `tolerance` belong to it. Facets that lie upon each other count once, whichever way they look
/// and however they are divided into triangles.
struct RepairAmounts {
  Amount area_seen;       ///< of all facets as given
  SurfaceAmount dropped;  ///< facets outside the solid
  SurfaceAmount inside;   ///< facets within the solid, such as inner walls; no distance
  SurfaceAmount added;    ///< of the boundary of the solid, where there is no facet
  double tolerance = 0;   ///< in coordinate units

  /// The part of the area seen that lies outside the solid: from 0 to 1.
  double dropped_part() const { return part_of_seen(dropped); }
  /// May be larger than 1 of what was added; 0 if nothing has an area.
  double part_of_seen(const SurfaceAmount& amount) const {
    return area_seen.is_zero() ? 0 : amount.area.ratio_to(area_seen);
  }
};

/// All that a repair found and did. Steps that had nothing to do are left out; entries are in the order of the steps.
struct RepairReport {
  std::vector<RepairEntry> entries;
  double size = 0;                       ///< diagonal of the box around the facets; 0 if not known
  std::optional<Amount> volume_before;   ///< of the facets as given; none if they are not closed
  std::optional<Amount> volume_after;    ///< of the solid; none if there is none
  std::optional<RepairAmounts> amounts;  ///< what was left out and added; none if there is no solid
  bool has_kept_sheets = false;          ///< sheets that `entries` counts are still there
  std::vector<HoleCover> covers;         ///< of the closed holes, in the order in which they were closed

  void add(RepairStep step, const Vec3& where, double distance = 0, std::uint64_t count = 1);
  /// A closed hole.
  void add(HoleCover cover);
  /// Takes back the holes whose covers the solid does not have.
  void keep_holes(const std::vector<bool>& are_there);
  /// The triangles of all covers, their corners ascending, in ascending order.
  std::vector<std::array<Vec3, 3>> cover_triangles() const;
  /// Takes back what a step reported.
  void forget(RepairStep step);
  const RepairEntry* find(RepairStep step) const;
  bool is_empty() const { return entries.empty(); }
  /// The largest distance over all steps by which they moved or added anything; an upper bound.
  double deviation() const;
  /// The largest distance over the steps that move corners.
  double largest_move() const;
  /// For people, one line: "3 duplicate facets dropped (near (0 0 1)), 1 hole closed (near (2 0 0)); left out: 2
  /// facets, area 10 (62.5 %), up to 9 from the solid (near (0 0 10)); added: area 1, up to 0.5 from the facets". Never
  /// empty.
  std::string text() const;
};

}  // namespace algebra3d
