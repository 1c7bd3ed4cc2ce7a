#include "queries/streams/all.h"

namespace queries {

void register_stream_operators(algebra3d::Registry& registry) {
  registry.begin_family("streams");
  register_feeding(registry);
  register_selection(registry);
  registry.begin_family("attributes");
  register_attributes(registry);
  register_extending(registry);
  register_extending_streams(registry);
  registry.begin_family("order");
  register_ordering(registry);
  registry.begin_family("groups and aggregates");
  register_grouping(registry);
  register_aggregates(registry);
  register_set_aggregates(registry);
  register_extremes(registry);
  register_folding(registry);
  registry.begin_family("joins");
  register_joins(registry);
  register_equi_joins(registry);
  register_outer_join(registry);
  registry.begin_family("sorted streams");
  register_merging(registry);
  registry.begin_family("streams of values");
  register_elements(registry);
  register_using(registry);
  register_collections(registry);
  registry.begin_family("files and folders");
  register_directories(registry);
  registry.begin_family("changes of relations");
  register_ids(registry);
  register_changes(registry);
  register_updates(registry);
  registry.begin_family("indexes");
  register_indexes(registry);
  register_spatial_join(registry);
  register_ordered_indexes(registry);
  registry.begin_family("mesh files");
  register_repair_reports(registry);
  registry.begin_family("region files");
  register_geojson_features(registry);
  register_csv_import(registry);
  register_json_import(registry);
  register_make_regions(registry);
}

std::vector<std::string> example_objects() {
  return {
      "let Boxes = [const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))]",
      "let Boxes_B = Boxes creatertree[B]"};
}

}  // namespace queries
