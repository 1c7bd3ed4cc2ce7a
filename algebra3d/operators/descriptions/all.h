#pragma once

#include "algebra3d/operators/registry/registry.h"

namespace algebra3d {

/// A registry with every type and every operator over values.
Registry make_registry();

// The families, one file each. A description runs once, so it is compiled for size: `cold` halves the time of the
// compiler and leaves the operators as they are.
[[gnu::cold]] void register_arithmetic(Registry& registry);
[[gnu::cold]] void register_numbers(Registry& registry);
[[gnu::cold]] void register_mathematics(Registry& registry);
[[gnu::cold]] void register_comparison(Registry& registry);
[[gnu::cold]] void register_logic(Registry& registry);
[[gnu::cold]] void register_strings(Registry& registry);
[[gnu::cold]] void register_points(Registry& registry);
[[gnu::cold]] void register_boxes(Registry& registry);
[[gnu::cold]] void register_information(Registry& registry);
[[gnu::cold]] void register_measure(Registry& registry);
[[gnu::cold]] void register_inertia(Registry& registry);
[[gnu::cold]] void register_creation(Registry& registry);
[[gnu::cold]] void register_transformation(Registry& registry);
[[gnu::cold]] void register_set_operations(Registry& registry);
[[gnu::cold]] void register_spatial_relations(Registry& registry);
[[gnu::cold]] void register_distances(Registry& registry);
[[gnu::cold]] void register_congruence(Registry& registry);
[[gnu::cold]] void register_enclosing_shapes(Registry& registry);
[[gnu::cold]] void register_hausdorff(Registry& registry);
[[gnu::cold]] void register_contacts(Registry& registry);
[[gnu::cold]] void register_rays(Registry& registry);
[[gnu::cold]] void register_cuts(Registry& registry);
[[gnu::cold]] void register_decomposition(Registry& registry);
[[gnu::cold]] void register_meshes(Registry& registry);
[[gnu::cold]] void register_mesh_building(Registry& registry);
[[gnu::cold]] void register_mesh_attributes(Registry& registry);
[[gnu::cold]] void register_subdivision(Registry& registry);
[[gnu::cold]] void register_mesh_elements(Registry& registry);
[[gnu::cold]] void register_mesh_neighbours(Registry& registry);
[[gnu::cold]] void register_topology(Registry& registry);
[[gnu::cold]] void register_mesh_edits(Registry& registry);
[[gnu::cold]] void register_simplification(Registry& registry);
[[gnu::cold]] void register_imports(Registry& registry);
[[gnu::cold]] void register_exports(Registry& registry);
[[gnu::cold]] void register_rounding(Registry& registry);
[[gnu::cold]] void register_regions(Registry& registry);
[[gnu::cold]] void register_space_time(Registry& registry);
[[gnu::cold]] void register_region_texts(Registry& registry);
[[gnu::cold]] void register_json_members(Registry& registry);
[[gnu::cold]] void register_time(Registry& registry);
[[gnu::cold]] void register_moving_regions(Registry& registry);
[[gnu::cold]] void register_aggregates(Registry& registry);
[[gnu::cold]] void register_set_aggregates(Registry& registry);
[[gnu::cold]] void register_make_regions(Registry& registry);
[[gnu::cold]] void register_sequences(Registry& registry);
[[gnu::cold]] void register_repair_reports(Registry& registry);
[[gnu::cold]] void register_geojson_features(Registry& registry);
[[gnu::cold]] void register_directories(Registry& registry);
[[gnu::cold]] void register_mesh_bytes(Registry& registry);
[[gnu::cold]] void register_well_known_binary(Registry& registry);

}  // namespace algebra3d
