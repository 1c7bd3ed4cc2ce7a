#pragma once

#include <atomic>

#include "algebra3d/operators/registry/registry.h"
#include "queries/server/server_options.h"

namespace CLI {
class App;
}

namespace queries {

/// Adds the subcommand `serve` to a command line; parsing fills `options`, which outlive `app`.
CLI::App* add_serve_command(CLI::App& app, ServerOptions& options);

/// Runs `algebra3d serve` until `stop` is set, and returns its exit status. Says on standard output where it listens,
/// and errors on standard error.
int run_serve(const ServerOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>& stop);

}  // namespace queries
