#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/known_triangles.h"
#include "algebra3d/kernel/repair/detail/repair_amounts.h"
#include "algebra3d/kernel/repair/detail/repaired_solid.h"
#include "algebra3d/kernel/repair/detail/soup_repair.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Lost patches: manifold patches of a mesh none of whose corners is a corner of the solid that was made of it.
struct LostPatches {
  bool is_any = false;
  IdVector<FaceId, bool> is_in_closed_one;  ///< per face: whether it is in a lost patch without a boundary
};

/// One repair of given triangles, by one strategy (repair_strategy.h); `repaired_solid` makes some of them and chooses.
/// The steps before triangles are divided are those of SoupRepair; division and measurement are here. Order of calls:
/// `make` for every strategy that is tried; `measure` for attempts whose cost is compared; `finish` for the chosen one
/// only.
/// If none is chosen, the report is that of the usual strategy: `finish` of its attempt gives the reason, if it has no
/// solid; otherwise `nothing`, with the reason that all solids differ from most of the parity estimate. Copyable.
class RepairAttempt {
 public:
  /// `given` must outlive this.
  RepairAttempt(const KnownTriangles& given, const RepairStrategy& strategy, const RepairOptions& options,
                const Monitor& monitor)
      : given_(&given),
        options_(options),
        monitor_(monitor),
        soup_(IndexedSoup(given.mesh()), strategy, options, monitor) {}

  /// Makes the solid, or sets the reason why there is none. `found`: the report of the proof of `given`; `earlier`:
  /// attempts at the same triangles that are made. If the steps of one of them gave the same triangles, its solid is
  /// taken over. Errors: interrupted.
  Status make(const ValidityReport& found, std::span<const RepairAttempt* const> earlier = {});
  /// Measures the parts left out and added, unless that was done. Requires a solid. Errors: interrupted.
  Status measure();
  /// Removes shells as the options say, proves the solid and completes the report. Gives no solid, with the reason, if
  /// there is none, if it leaves out or adds a larger part of the area seen than the options allow (tested here only,
  /// so no other strategy is tried because of it), or if the proof fails. Errors: interrupted.
  Result<RepairedSolid> finish() &&;
  /// A result without a solid: this reason, and the report of this attempt.
  RepairedSolid nothing(std::string reason);

  bool has_solid() const { return !reason_; }
  /// True if triangles were divided at one another for this attempt: it did not take over a solid.
  bool has_divided() const { return has_divided_; }
  const TriangleMesh& solid() const { return solid_; }
  /// True if the solid encloses what the triangles do: nothing had to be divided, and no misconnected triangle,
  /// dangling sheet or open patch was dropped. (Degenerate triangles and duplicates enclose nothing.)
  bool keeps_what_is_enclosed() const;
  /// False if no other strategy can help: the work limit is reached, or the options leave a hole open.
  bool may_be_done_otherwise() const { return !is_beyond_limit_ && !has(RepairStep::open_holes); }
  /// The triangles of patches that enclose no more than noise.
  const std::vector<Triangle3>& sheets() const { return soup_.sheets(); }
  bool has_replaced_misconnected() const { return has(RepairStep::misconnected_triangles); }

  /// The area left out plus the area added, as a fraction of the area seen. Requires `measure`.
  double cost() const;
  /// The area left out, as a fraction of the area seen. Requires `measure`.
  double left_out_part() const { return soup_.report().amounts->left_out_part(); }
  /// True if the solids have the same faces, and no corner was moved farther by one attempt than by the other: then
  /// both leave out and add the same. Cost: n log n.
  bool costs_as_much_as(const RepairAttempt& other) const;
  /// True if it is worth trying strategies that may cost less. Requires `measure`.
  bool is_worth_trying(TryIf condition) const;

 private:
  bool has(RepairStep step) const { return soup_.report().find(step) != nullptr; }
  bool has_triangles_of(const RepairAttempt& other) const;
  void take_solid_of(const RepairAttempt& other);
  Status make_solid(bool may_cross);
  Result<bool> take_if_valid(const FaceSet& known);
  Status divide(const ValidParts& parts);
  void report_losses();
  Vec3 place_of_meeting() const;
  Status note_outcome(Status made);
  std::string reason_for_nothing() const;
  std::optional<std::string> reason_for_limit() const;
  Status report_division();
  void report_divided(const TriangleClasses& classes);
  void report_outside(const TriangleClasses& classes);
  Status report_turned();
  std::vector<bool> are_flipped_so_far(const std::vector<FaceId>& triangles) const;
  std::vector<FaceId> triangles_of_file() const;
  Status filter();
  Status complete_report();
  Result<bool> is_proved(const FaceSet& known) const;

  const KnownTriangles* given_;
  RepairOptions options_;
  Monitor monitor_;
  SoupRepair soup_;
  TriangleMesh solid_;
  IdVector<FaceId, bool> met_others_;  // per triangle: whether it was divided where it meets others; empty if none was
  LostPatches lost_;
  bool is_made_ = false;      // `make` came as far as to a solid, or to the work limit
  bool has_divided_ = false;  // the triangles were divided at one another, within the limit or not
  bool is_proved_ = false;
  bool is_beyond_limit_ = false;
  std::optional<std::string> reason_;   // why there is no solid
  std::vector<bool> are_covers_there_;  // per cover of the report; set by `measure`
};

}  // namespace algebra3d
