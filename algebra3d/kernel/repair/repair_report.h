#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/repair/amount.h"

namespace algebra3d {

/// The steps of a repair, in the order in which the report lists them. That is roughly the order in which they are
/// done: rounded corners, which are merged before T-junctions are split, count as gaps.
enum class RepairStep : std::uint8_t {
  repeated_corners,        ///< triangles that repeat a corner, dropped
  collinear_corners,       ///< triangles with collinear corners, dropped
  duplicate_triangles,     ///< triangles with the corners of an earlier one, dropped
  opposite_triangles,      ///< the last triangles of sets of duplicates that cancel out, dropped like the others
  t_junctions,             ///< boundary edges split at vertices that lie on them
  gaps,                    ///< vertices moved to others across a gap
  flipped_triangles,       ///< triangles flipped to agree with their neighbours
  misconnected_triangles,  ///< triangles with a wrong corner, dropped; the hole beside them is closed
  dangling_sheets,         ///< triangles of sheets that hang on a surface and enclose nothing, dropped
  holes,                   ///< holes closed
  open_holes,              ///< holes left open, because the options say so
  open_patches,            ///< open patches, dropped (or divided: RepairReport::has_kept_open_patches)
  flipped_shells,          ///< shells turned right side out
  intersections,           ///< triangles that crossed or overlapped others, divided
  united_bodies,           ///< bodies united with others
  inner_shells,            ///< shells that bound nothing, dropped
  inner_triangles,         ///< triangles within the solid, removed
  outer_triangles,         ///< triangles outside the solid, at least in part, that no other step dropped
  cavities,                ///< cavities filled, because the options say so
  small_shells,            ///< shells dropped, because the options say so
};
inline constexpr std::size_t kRepairSteps = 20;

/// The point rounded to short decimals, no coarser than a 100,000th of `size`, the diagonal of the file.
Vec3 short_place(const Vec3& where, double size);

/// "near (0.5 0 1)", by short_place; with six digits if the size is not known.
std::string near_text(const Vec3& where, double size);

/// A fraction in percent: "62.5 %". A fraction below 1 is never rounded to 100 %.
std::string percent_text(double part);

/// A fraction and the limit that it exceeds, both in percent; the fraction has enough digits to show that it is larger.
std::pair<std::string, std::string> percents_above_limit(double part, double limit);

/// The name of the step for people: "gaps".
std::string_view name_of(RepairStep step);

/// The entry of one step in a report: how often it did something, and where first.
struct RepairEntry {
  RepairStep step;
  std::uint64_t count = 0;
  Vec3 where;  ///< the place of the first one
  /// The largest distance of a moved point from its old place, or of an added one from the surface; as coordinates.
  double largest = 0;
};

/// The triangles by which one hole was closed: its cover.
struct HoleCover {
  Vec3 where;           ///< a corner of the boundary of the hole
  double farthest = 0;  ///< upper bound of the distance from the boundary of the hole
  std::vector<std::array<Vec3, 3>> triangles;
};

/// Size of a part of a surface, and its distance from another surface.
struct SurfaceAmount {
  std::uint64_t triangle_count = 0;  ///< triangles that belong to it at least in part
  Amount area;
  double distance = 0;  ///< upper bound of the largest distance of one of its points; may be infinite
  Vec3 where;           ///< the farthest point; for parts inside a solid any point
};

/// The differences between a solid and the triangles that it was made of. Parts within `tolerance` of the other surface
/// count as parts of it. Overlapping triangles count once, whatever their orientation and division. "Left out" means:
/// not in the solid, whatever the reason; "dropped" is only said of steps (RepairStep).
struct RepairAmounts {
  Amount area_seen;        ///< of all triangles as given
  SurfaceAmount left_out;  ///< triangles outside the solid
  SurfaceAmount inside;    ///< triangles within the solid, such as interfaces; no distance
  SurfaceAmount added;     ///< the boundary of the solid where there is no triangle
  double tolerance = 0;    ///< MeasureFrame::tolerance, in coordinate units

  /// The fraction of the area seen that lies outside the solid, from 0 to 1.
  double left_out_part() const { return part_of_seen(left_out); }
  /// The area added as a fraction of the area seen; may be above 1.
  double added_part() const { return part_of_seen(added); }
  /// The amount divided by the area seen; above 1 if more was added than was there. 0 if the area seen is 0.
  double part_of_seen(const SurfaceAmount& amount) const {
    return area_seen.is_zero() ? 0 : amount.area.ratio_to(area_seen);
  }
};

/// The report of a repair. Entries are in the order of the steps; steps that changed nothing have none.
struct RepairReport {
  std::vector<RepairEntry> entries;
  double size = 0;                       ///< diagonal of the box around the triangles; 0 if not known
  std::optional<Amount> volume_before;   ///< of the triangles as given; nothing if an edge is not balanced
  std::optional<Amount> volume_after;    ///< of the solid; none if there is none
  std::optional<RepairAmounts> amounts;  ///< nothing if there is no solid
  bool has_kept_open_patches = false;    ///< the open patches in `entries` were not dropped, but divided with the rest
  std::vector<HoleCover> covers;         ///< of closed holes, in the order in which they were closed

  /// Adds what a step did `count` times. The entry keeps the first place and the largest distance.
  void add(RepairStep step, const Vec3& where, double distance = 0, std::uint64_t count = 1);
  /// Adds a closed hole.
  void add(HoleCover cover);
  /// Removes from the report those closed holes whose covers have no part in the boundary of the solid. `are_there`:
  /// one flag per cover; false for those to remove.
  void drop_missing_covers(const std::vector<bool>& are_there);
  /// The triangles of all covers, their corners ascending, in ascending order.
  std::vector<std::array<Vec3, 3>> cover_triangles() const;
  /// Removes the entry of a step.
  void forget(RepairStep step);
  /// The entry of a step; null if there is none.
  const RepairEntry* find(RepairStep step) const;
  bool is_empty() const { return entries.empty(); }
  /// An upper bound of the distance by which any step moved or added a point.
  double deviation() const;
  /// The largest distance by which a corner was moved.
  double largest_move() const;
  /// The report for people, one line, never empty: "3 duplicate triangles dropped (near (0 0 1)), 1 hole closed (near
  /// (2 0 0)); left out: 2 triangles, area 10 (62.5 %), up to 9 from the solid (near (0 0 10)); added: area 1 (6.25 %),
  /// up to 0.5 from the triangles". If more than a tenth was added, it begins with "25 % of the area seen added;".
  std::string text() const;

 private:
  std::string changes_text() const;
};

}  // namespace algebra3d
