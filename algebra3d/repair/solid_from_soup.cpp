#include "algebra3d/repair/solid_from_soup.h"

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "algebra3d/exact/exact_sum.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/repair_amounts.h"
#include "algebra3d/repair/repaired_solid.h"
#include "algebra3d/repair/scaled_triangles.h"
#include "algebra3d/repair/spatial_order.h"
#include "algebra3d/repair/weld.h"
#include "algebra3d/validity/validity.h"

namespace algebra3d {
namespace {

struct Wording {
  const char* one;
  const char* many;
};
constexpr std::array<Wording, kDefectKinds> kWordings{{
    {"degenerate facet", "degenerate facets"},
    {"duplicate facet", "duplicate facets"},
    {"boundary edge", "boundary edges"},
    {"non-manifold edge", "non-manifold edges"},
    {"inconsistently oriented edge", "inconsistently oriented edges"},
    {"intersecting pair", "intersecting pairs"},
    {"shell with a wrong winding number", "shells with a wrong winding number"},
}};

std::string place_text(const DefectExample& example, double size) {
  const std::string where = near_text(example.where, size);
  if (!example.second.is_valid()) return fmt::format("facet {}, {}", example.first.index() + 1, where);
  return fmt::format("facets {} and {}, {}", example.first.index() + 1, example.second.index() + 1, where);
}

void count_contradicting_normals(const TriangleSoup& soup, SoupReport& report) {
  for (std::size_t i = 0; i < soup.normals.size(); ++i) {
    const auto& [a, b, c] = soup.triangles[i];
    if (!(dot(cross(b - a, c - a), soup.normals[i]) < 0)) continue;
    if (++report.contradicting_normal_count == 1) report.first_contradicting_facet = i + 1;
  }
}

double diagonal_of(const WeldedTriangles& welded) {
  Box3 box;
  for (const Vec3& point : welded.points.approx()) box.extend(point);
  return box.is_empty() ? 0 : length(box.max - box.min);
}

/// The report of a mesh whose face i is facet order[i].
ValidityReport in_facets(ValidityReport report, const std::vector<std::uint32_t>& order) {
  for (DefectExample& example : report.examples) {
    example.first = FaceId(order[example.first.index()]);
    if (!example.second.is_valid()) continue;
    example.second = FaceId(order[example.second.index()]);
    if (example.second < example.first) std::swap(example.first, example.second);
  }
  std::ranges::sort(report.examples, {}, [](const DefectExample& e) { return std::tuple(e.kind, e.first, e.second); });
  return report;
}

}  // namespace

std::string_view name_of(Defect kind) {
  return kWordings[static_cast<std::size_t>(kind)].many;
}

std::string SoupReport::defects() const {
  std::string text;
  Defect previous{kDefectKinds};
  for (const DefectExample& example : validity.examples) {
    if (example.kind == previous) continue;
    previous = example.kind;
    const std::uint64_t count = validity.count(example.kind);
    const Wording& wording = kWordings[static_cast<std::size_t>(example.kind)];
    const bool at_least = validity.is_cut_short && example.kind == Defect::intersecting_triangles;
    text += fmt::format("{}{}{} {} ({})", text.empty() ? "no valid solid: " : ", ", at_least ? "at least " : "", count,
                        count == 1 ? wording.one : wording.many, place_text(example, size));
  }
  return text;
}

std::vector<std::string> SoupReport::remarks() const {
  std::vector<std::string> remarks;
  if (was_turned) remarks.emplace_back("turned right side out");
  if (contradicting_normal_count == 1)
    remarks.push_back(
        fmt::format("1 facet normal contradicts the order of the corners (facet {})", first_contradicting_facet));
  if (contradicting_normal_count > 1)
    remarks.push_back(fmt::format("{} facet normals contradict the order of the corners (first: facet {})",
                                  contradicting_normal_count, first_contradicting_facet));
  return remarks;
}

std::string SolidFromSoup::status() const {
  if (!mesh) return reason.empty() ? report.defects() : report.defects() + "; not repaired: " + reason;
  if (repair) return "repaired: " + repair->text() + (mesh->is_empty() ? "; the solid is empty" : "");
  if (mesh->is_empty()) return "ok: no facets, the solid is empty";
  return report.was_turned ? "ok: turned right side out" : "ok";
}

Result<SolidFromSoup> solid_from_soup(const TriangleSoup& soup, const RepairOptions& options, const Monitor& monitor) {
  if (soup.triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; at most {} make a solid", soup.triangles.size(),
                 TriangleMesh::kMaxFaces};
  SolidFromSoup result;
  count_contradicting_normals(soup, result.report);
  WeldedTriangles welded = weld(soup.triangles);
  result.report.size = diagonal_of(welded);
  ASSIGN_OR_RETURN(const Rational volume, exact_volume(welded.points, welded.triangles, monitor.cancel()));
  // What is not closed has no volume, and is refused below whichever way it is turned.
  const bool is_inside_out = volume.sign() < 0;
  if (is_inside_out)
    for (auto& [a, b, c] : welded.triangles) std::swap(b, c);
  const std::vector<std::uint32_t> order = spatial_order(welded.points.approx(), welded.triangles);
  welded = reordered(welded, order);
  TriangleMesh mesh(welded.points, welded.triangles);
  ASSIGN_OR_RETURN(const VolumeExamination examined, examine_volume(mesh, monitor.cancel()));
  const ValidityReport& validity = examined.report;
  result.report.was_turned = is_inside_out && validity.is_valid();
  if (validity.is_valid()) {
    RepairReport left_out;
    result.area_seen = area_of(mesh, BinaryScale(largest_coordinate(mesh)));
    ASSIGN_OR_RETURN(mesh, kept_shells(std::move(mesh), options, left_out, monitor));
    result.volume = Amount::nearest(volume.abs());
    result.mesh = left_out.is_empty() ? std::move(mesh) : in_spatial_order(mesh);
    if (left_out.is_empty()) return result;
    left_out.volume_before = result.volume;
    left_out.size = result.report.size;
    ASSIGN_OR_RETURN(result.volume, measured_volume(*result.mesh, monitor));
    left_out.volume_after = result.volume;
    const TriangleMesh given(welded.points, welded.triangles);
    ASSIGN_OR_RETURN(const MeasuredRepair measured, measure_repair(given, *result.mesh, {}, 0, {}, monitor));
    left_out.amounts = measured.amounts;
    result.repair = std::move(left_out);
    return result;
  }
  result.report.validity = in_facets(validity, order);
  if (options.is_strict) return result;
  // Which parts of it are inside out is found by the repair.
  if (is_inside_out) {
    for (auto& [a, b, c] : welded.triangles) std::swap(b, c);
    mesh = TriangleMesh(welded.points, welded.triangles);
  }
  const KnownFacets given(std::make_shared<const TriangleMesh>(std::move(mesh)), examined.free, volume);
  ASSIGN_OR_RETURN(RepairedSolid repaired, repaired_solid(given, validity, options, monitor));
  result.mesh = std::move(repaired.mesh);
  result.volume = repaired.report.volume_after;
  if (repaired.report.amounts) result.area_seen = repaired.report.amounts->area_seen;
  result.repair = std::move(repaired.report);
  result.reason = std::move(repaired.reason);
  return result;
}

}  // namespace algebra3d
