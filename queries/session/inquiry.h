#pragma once

#include <filesystem>

#include "algebra3d/registry/registry.h"
#include "queries/language/command.h"
#include "queries/store/store.h"

namespace queries {

/// The result list of a `list` command, `(inquiry (what (...)))`. `store` is null while no database is open; then
/// `objects` must not be asked for.
algebra3d::Result<NestedList> inquire(Inquiry::Subject subject, const algebra3d::Registry& registry, Store* store,
                                      const std::filesystem::path& folder);

}  // namespace queries
