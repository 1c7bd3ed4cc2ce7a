#pragma once

#include "queries/transfer/transfer_options.h"

namespace CLI {
class App;
}

namespace queries {

/// Adds the subcommands `push` and `pull` to a command line; parsing fills `options`, which outlive `app`.
CLI::App* add_push_command(CLI::App& app, TransferOptions& options);
CLI::App* add_pull_command(CLI::App& app, TransferOptions& options);

}  // namespace queries
