#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "algebra3d/operators/registry/registry.h"
#include "queries/server/server_options.h"

namespace queries {

/// Serves a database over HTTP (docs/http-api.md) until `*stop` is set. `ready` is called once with the address of the
/// server, when it answers; `note` receives remarks for people. The database is created if it does not exist, unless
/// read-only. Errors: wrong_usage for a foreign address without a token, an unusable token file; those of opening the
/// database; io_error if the address cannot be listened on.
algebra3d::Status serve(const ServerOptions& options, const algebra3d::Registry& registry,
                        const std::atomic<bool>& stop, const std::function<void(const std::string& url)>& ready,
                        const std::function<void(const std::string& text)>& note);

}  // namespace queries
