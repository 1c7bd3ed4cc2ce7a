#pragma once

#include <filesystem>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/command.h"
#include "queries/store/store.h"

namespace queries {

/// The name of the only algebra (module of operators and types); SECONDO has many.
inline constexpr std::string_view kAlgebra = "Algebra3D";

/// The result list of a `list` command, `(inquiry (what (...)))`. `store` is null while no database is open; then
/// `objects` must not be asked for.
algebra3d::Result<NestedList> inquire(Inquiry::Subject subject, const algebra3d::Registry& registry, Store* store,
                                      const std::filesystem::path& folder);

}  // namespace queries
