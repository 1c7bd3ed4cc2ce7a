#include "queries/streams/all.h"

namespace queries {

void register_stream_operators(algebra3d::Registry& registry) {
  register_feeding(registry);
  register_selection(registry);
  register_attributes(registry);
  register_ordering(registry);
  register_aggregates(registry);
  register_joins(registry);
  register_elements(registry);
  register_changes(registry);
  register_indexes(registry);
}

}  // namespace queries
