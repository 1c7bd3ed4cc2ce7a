// repairReport: what was found in a mesh file, and what was changed, as tuples.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/import_solid.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Defect;
using algebra3d::ImportedSolid;
using algebra3d::Point3d;
using algebra3d::RepairOptions;

template <typename T>
Value value_or_undefined(const std::optional<T>& value) {
  return value ? Value::of<T>(*value) : Value(algebra3d::TypeOf<T>::type());
}

struct ReportRow {
  std::string phase, what;
  std::optional<std::int64_t> count;
  std::optional<Point3d> where;
  std::optional<double> amount;
};

TypeExpr report_type() {
  return TypeExpr::tuple({{"Phase", TypeExpr("string")},
                          {"What", TypeExpr("string")},
                          {"Count", TypeExpr("int")},
                          {"Where", TypeExpr("point3d")},
                          {"Amount", TypeExpr("real")}});
}

TuplePtr tuple_of(const ReportRow& row) {
  return std::make_shared<const Tuple>(
      Tuple{{Value::of<std::string>(row.phase), Value::of<std::string>(row.what), value_or_undefined(row.count),
             value_or_undefined(row.where), value_or_undefined(row.amount)}});
}

std::int64_t as_int(std::uint64_t count) {
  return static_cast<std::int64_t>(count);
}

std::optional<double> in_doubles(const std::optional<algebra3d::Amount>& amount) {
  return amount ? amount->in_doubles() : std::nullopt;
}

std::optional<double> finite(double length) {
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

void add_amounts(std::vector<ReportRow>& rows, const algebra3d::RepairAmounts& amounts, double size) {
  const auto place = [&](const algebra3d::SurfaceAmount& amount) -> std::optional<Point3d> {
    if (amount.facet_count == 0) return {};
    return Point3d{algebra3d::short_place(amount.where, size)};
  };
  rows.push_back({"area", "seen", {}, {}, amounts.area_seen.in_doubles()});
  for (const auto& [name, amount] : {std::pair("left out", amounts.dropped), std::pair("added", amounts.added)})
    rows.push_back({"area", name, as_int(amount.facet_count), {}, amount.area.in_doubles()});
  for (const auto& [name, amount] : {std::pair("left out", amounts.dropped), std::pair("added", amounts.added)})
    rows.push_back({"distance", name, {}, place(amount), finite(amount.distance)});
}

void add_wrong_count(std::vector<ReportRow>& rows, const stl::WrongCount& wrong) {
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
  std::optional<Defect> previous;
  for (const algebra3d::DefectExample& example : imported.found.validity.examples) {
    if (example.kind == previous) continue;
    previous = example.kind;
    rows.push_back({"found",
                    std::string(name_of(example.kind)),
                    as_int(imported.found.validity.count(example.kind)),
                    Point3d{algebra3d::short_place(example.where, size)},
                    {}});
  }
  if (!imported.repair) return rows;
  for (const algebra3d::RepairEntry& entry : imported.repair->entries)
    rows.push_back({"changed", std::string(name_of(entry.step)), as_int(entry.count),
                    Point3d{algebra3d::short_place(entry.where, size)}, finite(entry.largest)});
  if (imported.repair->amounts) add_amounts(rows, *imported.repair->amounts, size);
  rows.push_back({"volume", "before", {}, {}, in_doubles(imported.repair->volume_before)});
  if (imported.solid) rows.push_back({"volume", "after", {}, {}, in_doubles(imported.repair->volume_after)});
  return rows;
}

/// The reader's messages name the file; those about the solid do not.
std::string reason_with_file(const ImportedSolid& imported, const std::string& name,
                             const std::filesystem::path& path) {
  return imported.status.starts_with(path.string()) ? imported.status : name + ": " + imported.status;
}

Result<Plan> map_repair_report(std::span<const ArgumentType> arguments) {
  const MappingCheck check("repairReport", arguments);
  RETURN_IF_ERROR(check.argument_count(1, 2));
  for (std::size_t place = 0; place < check.count(); ++place) RETURN_IF_ERROR(check.characters(place));
  return Plan{
      TypeExpr::stream(report_type()), [](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
        std::vector<ReportRow> rows;
        const bool is_defined = std::ranges::all_of(given, [](const Datum& word) { return word.value().is_defined(); });
        if (is_defined) {
          const auto text = [&](std::size_t i) { return algebra3d::characters_of(given[i].value()); };
          const Result<RepairOptions> options =
              algebra3d::parse_repair_options(given.size() == 2 ? text(1) : std::string());
          if (!options) return Error{options.error().code, "repairReport: {}", options.error().message};
          const std::filesystem::path path = context.resolve(text(0));
          ASSIGN_OR_RETURN(const ImportedSolid imported, import_solid(path, std::nullopt, *options, context.monitor()));
          rows = rows_of(imported);
          if (!imported.solid)
            context.diagnostics.report("repairReport: " + reason_with_file(imported, text(0), path), {},
                                       algebra3d::Diagnostics::About::unreadable);
        }
        return Datum{make_stream([rows, next = std::size_t{0}]() mutable -> Result<TuplePtr> {
          return next < rows.size() ? tuple_of(rows[next++]) : TuplePtr();
        })};
      }};
}

}  // namespace

void register_repair_reports(algebra3d::Registry& registry) {
  registry.add({
      .name = "repairReport",
      .syntax = "repairReport(_ ...)",
      .doc = "What an import finds in an STL, OBJ or OFF file and what it changes, one tuple for each kind.",
      .detail =
          "Tuples (Phase, What, Count, Where, Amount): `file` are the two counts of a binary STL file whose header "
          "contradicts its size, `found` the defects of the facets as given, `changed` the "
          "steps of the repair in their order, with the largest distance by which they moved or added anything; "
          "`area` says how "
          "much the facets have, how much of it lies outside the solid, and how much was added to it, `distance` how "
          "far "
          "that is from the solid and from the facets at most; `volume` "
          "says how much there was before, if the facets were closed, and after. Where is the place of the first one. "
          "None for a file that is a solid; none, with a diagnostic, for one that cannot be read. Options as those of "
          "importSTL.",
      .stream = stream_operator(map_repair_report),
      .signatures = {"(text) -> stream(tuple)", "(text text) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"repairReport([const text value undefined]) count", "0"},
                   {"repairReport('no such file.stl') count", "0"}},
      .errors = {{"query repairReport(5) count", "repairReport: expected text, got int"}},
  });
}

}  // namespace queries
