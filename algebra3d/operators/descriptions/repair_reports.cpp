// repairReport: what was found in a mesh file, and what was changed, as rows.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/file_bytes.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/operators/registry/rows.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/diagnostics.h"
#include "base/mesh_content.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Phase, What, Count, Where, Amount.
using ReportRows =
    Rows<std::string, std::string, std::optional<std::int64_t>, std::optional<Point3d>, std::optional<double>>;
using ReportRow = ReportRows::Cells;

std::int64_t as_int(std::uint64_t count) {
  return static_cast<std::int64_t>(count);
}

std::optional<double> in_doubles(const std::optional<Amount>& amount) {
  return amount ? amount->in_doubles() : std::nullopt;
}

std::optional<double> finite(double length) {
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

void add_amounts(std::vector<ReportRow>& rows, const RepairAmounts& amounts, double size) {
  const auto place = [&](const SurfaceAmount& amount) -> std::optional<Point3d> {
    if (amount.triangle_count == 0) return {};
    return Point3d{short_place(amount.where, size)};
  };
  rows.push_back({"area", "seen", {}, {}, amounts.area_seen.in_doubles()});
  for (const auto& [name, amount] : {std::pair("left out", amounts.left_out), std::pair("added", amounts.added)})
    rows.push_back({"area", name, as_int(amount.triangle_count), {}, amount.area.in_doubles()});
  for (const auto& [name, amount] : {std::pair("left out", amounts.left_out), std::pair("added", amounts.added)})
    rows.push_back({"distance", name, {}, place(amount), finite(amount.distance)});
}

void add_wrong_count(std::vector<ReportRow>& rows, const mesh_formats::WrongCount& wrong) {
  const auto add = [&](const char* name, std::uint64_t count) {
    rows.push_back({"file", name, as_int(count), {}, {}});
  };
  if (wrong.missing_ends > 0) return add("solids without an end", wrong.missing_ends);
  add("announced triangles", wrong.announced);
  add("triangles by size", wrong.by_size);
  if (wrong.trailing_bytes > 0) add("trailing bytes", wrong.trailing_bytes);
}

std::vector<ReportRow> rows_of(const ImportedSolid& imported) {
  std::vector<ReportRow> rows;
  if (const auto& wrong = imported.wrong_count) {
    add_wrong_count(rows, *wrong);
  }
  const double size = imported.found.size;
  if (const BentPolygons& bent = imported.bent; bent.count > 0)
    rows.push_back(
        {"file", "polygons not planar", as_int(bent.count), Point3d{short_place(bent.where, size)}, bent.largest});
  std::optional<Defect> previous;
  for (const DefectExample& example : imported.found.validity.examples) {
    if (example.kind == previous) continue;
    previous = example.kind;
    rows.push_back({"found",
                    std::string(name_of(example.kind)),
                    as_int(imported.found.validity.count(example.kind)),
                    Point3d{short_place(example.where, size)},
                    {}});
  }
  if (!imported.repair) return rows;
  for (const RepairEntry& entry : imported.repair->entries)
    rows.push_back({"changed", std::string(name_of(entry.step)), as_int(entry.count),
                    Point3d{short_place(entry.where, size)}, finite(entry.largest)});
  if (imported.repair->amounts) add_amounts(rows, *imported.repair->amounts, size);
  rows.push_back({"volume", "before", {}, {}, in_doubles(imported.repair->volume_before)});
  if (imported.solid) rows.push_back({"volume", "after", {}, {}, in_doubles(imported.repair->volume_after)});
  return rows;
}

Result<RepairOptions> repair_options_of(const Text& words) {
  Result<RepairOptions> options = parse_repair_options(words.content);
  if (!options) return std::move(options).error().about("repairReport");
  return options;
}

Result<ReportRows> report(Context& context, const Text& file, const Text& words) {
  A3D_ASSIGN(const RepairOptions options, repair_options_of(words));
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(const ImportedSolid imported, import_solid(path, nullptr, options, context.monitor()));
  if (!imported.solid)
    context.diagnostics.report("repairReport: " + imported.text_about(file.content), {},
                               Diagnostics::About::unreadable);
  return ReportRows(rows_of(imported));
}

Result<ReportRows> report_without_options(Context& context, const Text& file) {
  return report(context, file, {});
}

Result<ReportRows> report_on_bytes(Context& context, const Bytes& bytes, const Text& words) {
  A3D_ASSIGN(const RepairOptions options, repair_options_of(words));
  A3D_ASSIGN(const ImportedSolid imported, solid_of_bytes(context, bytes, nullptr, options));
  if (!imported.solid) context.diagnostics.report_undefined("repairReport: " + imported.text_about(kBytesName));
  return ReportRows(rows_of(imported));
}

Result<ReportRows> report_on_bytes_without_options(Context& context, const Bytes& bytes) {
  return report_on_bytes(context, bytes, {});
}

// A cube without its lid, which has boundary edges and no other defect.
const std::string kOpenBox =
    "(toOFF (mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1)) ((3 2 1 0) (0 1 5 4) (1 2 6 5) "
    "(2 3 7 6) (3 0 4 7)))))";

}  // namespace

void register_repair_reports(OperatorGroup& group) {
  group.add({
      .name = "repairReport",
      .syntax = "repairReport(_ ...)",
      .doc = "The report of an import of an STL, OBJ or OFF file: its defects and changes, one row per kind.",
      .detail =
          "Rows (Phase, What, Count, Where, Amount): `file`: the two counts of a binary STL file whose header "
          "contradicts its size; `found`: the defects of the given triangles; `changed`: the steps of the repair in "
          "order, with the largest distance by which they moved or added anything; `area`: the area of the "
          "triangles, the part outside the solid, and the area added; `distance`: the largest distances of these "
          "from the solid and from the triangles; `volume`: before, if the triangles were closed, and after. Where "
          "is the place of the first defect or change. No rows for a valid solid; none, with a diagnostic, for a "
          "file that cannot be read. Options as for importSTL. Bytes are the content of such a file.",
      .is_pure = false,
      .reads_files = true,
      .overloads = {table<&report_without_options>({"Phase", "What", "Count", "Where", "Amount"}, "file"),
                    table<&report>({"Phase", "What", "Count", "Where", "Amount"}, "file", "options"),
                    without_files(
                        table<&report_on_bytes_without_options>({"Phase", "What", "Count", "Where", "Amount"}, "bytes"),
                        Cost::arrangement),
                    without_files(
                        table<&report_on_bytes>({"Phase", "What", "Count", "Where", "Amount"}, "bytes", "options"),
                        Cost::arrangement)},
      .examples = {{{"(text undefined)"}, "0", "(count _)"},
                   {{"'no such file.stl'"}, "0", "(count _)"},
                   {{"(toSTL " + kUnitCube + ")"}, "0", "(count _)"},
                   {{kOpenBox, "'strict'"}, "1", "(count _)"}},
      .errors = {{{"5"}, "repairReport: expected (text), (text text), (bytes) or (bytes text), got (int)"}},
  });
}

}  // namespace algebra3d
