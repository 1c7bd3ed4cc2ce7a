#pragma once

#include "algebra3d/registry/registry.h"

namespace queries {

/// Registers every operator over streams and relations. `registry` outlives all use of them.
void register_stream_operators(algebra3d::Registry& registry);

// The families, one file each.
void register_feeding(algebra3d::Registry& registry);
void register_selection(algebra3d::Registry& registry);
void register_attributes(algebra3d::Registry& registry);
void register_ordering(algebra3d::Registry& registry);
void register_aggregates(algebra3d::Registry& registry);
void register_joins(algebra3d::Registry& registry);
void register_elements(algebra3d::Registry& registry);
void register_changes(algebra3d::Registry& registry);
void register_indexes(algebra3d::Registry& registry);

}  // namespace queries
