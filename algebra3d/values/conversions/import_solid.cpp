#include "algebra3d/values/conversions/import_solid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/repair/surface_from_soup.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

/// A fault of the file is an outcome; a fault of the statement stays an error.
bool is_fault_of_file(const Error& error) {
  return error.code != ErrorCode::interrupted && error.code != ErrorCode::out_of_memory;
}

Result<ImportedSolid> refused_or_failed(Error error) {
  if (!is_fault_of_file(error)) return error;
  ImportedSolid result;
  result.was_read = error.code == ErrorCode::file_format || error.code == ErrorCode::limit_exceeded;
  result.status = error.message;
  result.failure = std::move(error);
  return result;
}

Result<ImportedSurface> refused_surface_or_failed(Error error) {
  if (!is_fault_of_file(error)) return error;
  ImportedSurface result;
  result.refusal = std::move(error);
  return result;
}

/// Reports what may be missing, and refuses the solid for it if repair is not wanted: missing triangles may belong to
/// it.
void judge_completeness(ImportedSolid& result, const std::vector<std::string>& unread, bool is_strict) {
  std::vector<std::string> texts = unread;
  if (result.wrong_count) texts.push_back(result.wrong_count->text());
  if (texts.empty()) return;
  const std::string text = fmt::format("{}", fmt::join(texts, "; "));
  const bool is_refused = is_strict && result.solid;
  result.status = is_refused ? text : result.status + "; " + text;
  if (!is_refused) return;
  result.solid.reset();
  result.measures = {};
}

std::optional<double> in_doubles(const std::optional<Amount>& amount) {
  return amount ? amount->in_doubles() : std::nullopt;
}

std::optional<double> finite(double length) {
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

ImportMeasures measures_of(const SolidFromSoup& made) {
  ImportMeasures measures;
  measures.area_seen = in_doubles(made.area_seen);
  measures.volume_after = in_doubles(made.volume);
  measures.volume_before = in_doubles(made.repair ? made.repair->volume_before : made.volume);
  if (made.mesh && !made.repair) {
    measures.facets_dropped = 0;
    measures.area_dropped = measures.area_added = measures.dropped_distance = measures.added_distance = 0;
  }
  if (!made.repair || !made.repair->amounts) return measures;
  const RepairAmounts& amounts = *made.repair->amounts;
  measures.facets_dropped = amounts.left_out.triangle_count;
  measures.area_dropped = amounts.left_out.area.in_doubles();
  measures.area_added = amounts.added.area.in_doubles();
  measures.dropped_distance = finite(amounts.left_out.distance);
  measures.added_distance = finite(std::max(amounts.added.distance, made.repair->largest_move()));
  return measures;
}

}  // namespace

std::string ImportedSolid::text_about(std::string_view name) const {
  return failure && !failure->subject.empty() ? failure->text() : fmt::format("{}: {}", name, status);
}

Result<ImportedSolid> import_solid(const std::filesystem::path& path, const mesh_formats::MeshFormat* format,
                                   const RepairOptions& options, const Monitor& monitor) {
  return import_solid(read_mesh_file(path, format, monitor.cancel()), options, monitor);
}

Result<ImportedSolid> import_solid(Result<MeshFile> read, const RepairOptions& options, const Monitor& monitor) {
  if (!read.ok()) return refused_or_failed(std::move(read).error());
  auto made = solid_from_soup(read->soup, options, monitor);
  if (!made.ok()) return refused_or_failed(std::move(made).error());
  ImportedSolid result;
  result.status = made->status();
  result.measures = measures_of(*made);
  result.remarks = std::move(read->remarks);
  for (std::string& remark : made->report.remarks()) result.remarks.push_back(std::move(remark));
  if (made->mesh && made->repair) result.remarks.push_back(result.status);
  if (made->mesh) result.solid = Volume3d::trusted(*std::move(made->mesh));
  result.found = std::move(made->report);
  result.repair = std::move(made->repair);
  result.wrong_count = read->wrong_count;
  result.bent = read->bent;
  if (result.bent.count > 0) result.status += "; " + result.bent.text();
  judge_completeness(result, read->unread, options.is_strict);
  return result;
}

Result<ImportedSurface> import_surface(const std::filesystem::path& path, const Monitor& monitor) {
  return import_surface(read_mesh_file(path, nullptr, monitor.cancel()), monitor);
}

Result<ImportedSurface> import_surface(Result<MeshFile> read, const Monitor& monitor) {
  if (!read.ok()) return refused_surface_or_failed(std::move(read).error());
  auto made = surface_from_soup(read->soup, {}, monitor);
  if (!made.ok()) return refused_surface_or_failed(std::move(made).error());
  ImportedSurface result;
  result.remarks = std::move(read->remarks);
  if (!made->repair.is_empty()) result.remarks.push_back("repaired: " + made->repair.text());
  result.surface = Surface3d::trusted(std::move(made->mesh));
  return result;
}

}  // namespace algebra3d
