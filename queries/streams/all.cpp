#include "queries/streams/all.h"
#include "algebra3d/operators/registry/operator.h"

namespace queries {

void register_stream_operators(algebra3d::Registry& registry) {
  registry.begin_family(
      {"streams", "Relations as streams and back; some of the elements of a stream.", algebra3d::Cost::linear});
  registry.add("feed consume tconsume count", register_feeding);
  registry.add("filter head tail nth some exist", register_selection);
  registry.begin_family(
      {"attributes", "Dropping, adding, renaming and computing attributes.", algebra3d::Cost::linear});
  registry.add("attr project feedproject remove rename renameAttr", register_attributes);
  registry.add("extend projectextend replaceAttr addcounter", register_extending);
  registry.add("extendstream projectextendstream", register_extending_streams);
  registry.begin_family({"order", "Sorting and removal of duplicates.", algebra3d::Cost::sorting});
  registry.add("sortby sort rdup rduph krdup krduph", register_ordering);
  registry.begin_family({"comparison", "", algebra3d::Cost::linear});
  registry.add("getMinVal getMaxVal", register_extremes);
  registry.begin_family({"groups", "Grouping, folds, and the first tuple.", algebra3d::Cost::linear});
  registry.add("groupby", register_grouping);
  registry.add("nest unnest afeed aconsume", register_nesting);
  registry.add("extract", register_extracting);
  registry.add("extend_aggr aggregateB", register_folding);
  registry.begin_family({"joins", "Joins of two streams.", algebra3d::Cost::pairs});
  registry.add("product symmjoin loopjoin loopsel", register_joins);
  registry.add("hashjoin itHashJoin mergejoin sortmergejoin smouterjoin", register_equi_joins);
  registry.add("symmouterjoin", register_outer_join);
  registry.begin_family({"sorted streams", "Set operations on sorted streams.", algebra3d::Cost::linear});
  registry.add("concat mergesec mergediff mergeunion", register_merging);
  registry.begin_family({"streams of values", "Conversion between values and tuples, and functions of elements.",
                         algebra3d::Cost::linear});
  registry.add("transformstream namedtransformstream projecttransformstream", register_elements);
  registry.add("use printstream", register_using);
  registry.add("collect_set collect_multiset collect_vector", register_collections);
  registry.begin_family(
      {"changes of relations", "Inserting, deleting and changing tuples, and their ids.", algebra3d::Cost::linear});
  registry.add("tupleid addid gettuples", register_ids);
  registry.add("inserttuple insert deletesearch deletedirect deletebyid", register_changes);
  registry.add("updatedirect updatebyid", register_updates);
  registry.begin_family(
      {"indexes", "Spatial and ordered indexes of relations, and searches in them.", algebra3d::Cost::linear});
  registry.add("creatertree bulkloadrtree windowintersectsS nodes windowintersects distancescan", register_indexes);
  registry.add("itSpatialJoin spatialJoin distanceJoin", register_spatial_join);
  registry.add("spatialSelfJoin distanceSelfJoin", register_spatial_self_join);
  registry.add("knnJoin knnSelfJoin closestPair closestSelfPair", register_nearest_joins);
  registry.add("pointsInside", register_points_inside);
  registry.add("createbtree exactmatch range leftrange rightrange", register_ordered_indexes);
  registry.begin_family({"tables from files", "Relations from CSV and JSON files.", algebra3d::Cost::file});
  registry.add("importCSV", register_csv_import);
  registry.add("importJSON", register_json_import);
  register_language_notes(registry);
}

std::vector<std::string> example_objects() {
  return {
      "let Boxes = [const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))]",
      "let Boxes_B = Boxes creatertree[B]"};
}

}  // namespace queries
