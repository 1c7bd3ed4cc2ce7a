#pragma once

#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"

namespace queries {

/// Registers every operator over streams, relations and functions. `registry` outlives all use of them.
[[gnu::cold]] void register_stream_operators(algebra3d::Registry& registry);

/// Commands that create the objects of the examples on stored relations: the relation Boxes with the attributes No: int
/// and B: rect3, and the index Boxes_B on it.
std::vector<std::string> example_objects();

// The families, one file each. A description runs once, so it is compiled for size: `cold` halves the time of the
// compiler and leaves the operators as they are.
[[gnu::cold]] void register_feeding(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_selection(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_attributes(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_extending(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_extending_streams(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_ordering(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_grouping(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_nesting(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_extracting(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_extremes(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_folding(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_joins(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_equi_joins(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_outer_join(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_merging(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_elements(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_using(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_collections(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_ids(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_changes(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_updates(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_indexes(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_spatial_join(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_spatial_self_join(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_nearest_joins(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_points_inside(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_ordered_indexes(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_language_notes(algebra3d::Registry& registry);
[[gnu::cold]] void register_csv_import(algebra3d::OperatorGroup& group);
[[gnu::cold]] void register_json_import(algebra3d::OperatorGroup& group);

}  // namespace queries
