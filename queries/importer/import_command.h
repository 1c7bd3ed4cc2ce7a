#pragma once

#include "queries/importer/import_options.h"
#include "queries/importer/importer.h"

namespace CLI {
class App;
}

namespace queries {

/// Adds the subcommand `import` to a command line; parsing fills `options`, which outlive `app`.
CLI::App* add_import_command(CLI::App& app, ImportOptions& options);

/// Adds the options of a repair to a command line; parsing fills `repair`, which outlives `app`.
void add_repair_options(CLI::App& app, algebra3d::RepairOptions& repair);

}  // namespace queries
