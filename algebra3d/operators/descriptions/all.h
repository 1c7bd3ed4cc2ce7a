#pragma once

#include "algebra3d/operators/registry/registry.h"

namespace algebra3d {

/// A registry with every type and every operator over values.
Registry make_registry();

// The families, one file each.
void register_arithmetic(Registry& registry);
void register_numbers(Registry& registry);
void register_mathematics(Registry& registry);
void register_comparison(Registry& registry);
void register_logic(Registry& registry);
void register_strings(Registry& registry);
void register_points(Registry& registry);
void register_boxes(Registry& registry);
void register_information(Registry& registry);
void register_measure(Registry& registry);
void register_inertia(Registry& registry);
void register_creation(Registry& registry);
void register_transformation(Registry& registry);
void register_set_operations(Registry& registry);
void register_spatial_relations(Registry& registry);
void register_distances(Registry& registry);
void register_congruence(Registry& registry);
void register_enclosing_shapes(Registry& registry);
void register_hausdorff(Registry& registry);
void register_contacts(Registry& registry);
void register_rays(Registry& registry);
void register_cuts(Registry& registry);
void register_decomposition(Registry& registry);
void register_meshes(Registry& registry);
void register_mesh_building(Registry& registry);
void register_mesh_attributes(Registry& registry);
void register_subdivision(Registry& registry);
void register_mesh_elements(Registry& registry);
void register_mesh_neighbours(Registry& registry);
void register_topology(Registry& registry);
void register_mesh_edits(Registry& registry);
void register_simplification(Registry& registry);
void register_imports(Registry& registry);
void register_exports(Registry& registry);
void register_rounding(Registry& registry);
void register_regions(Registry& registry);
void register_space_time(Registry& registry);
void register_region_texts(Registry& registry);
void register_json_members(Registry& registry);
void register_time(Registry& registry);
void register_moving_regions(Registry& registry);
void register_aggregates(Registry& registry);
void register_set_aggregates(Registry& registry);
void register_make_regions(Registry& registry);
void register_sequences(Registry& registry);
void register_repair_reports(Registry& registry);
void register_geojson_features(Registry& registry);
void register_directories(Registry& registry);

}  // namespace algebra3d
