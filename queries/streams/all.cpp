#include "queries/streams/all.h"

namespace queries {

void register_stream_operators(algebra3d::Registry& registry) {
  register_feeding(registry);
  register_selection(registry);
  register_attributes(registry);
  register_extending(registry);
  register_extending_streams(registry);
  register_ordering(registry);
  register_grouping(registry);
  register_aggregates(registry);
  register_set_aggregates(registry);
  register_folding(registry);
  register_joins(registry);
  register_equi_joins(registry);
  register_outer_join(registry);
  register_merging(registry);
  register_elements(registry);
  register_using(registry);
  register_collections(registry);
  register_directories(registry);
  register_ids(registry);
  register_changes(registry);
  register_updates(registry);
  register_indexes(registry);
  register_spatial_join(registry);
  register_ordered_indexes(registry);
  register_repair_reports(registry);
  register_geojson_features(registry);
  register_make_regions(registry);
}

std::vector<std::string> example_objects() {
  return {
      "let Boxes = [const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))]",
      "let Boxes_B = Boxes creatertree[B]"};
}

}  // namespace queries
