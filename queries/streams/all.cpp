#include "queries/streams/all.h"
#include "algebra3d/operators/registry/operator.h"

namespace queries {

void register_stream_operators(algebra3d::Registry& registry) {
  registry.begin_family(
      {"streams", "Relations as streams and back; some of the elements of a stream.", algebra3d::Cost::linear});
  register_feeding(registry);
  register_selection(registry);
  registry.begin_family(
      {"attributes", "Dropping, adding, renaming and computing attributes.", algebra3d::Cost::linear});
  register_attributes(registry);
  register_extending(registry);
  register_extending_streams(registry);
  registry.begin_family({"order", "Sorting and removal of duplicates.", algebra3d::Cost::sorting});
  register_ordering(registry);
  registry.begin_family({"comparison", "", algebra3d::Cost::linear});
  register_extremes(registry);
  registry.begin_family({"groups", "Grouping, folds, and the first tuple.", algebra3d::Cost::linear});
  register_grouping(registry);
  register_nesting(registry);
  register_extracting(registry);
  register_folding(registry);
  registry.begin_family({"joins", "Joins of two streams.", algebra3d::Cost::pairs});
  register_joins(registry);
  register_equi_joins(registry);
  register_outer_join(registry);
  registry.begin_family({"sorted streams", "Set operations on sorted streams.", algebra3d::Cost::linear});
  register_merging(registry);
  registry.begin_family({"streams of values", "Conversion between values and tuples, and functions of elements.",
                         algebra3d::Cost::linear});
  register_elements(registry);
  register_using(registry);
  register_collections(registry);
  registry.begin_family(
      {"changes of relations", "Inserting, deleting and changing tuples, and their ids.", algebra3d::Cost::linear});
  register_ids(registry);
  register_changes(registry);
  register_updates(registry);
  registry.begin_family(
      {"indexes", "Spatial and ordered indexes of relations, and searches in them.", algebra3d::Cost::linear});
  register_indexes(registry);
  register_spatial_join(registry);
  register_spatial_self_join(registry);
  register_nearest_joins(registry);
  register_points_inside(registry);
  register_ordered_indexes(registry);
  registry.begin_family({"tables from files", "Relations from CSV and JSON files.", algebra3d::Cost::file});
  register_csv_import(registry);
  register_json_import(registry);
  register_language_notes(registry);
}

std::vector<std::string> example_objects() {
  return {
      "let Boxes = [const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))]",
      "let Boxes_B = Boxes creatertree[B]"};
}

}  // namespace queries
