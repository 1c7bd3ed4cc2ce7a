#include "queries/importer/import_command.h"

#include <CLI/CLI.hpp>

namespace queries {

CLI::App* add_import_command(CLI::App& app, ImportOptions& options) {
  CLI::App* import = app.add_subcommand("import", "Import folders of STL files into a relation of solids");
  import->add_option("--db", options.database, "Database file; made if it is not there")->type_name("FILE")->required();
  import
      ->add_option("--relation", options.relation,
                   "Relation (Name: string, File: text, Solid: volume3d, Status: text); made if it is not there")
      ->type_name("NAME")
      ->required();
  import
      ->add_option("PATH", options.paths,
                   "Files, folders (all *.stl below them) and patterns in quotes, such as 'parts/*.stl'")
      ->required();
  import->add_option("--jobs", options.jobs, "Threads that load files (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  import->add_flag("--quiet", options.quiet, "Neither progress nor summary");
  import
      ->add_option("--batch-seconds", options.batch_seconds,
                   "Whole files are committed together, at the latest after this time")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  import->add_option("--batch-megabytes", options.batch_megabytes, "or after this much data")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  import->footer(
      "A file that cannot be made a solid is taken in with an undefined Solid and the reason in Status.\n"
      "Files imported before are passed over if they have not changed, so an interrupted import is completed by\n"
      "running it again. Exit status: 0 all files were taken in, 1 the import failed, 2 wrong usage, 130 interrupted.");
  return import;
}

}  // namespace queries
