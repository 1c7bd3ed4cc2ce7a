#include "queries/importer/import_command.h"

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/number_text.h"
#include "mesh_formats/mesh_formats.h"

namespace queries {
namespace {

/// A number that is not negative, as in the options of importSTL.
const CLI::Validator kAmount(
    [](const std::string& text) {
      const std::optional<double> number = algebra3d::parse_real(text);
      const bool is_amount = number && std::isfinite(*number) && *number >= 0;
      return is_amount ? std::string() : "'" + text + "' is not a number of at least 0 without a unit";
    },
    "");

/// A part of 1, as in the options of importSTL.
const CLI::Validator kPart(
    [](const std::string& text) {
      const std::optional<double> number = algebra3d::parse_real(text);
      const bool is_part = number && *number >= 0 && *number <= 1;
      return is_part ? std::string() : "'" + text + "' is not a number from 0 to 1";
    },
    "");

/// A flag that is given once, and without a value.
void add_plain_flag(CLI::App& app, const std::string& name, bool& is_set, const std::string& meaning) {
  app.add_flag(name, is_set, meaning)->disable_flag_override()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

}  // namespace

void add_repair_options(CLI::App& app, algebra3d::RepairOptions& repair) {
  CLI::Option_group* group = app.add_option_group("Repair", "Repair of files that are not valid solids");
  add_plain_flag(*group, "--strict", repair.is_strict,
                 "No repair: such a file has no solid, but its defects are reported");
  group
      ->add_option("--gaps,--cracks", repair.gap_tolerance,
                   "Join vertices on open edges that are closer than this (default: 1e-4 of the diagonal)")
      ->type_name("LENGTH")
      ->check(kAmount);
  group->add_option("--largest-hole", repair.largest_hole, "Diameter of the largest hole to close (default: all holes)")
      ->type_name("LENGTH")
      ->check(kAmount);
  add_plain_flag(*group, "!--drop-cavities", repair.keeps_cavities, "Fill cavities");
  group->add_option("--smallest-shell", repair.smallest_shell, "Leave out bodies and cavities with less volume")
      ->type_name("VOLUME")
      ->check(kAmount);
  group
      ->add_option("--most-dropped", repair.most_dropped,
                   "No solid if a larger part of the area seen would be left out")
      ->type_name("PART")
      ->check(kPart)
      ->capture_default_str();
  group
      ->add_option("--most-added", repair.most_added,
                   "No solid if a larger area would be added, as a part of the area seen (default: no limit)")
      ->type_name("PART")
      ->check(kAmount);
  group
      ->add_option("--work", repair.work_limit,
                   "Limit of the work for a file, in million pairs of triangles that are near each other")
      ->type_name("MILLIONS")
      ->check(kAmount)
      ->capture_default_str();
}

CLI::App* add_import_command(CLI::App& app, ImportOptions& options) {
  const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
  CLI::App* import = app.add_subcommand(
      "import", fmt::format("Import folders of {} files into a relation of solids", formats.names("and")));
  import->add_option("--db", options.database, "Database file; created if it does not exist")
      ->type_name("FILE")
      ->required();
  import
      ->add_option("--relation", options.relation,
                   "Relation (Name: string, File: text, Solid: volume3d, Status: text, and measures of the repair); "
                   "created if it does not exist")
      ->type_name("NAME")
      ->required();
  import
      ->add_option("PATH", options.paths,
                   fmt::format("Files, folders (all {} below them) and patterns in quotes, such as 'parts/*.stl'",
                               formats.endings("and", "*")))
      ->required();
  import->add_option("--jobs", options.jobs, "Threads that load files (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  add_plain_flag(*import, "--drop-gone", options.drops_gone,
                 "Delete the tuples of files that no longer exist, if they match the given folders and patterns");
  add_plain_flag(*import, "--quiet", options.quiet, "Show no progress and no summary");
  import
      ->add_option(
          "--file-seconds", options.file_seconds,
          "A file that takes longer than this has no solid; the next import tries it again (default: no limit)")
      ->type_name("SECONDS")
      ->check(kAmount)
      ->check(CLI::Range(0.001, 1e6));
  import->add_option("--batch-seconds", options.batch_seconds, "Commit a batch of files at the latest after this time")
      ->check(kAmount)
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  import->add_option("--batch-megabytes", options.batch_megabytes, "or after this much data")
      ->check(kAmount)
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  add_repair_options(*import, options.repair);
  import->footer(
      "Files with other endings are ignored; the summary counts them.\n"
      "A file without a valid solid is imported with an undefined Solid and the reason in Status.\n"
      "Files imported before are skipped if they have not changed, so an interrupted import is completed by\n"
      "running it again. With other repair options they are imported again and replace their tuples.\n"
      "Exit status: 0 all files were imported, 1 the import failed, 2 wrong usage, 130 interrupted.");
  return import;
}

}  // namespace queries
