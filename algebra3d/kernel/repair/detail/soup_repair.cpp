#include "algebra3d/kernel/repair/detail/soup_repair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/bands.h"
#include "algebra3d/kernel/repair/detail/dangling_sheets.h"
#include "algebra3d/kernel/repair/detail/degenerate_triangles.h"
#include "algebra3d/kernel/repair/detail/duplicate_triangles.h"
#include "algebra3d/kernel/repair/detail/holes.h"
#include "algebra3d/kernel/repair/detail/misconnected_triangles.h"
#include "algebra3d/kernel/repair/detail/nonmanifold_loops.h"
#include "algebra3d/kernel/repair/detail/one_sided_patches.h"
#include "algebra3d/kernel/repair/detail/shell_orientation.h"
#include "algebra3d/kernel/repair/detail/stitching.h"
#include "algebra3d/kernel/repair/detail/triangle_orientation.h"
#include "algebra3d/kernel/soup/rounding_noise.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr double kGapPerDiagonal = 1e-4;

double noise_of(const IndexedSoup& soup) {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : soup.triangles)
    for (const std::uint32_t corner : triangle) box.extend(soup.points[corner]);
  return RoundingNoise(soup.points).within(box);
}

bool has_boundary(const TriangleMesh& mesh) {
  return !is_closed(mesh);
}

/// True if an edge has one triangle, or several that do not balance. Two that do not are a matter of orientation.
bool has_open_edges(const TriangleMesh& mesh) {
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    if (edge.size() != 2 && !is_balanced(mesh, edge)) return true;
  }
  return has_boundary(mesh);
}

}  // namespace

bool is_balanced(const TriangleMesh& mesh) {
  return is_closed(mesh) && is_consistently_oriented(mesh);
}

double SoupRepair::largest_hole() const {
  return options_.largest_hole.value_or(std::numeric_limits<double>::infinity());
}

void SoupRepair::drop_defective(const ValidityReport& found) {
  if (found.count(Defect::degenerate_triangle) > 0) drop_degenerate_triangles(soup_, report_);
  if (found.count(Defect::duplicate_triangle) > 0) {
    const auto before = soup_.triangles;
    drop_duplicates();
    note_dropped(before);
  }
  without_defective_ = soup_.mesh();
}

/// Remembers the triangles that are there no longer, and none with the same corners.
void SoupRepair::note_dropped(const IdVector<FaceId, TriangleMesh::Triangle>& before) {
  if (soup_.triangles.size() == before.size()) return;
  const auto in_order = [](TriangleMesh::Triangle corners) {
    std::ranges::sort(corners);
    return corners;
  };
  std::vector<TriangleMesh::Triangle> rest;
  for (const TriangleMesh::Triangle& triangle : soup_.triangles) rest.push_back(in_order(triangle));
  std::ranges::sort(rest);
  for (const TriangleMesh::Triangle& t : before)
    if (!std::ranges::binary_search(rest, in_order(t)))
      dropped_middles_.push_back((1.0 / 3) * (soup_.points[t[0]] + soup_.points[t[1]] + soup_.points[t[2]]));
}

void SoupRepair::drop_duplicates() {
  if (!has_duplicate_triangles(mesh())) return;
  IndexedSoup rest = soup_;
  RepairReport report = report_;
  drop_duplicate_triangles(rest, report);
  if (rest.triangles.size() == soup_.triangles.size()) return;
  // Closed shells that share triangles would be open without them, and winding numbers count them all. Where half of
  // the triangles or more would go, everything is double, and balanced for that reason alone.
  const bool is_double = 2 * rest.triangles.size() <= soup_.triangles.size();
  if (!is_double && is_balanced(mesh()) && has_open_edges(*rest.mesh())) {
    // Those that cancel each other change no winding number.
    drop_opposite_triangles(soup_, report_);
    return;
  }
  soup_ = std::move(rest);
  report_ = std::move(report);
}

/// After triangles moved, or were added; not reported, since the report is on the triangles of the file.
void SoupRepair::drop_what_became_defective() {
  if (soup_.mesh() == without_defective_) return;
  RepairReport given = report_;
  drop_degenerate_triangles(soup_, report_);
  drop_duplicates();
  report_ = std::move(given);
  without_defective_ = soup_.mesh();
}

void SoupRepair::stitch() {
  if (!has_boundary(mesh())) return;
  const double diagonal = soup_.diagonal();
  const double tolerance = strategy_.stitches_gaps ? options_.gap_tolerance.value_or(kGapPerDiagonal * diagonal) : 0;
  merge_rounded_corners(soup_, std::min(tolerance, noise_of(soup_)), report_);
  drop_what_became_defective();
  if (!has_boundary(mesh())) return;
  split_t_junctions(soup_, report_);
  if (!has_boundary(mesh()) || !(tolerance > 0)) return;
  stitch_gaps(soup_, tolerance, report_);
  drop_what_became_defective();
}

/// Whatever the strategy: they bound nothing, and closed they would cross themselves.
Status SoupRepair::drop_one_sided_patches() {
  A3D_ASSIGN(const auto is_dropped, one_sided_patches(soup_, monitor_));
  const FaceComponents components = connected_components(mesh());
  std::vector<bool> is_reported(components.count);
  for (const FaceId face : soup_.triangles.ids()) {
    if (!is_dropped[face]) continue;
    sheets_.push_back({soup_.corner(face, 0), soup_.corner(face, 1), soup_.corner(face, 2)});
    const std::size_t c = components.of_face[face.index()];
    if (!is_reported[c]) report_.add(RepairStep::open_patches, soup_.corner(face, 0));
    is_reported[c] = true;
  }
  soup_.drop(is_dropped);
  return {};
}

Status SoupRepair::orient() {
  if (mesh().nonmanifold_edge_count() > 0) orient_triangles(soup_, report_);
  const bool may_have_one_side = has_boundary(mesh()) && mesh().nonmanifold_edge_count() > 0;
  if (may_have_one_side && strategy_.closes_holes) A3D_TRY(drop_one_sided_patches());
  if (!strategy_.drops_open_patches) return {};
  if (has_boundary(mesh())) drop_misconnected_triangles(soup_, report_);
  if (has_boundary(mesh()) && mesh().nonmanifold_edge_count() > 0) {
    const auto before = soup_.triangles;
    drop_dangling_sheets(soup_, report_);
    note_dropped(before);
  }
  return {};
}

Result<bool> SoupRepair::close_bands() {
  A3D_ASSIGN(const bool has_some, algebra3d::close_bands(soup_, largest_hole(), report_, monitor_));
  if (has_some) drop_what_became_defective();
  return has_some;
}

/// False if nothing was closed, or something is to stay open.
Result<bool> SoupRepair::close_holes_once() {
  const std::size_t triangle_count = soup_.triangles.size();
  const HoleLimits limits{largest_hole(), strategy_.drops_open_patches, options_.gap_tolerance};
  A3D_ASSIGN(const std::vector<Triangle3> thin, algebra3d::close_holes(soup_, limits, report_, monitor_));
  sheets_.insert(sheets_.end(), thin.begin(), thin.end());
  const std::size_t hole_count = report_.covers.size();
  const NonmanifoldLoopLimits loop_limits{largest_hole(), false, strategy_.takes_shortcuts};
  A3D_TRY(close_nonmanifold_loops(soup_, loop_limits, report_, monitor_));
  if (report_.covers.size() > hole_count) has_covered_nonmanifold_loops_ = true;
  return soup_.triangles.size() != triangle_count && report_.find(RepairStep::open_holes) == nullptr;
}

Status SoupRepair::close_holes() {
  if (!strategy_.closes_holes) return {};
  // A cover may be degenerate in part, and leave smaller holes where that is dropped.
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds && has_boundary(mesh()); ++round) {
    if (round > 0) split_t_junctions(soup_, report_);
    A3D_ASSIGN(const bool has_closed, close_holes_once());
    if (!has_closed) break;
    drop_what_became_defective();
  }
  if (strategy_.covers_interfaces) {
    const NonmanifoldLoopLimits limits{largest_hole(), true, strategy_.takes_shortcuts};
    A3D_TRY(close_nonmanifold_loops(soup_, limits, report_, monitor_));
  }
  drop_what_became_defective();
  return {};
}

Status SoupRepair::orient_shells() {
  return algebra3d::orient_shells(soup_, report_, monitor_);
}

}  // namespace algebra3d
