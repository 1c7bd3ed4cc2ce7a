#include "queries/importer/import_command.h"

#include <cmath>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "algebra3d/base/number_text.h"

namespace queries {
namespace {

/// A number that is not negative, as in the options of importSTL.
const CLI::Validator kAmount(
    [](const std::string& text) {
      const std::optional<double> number = algebra3d::parse_real(text);
      const bool is_amount = number && std::isfinite(*number) && *number >= 0;
      return is_amount ? std::string() : "'" + text + "' is no number from 0 on, without a unit";
    },
    "");

/// A part of 1, as in the options of importSTL.
const CLI::Validator kPart(
    [](const std::string& text) {
      const std::optional<double> number = algebra3d::parse_real(text);
      const bool is_part = number && *number >= 0 && *number <= 1;
      return is_part ? std::string() : "'" + text + "' is no number from 0 to 1";
    },
    "");

/// A flag that is given once, and without a value.
void add_plain_flag(CLI::App& app, const std::string& name, bool& is_set, const std::string& meaning) {
  app.add_flag(name, is_set, meaning)->disable_flag_override()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

}  // namespace

void add_repair_options(CLI::App& app, algebra3d::RepairOptions& repair) {
  CLI::Option_group* group = app.add_option_group("Repair", "What may be done to files that are no valid solids");
  add_plain_flag(*group, "--strict", repair.is_strict, "Nothing: such a file gives no solid, but its defects");
  group
      ->add_option("--cracks", repair.crack_tolerance,
                   "Vertices on open edges that are closer than this are joined (default: 1e-4 of the diagonal)")
      ->type_name("LENGTH")
      ->check(kAmount);
  group
      ->add_option("--largest-hole", repair.largest_hole,
                   "Diameter of the largest hole that is closed (default: all are)")
      ->type_name("LENGTH")
      ->check(kAmount);
  add_plain_flag(*group, "!--drop-cavities", repair.keeps_cavities, "Fill cavities");
  group->add_option("--smallest-shell", repair.smallest_shell, "Leave out bodies and cavities with less volume")
      ->type_name("VOLUME")
      ->check(kAmount);
  group
      ->add_option("--most-dropped", repair.most_dropped,
                   "No solid where a larger part of the area seen would be left out of it")
      ->type_name("PART")
      ->check(kPart)
      ->capture_default_str();
  group
      ->add_option("--work", repair.work_limit,
                   "Give a file up after so many million pairs of triangles that are near each other")
      ->type_name("MILLIONS")
      ->check(kAmount)
      ->capture_default_str();
}

CLI::App* add_import_command(CLI::App& app, ImportOptions& options) {
  CLI::App* import = app.add_subcommand("import", "Import folders of STL, OBJ and OFF files into a relation of solids");
  import->add_option("--db", options.database, "Database file; made if it is not there")->type_name("FILE")->required();
  import
      ->add_option(
          "--relation", options.relation,
          "Relation (Name: string, File: text, Solid: volume3d, Status: text, and numbers about the repair); made if "
          "it is not there")
      ->type_name("NAME")
      ->required();
  import
      ->add_option(
          "PATH", options.paths,
          "Files, folders (all *.stl, *.obj and *.off below them) and patterns in quotes, such as 'parts/*.stl'")
      ->required();
  import->add_option("--jobs", options.jobs, "Threads that load files (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  add_plain_flag(*import, "--drop-gone", options.drops_gone,
                 "Drop the tuples of files that are gone: those below the given folders, or that a given pattern fits");
  add_plain_flag(*import, "--quiet", options.quiet, "Neither progress nor summary");
  import
      ->add_option("--batch-seconds", options.batch_seconds,
                   "Whole files are committed together, at the latest after this time")
      ->check(kAmount)
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  import->add_option("--batch-megabytes", options.batch_megabytes, "or after this much data")
      ->check(kAmount)
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  add_repair_options(*import, options.repair);
  import->footer(
      "Files of other endings are not looked at; the summary counts them.\n"
      "A file that cannot be made a solid is taken in with an undefined Solid and the reason in Status.\n"
      "Files imported before are passed over if they have not changed, so an interrupted import is completed by\n"
      "running it again. With other repair options they are imported again, and replace what they gave before.\n"
      "Exit status: 0 all files were taken in, 1 the import failed, 2 wrong usage, 130 interrupted.");
  return import;
}

}  // namespace queries
