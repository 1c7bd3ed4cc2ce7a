#include "queries/shell/detail/result_format.h"

#include <unistd.h>

#include <fmt/format.h>

#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/exchange/csv_presenter.h"
#include "queries/exchange/json_presenter.h"
#include "queries/shell/detail/presenters.h"
#include "queries/shell/detail/screen.h"
#include "queries/shell/detail/table.h"

namespace queries {
namespace {

// Where a folder is named, it is meant.
ExchangeOptions exchange_options(const ResultFormat& format) {
  using Geometry = ExchangeOptions::Geometry;
  ExchangeOptions options = format.exchange;
  options.has_header = !format.omits_header;
  const bool is_file = format.geometry == "file" || (format.geometry.empty() && !options.folder.empty());
  options.geometry = is_file ? Geometry::file : format.geometry == "list" ? Geometry::list : Geometry::summary;
  return options;
}

/// The endings of mesh files, without their points.
std::vector<std::string> mesh_endings() {
  std::vector<std::string> endings;
  for (const mesh_formats::MeshFormat& format : mesh_formats::known_mesh_formats())
    for (const std::string_view ending : format.endings) endings.emplace_back(ending.substr(1));
  return endings;
}

// A pipe or a file is as wide as it needs to be.
std::size_t table_width() {
  return isatty(STDOUT_FILENO) != 0 ? screen_size().columns : kNoLimit;
}

std::unique_ptr<Presenter> make_presenter(const std::string& name, ExchangeValues& values, std::ostream& out) {
  using Layout = JsonPresenter::Layout;
  if (name == "json") return std::make_unique<JsonPresenter>(out, values, Layout::document);
  if (name == "jsonl") return std::make_unique<JsonPresenter>(out, values, Layout::lines);
  if (name == "csv") return std::make_unique<CsvPresenter>(out, values);
  const bool is_table = name == "table" || (name == "auto" && isatty(STDOUT_FILENO) != 0);
  if (is_table) return std::make_unique<TablePresenter>(out, table_width);
  return std::make_unique<ListPresenter>(out);
}

}  // namespace

void add_format_options(CLI::App& app, ResultFormat& format) {
  app.add_option("--format", format.name,
                 "Results as nested lists, tables, JSON, JSON lines or CSV (default: tables on a terminal, else lists)")
      ->check(CLI::IsMember({"auto", "list", "table", "json", "jsonl", "csv"}))
      ->type_name("NAME");
  app.add_option(
         "--geometry-dir", format.exchange.folder,
         "In JSON and CSV: write each solid, surface and mesh as a mesh file into this folder, and show its name")
      ->type_name("DIR");
  app.add_option("--geometry", format.geometry,
                 "In JSON and CSV, geometry as summary (counts and box), list (all faces) or file (see "
                 "--geometry-dir); default: summary")
      ->check(CLI::IsMember({"summary", "list", "file"}))
      ->type_name("FORM");
  app.add_option("--mesh-format", format.exchange.mesh_ending,
                 fmt::format("Format of these files: {}", fmt::join(mesh_endings(), ", ")))
      ->check(CLI::IsMember(mesh_endings()))
      ->capture_default_str()
      ->type_name("NAME");
  app.add_flag("--round-fractions", format.exchange.rounds_fractions,
               "In JSON and CSV: coordinates such as 1/3 as the nearest number, not as the text \"1/3\"");
  app.add_flag("--no-header", format.omits_header, "In CSV: no line with the names of the attributes");
}

void check_format_options(const ResultFormat& format) {
  if (format.geometry == "file" && format.exchange.folder.empty())
    throw CLI::ValidationError("--geometry file: name the folder of the files with --geometry-dir DIR");
}

FormattedResults::FormattedResults(const ResultFormat& format, std::ostream& out)
    : values_(exchange_options(format)), presenter_(make_presenter(format.name, values_, out)) {}

}  // namespace queries
