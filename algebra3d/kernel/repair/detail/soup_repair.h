#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/detail/repair_strategy.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/validity/report.h"

namespace algebra3d {

/// The steps of a repair that change a soup, before triangles are divided (steps 1 to 7 of repaired_solid.h). Each is
/// skipped if not needed. To be called in the order of declaration. Degenerate triangles and duplicates that a step
/// makes are dropped at its end, without an entry in the report: entries are about triangles of the file.
class SoupRepair {
 public:
  SoupRepair(IndexedSoup soup, const RepairStrategy& strategy, const RepairOptions& options, const Monitor& monitor)
      : soup_(std::move(soup)), strategy_(strategy), options_(options), monitor_(monitor) {}

  /// Steps 1 and 2: drops degenerate triangles and duplicates, if the proof found any.
  void drop_defective(const ValidityReport& found);
  /// Steps 3 and 4: merges rounded vertices, splits T-junctions and stitches gaps.
  void stitch();
  /// Step 5 and the beginning of 6: orients triangles; drops one-sided patches, misconnected triangles and dangling
  /// sheets.
  Status orient();
  /// Of step 6, for strategies that make bands. True if a band was made.
  Result<bool> close_bands();
  /// The end of step 6: closes holes and non-manifold loops; drops open patches.
  Status close_holes();
  /// Step 7: orients shells.
  Status orient_shells();

  const IndexedSoup& soup() const { return soup_; }
  /// The soup as a linked mesh; the reference is valid until the next step.
  const TriangleMesh& mesh() const { return *soup_.mesh(); }
  RepairReport& report() { return report_; }
  const RepairReport& report() const { return report_; }
  /// The triangles of open patches that are thin or have one side (thin_patches.h, one_sided_patches.h).
  const std::vector<Triangle3>& sheets() const { return sheets_; }
  /// The middles of triangles that the report counts as dangling sheets, or as duplicates of which none is left.
  const std::vector<Vec3>& dropped_middles() const { return dropped_middles_; }
  bool has_covered_nonmanifold_loops() const { return has_covered_nonmanifold_loops_; }
  const RepairStrategy& strategy() const { return strategy_; }

 private:
  double largest_hole() const;
  Status drop_one_sided_patches();
  void drop_duplicates();
  void note_dropped(const IdVector<FaceId, TriangleMesh::Triangle>& before);
  void drop_what_became_defective();
  Result<bool> close_holes_once();

  IndexedSoup soup_;
  RepairStrategy strategy_;
  RepairOptions options_;
  Monitor monitor_;
  RepairReport report_;
  std::shared_ptr<const TriangleMesh> without_defective_;  // the mesh after `drop_defective`
  std::vector<Triangle3> sheets_;
  std::vector<Vec3> dropped_middles_;
  bool has_covered_nonmanifold_loops_ = false;
};

/// True if every edge of the mesh is balanced, boundary edges included: it has equally many half-edges in both
/// directions.
bool is_balanced(const TriangleMesh& mesh);

}  // namespace algebra3d
