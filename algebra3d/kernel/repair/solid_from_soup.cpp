#include "algebra3d/kernel/repair/solid_from_soup.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/repair/detail/repair_amounts.h"
#include "algebra3d/kernel/repair/detail/repaired_solid.h"
#include "algebra3d/kernel/repair/detail/shell_filter.h"
#include "algebra3d/kernel/repair/mesh_volume.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

double diagonal_of(const WeldedTriangles& welded) {
  const Box3 box = Box3::around(welded.points.approx());
  return box.is_empty() ? 0 : length(box.max - box.min);
}

void flip_all(WeldedTriangles& welded) {
  for (auto& [a, b, c] : welded.triangles) std::swap(b, c);
}

/// The triangles of a soup with shared points, in spatial order; all flipped if their volume was negative.
struct OrderedTriangles {
  WeldedTriangles welded;
  std::vector<std::uint32_t> order;  ///< per triangle: its number in the soup
  Rational volume;                   ///< of the triangles as given; means nothing if they are not closed
  bool is_flipped = false;

  TriangleMesh mesh() const { return {welded.points, welded.triangles}; }
};

Result<OrderedTriangles> ordered_triangles(WeldedTriangles welded, const Monitor& monitor) {
  OrderedTriangles result;
  A3D_ASSIGN(result.volume, exact_volume(welded.points, welded.triangles, monitor.cancel()));
  result.is_flipped = result.volume.sign() < 0;
  if (result.is_flipped) flip_all(welded);
  result.order = spatial_order(welded.points.approx(), welded.triangles);
  result.welded = reordered(welded, result.order);
  return result;
}

/// The report with triangles of the soup in place of faces of the ordered mesh.
ValidityReport in_soup_order(ValidityReport report, const std::vector<std::uint32_t>& order) {
  for (DefectExample& example : report.examples) {
    example.first = FaceId(order[example.first.index()]);
    if (!example.second.is_valid()) continue;
    example.second = FaceId(order[example.second.index()]);
    if (example.second < example.first) std::swap(example.first, example.second);
  }
  std::ranges::sort(report.examples, {}, [](const DefectExample& e) { return std::tuple(e.kind, e.first, e.second); });
  return report;
}

/// Takes a valid mesh over, without the shells that the options do not want.
Status take_valid(TriangleMesh mesh, const OrderedTriangles& given, const RepairOptions& options,
                  const Monitor& monitor, SolidFromSoup& result) {
  RepairReport left_out;
  result.area_seen = area_of(mesh, BinaryScale(largest_coordinate(mesh)));
  A3D_ASSIGN(mesh, filter_shells(std::move(mesh), options, left_out, monitor));
  result.volume = Amount::nearest(given.volume.abs());
  result.mesh = left_out.is_empty() ? std::move(mesh) : in_spatial_order(mesh);
  if (left_out.is_empty()) return {};
  left_out.volume_before = result.volume;
  left_out.size = result.report.size;
  A3D_ASSIGN(result.volume, measured_volume(*result.mesh, monitor));
  left_out.volume_after = result.volume;
  A3D_ASSIGN(const MeasuredRepair measured, measure_repair(given.mesh(), *result.mesh, {}, 0, {}, monitor));
  left_out.amounts = measured.amounts;
  result.repair = std::move(left_out);
  return {};
}

/// Repairs a mesh that the examination found not to be a solid.
Status repair(TriangleMesh mesh, OrderedTriangles given, const VolumeExamination& examined,
              const RepairOptions& options, const Monitor& monitor, SolidFromSoup& result) {
  // Which parts of it are inside out is found by the repair.
  if (given.is_flipped) {
    flip_all(given.welded);
    mesh = given.mesh();
  }
  const FaceSet& free = options.reuses_proofs ? examined.free : FaceSet();
  const KnownTriangles known(std::make_shared<const TriangleMesh>(std::move(mesh)), free, given.volume);
  A3D_ASSIGN(RepairedSolid repaired, repaired_solid(known, examined.report, options, monitor));
  result.mesh = std::move(repaired.mesh);
  result.volume = repaired.report.volume_after;
  if (repaired.report.amounts) result.area_seen = repaired.report.amounts->area_seen;
  result.repair = std::move(repaired.report);
  result.reason = std::move(repaired.reason);
  return {};
}

}  // namespace

std::string SolidFromSoup::status() const {
  if (!mesh) return reason.empty() ? report.defects() : report.defects() + "; not repaired: " + reason;
  if (repair) return "repaired: " + repair->text() + (mesh->is_empty() ? "; the solid is empty" : "");
  if (mesh->is_empty()) return "ok: no triangles, the solid is empty";
  return report.was_flipped ? "ok: turned right side out" : "ok";
}

Result<SolidFromSoup> solid_from_soup(const TriangleSoup& soup, const RepairOptions& options, const Monitor& monitor) {
  if (soup.triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; at most {} make a solid", soup.triangles.size(),
                 TriangleMesh::kMaxFaces};
  SolidFromSoup result;
  result.report.count_contradicting_normals(soup);
  WeldedTriangles welded = weld(soup.triangles);
  result.report.size = diagonal_of(welded);
  A3D_ASSIGN(OrderedTriangles given, ordered_triangles(std::move(welded), monitor));
  TriangleMesh mesh = given.mesh();
  A3D_ASSIGN(const VolumeExamination examined, examine_volume(mesh, monitor.cancel()));
  if (examined.report.is_valid()) {
    result.report.was_flipped = given.is_flipped;
    A3D_TRY(take_valid(std::move(mesh), given, options, monitor, result));
    return result;
  }
  result.report.validity = in_soup_order(examined.report, given.order);
  if (options.is_strict) return result;
  A3D_TRY(repair(std::move(mesh), std::move(given), examined, options, monitor, result));
  return result;
}

}  // namespace algebra3d
