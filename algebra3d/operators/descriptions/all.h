#pragma once

#include "algebra3d/operators/registry/registry.h"

namespace algebra3d {

/// A registry with every type and every operator over values.
Registry make_registry();

// The families, one file each. A description runs once, so it is compiled for size: `cold` halves the time of the
// compiler and leaves the operators as they are.
[[gnu::cold]] void register_arithmetic(OperatorGroup& group);
[[gnu::cold]] void register_numbers(OperatorGroup& group);
[[gnu::cold]] void register_mathematics(OperatorGroup& group);
[[gnu::cold]] void register_comparison(OperatorGroup& group);
[[gnu::cold]] void register_logic(OperatorGroup& group);
[[gnu::cold]] void register_strings(OperatorGroup& group);
[[gnu::cold]] void register_points(OperatorGroup& group);
[[gnu::cold]] void register_boxes(OperatorGroup& group);
[[gnu::cold]] void register_information(OperatorGroup& group);
[[gnu::cold]] void register_measure(OperatorGroup& group);
[[gnu::cold]] void register_inertia(OperatorGroup& group);
[[gnu::cold]] void register_creation(OperatorGroup& group);
[[gnu::cold]] void register_transformation(OperatorGroup& group);
[[gnu::cold]] void register_set_operations(OperatorGroup& group);
[[gnu::cold]] void register_spatial_relations(OperatorGroup& group);
[[gnu::cold]] void register_distances(OperatorGroup& group);
[[gnu::cold]] void register_congruence(OperatorGroup& group);
[[gnu::cold]] void register_enclosing_shapes(OperatorGroup& group);
[[gnu::cold]] void register_hausdorff(OperatorGroup& group);
[[gnu::cold]] void register_contacts(OperatorGroup& group);
[[gnu::cold]] void register_rays(OperatorGroup& group);
[[gnu::cold]] void register_cuts(OperatorGroup& group);
[[gnu::cold]] void register_decomposition(OperatorGroup& group);
[[gnu::cold]] void register_meshes(OperatorGroup& group);
[[gnu::cold]] void register_mesh_building(OperatorGroup& group);
[[gnu::cold]] void register_mesh_attributes(OperatorGroup& group);
[[gnu::cold]] void register_subdivision(OperatorGroup& group);
[[gnu::cold]] void register_mesh_elements(OperatorGroup& group);
[[gnu::cold]] void register_mesh_neighbours(OperatorGroup& group);
[[gnu::cold]] void register_topology(OperatorGroup& group);
[[gnu::cold]] void register_mesh_edits(OperatorGroup& group);
[[gnu::cold]] void register_simplification(OperatorGroup& group);
[[gnu::cold]] void register_imports(OperatorGroup& group);
[[gnu::cold]] void register_exports(OperatorGroup& group);
[[gnu::cold]] void register_rounding(OperatorGroup& group);
[[gnu::cold]] void register_regions(OperatorGroup& group);
[[gnu::cold]] void register_space_time(OperatorGroup& group);
[[gnu::cold]] void register_region_texts(OperatorGroup& group);
[[gnu::cold]] void register_json_members(OperatorGroup& group);
[[gnu::cold]] void register_time(OperatorGroup& group);
[[gnu::cold]] void register_moving_regions(OperatorGroup& group);
[[gnu::cold]] void register_aggregates(OperatorGroup& group);
[[gnu::cold]] void register_set_aggregates(OperatorGroup& group);
[[gnu::cold]] void register_make_regions(OperatorGroup& group);
[[gnu::cold]] void register_sequences(OperatorGroup& group);
[[gnu::cold]] void register_repair_reports(OperatorGroup& group);
[[gnu::cold]] void register_geojson_features(OperatorGroup& group);
[[gnu::cold]] void register_directories(OperatorGroup& group);
[[gnu::cold]] void register_mesh_bytes(OperatorGroup& group);
[[gnu::cold]] void register_well_known_binary(OperatorGroup& group);

}  // namespace algebra3d
