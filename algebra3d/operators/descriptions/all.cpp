#include "algebra3d/operators/descriptions/all.h"

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/all.h"

namespace algebra3d {

Registry make_registry() {
  Registry registry;
  for (const Type* type : all_types()) registry.add(*type);
  registry.begin_family(
      {"arithmetic", "Sums, differences, products and quotients of numbers, times and texts.", Cost::constant});
  register_arithmetic(registry);
  registry.begin_family(
      {"functions of numbers", "Roots, powers, logarithms, angles, rounding, and numbers as texts.", Cost::constant});
  register_numbers(registry);
  register_mathematics(registry);
  registry.begin_family({"comparison", "Equality and order of values of every type.", Cost::linear});
  register_comparison(registry);
  registry.begin_family({"logic", "Truth values.", Cost::constant});
  register_logic(registry);
  registry.begin_family({"strings and texts", "Searches in strings and texts; bytes as texts.", Cost::linear});
  register_strings(registry);
  registry.begin_family({"points, vectors and planes",
                         "Points, vectors and planes from numbers, and their coordinates.", Cost::constant});
  register_points(registry);
  registry.begin_family({"boxes", "Axis-parallel boxes.", Cost::constant});
  register_boxes(registry);
  registry.begin_family({"facts about values", "Sizes, boxes and emptiness of spatial values.", Cost::constant});
  register_information(registry);
  registry.begin_family(
      {"measures", "Volume, area, centre and inertia of solids, surfaces and regions.", Cost::linear});
  register_measure(registry);
  register_inertia(registry);
  registry.begin_family({"creation of solids", "Cubes, cylinders, cones and spheres.", Cost::linear});
  register_creation(registry);
  registry.begin_family({"transformations", "Translation, rotation, reflection and scaling.", Cost::linear});
  register_transformation(registry);
  registry.begin_family(
      {"set operations", "Unions, intersections, differences and cuts, all exact.", Cost::arrangement});
  register_set_operations(registry);
  register_cuts(registry);
  registry.begin_family({"spatial relations",
                         "Whether and how points, boxes, surfaces, solids and regions meet, all exact.", Cost::linear});
  register_spatial_relations(registry);
  registry.begin_family({"distances", "Distances of points, boxes, surfaces, solids and regions.", Cost::linear});
  register_distances(registry);
  register_hausdorff(registry);
  registry.begin_family(
      {"clashes and contacts", "Where and how much solids and surfaces overlap and touch.", Cost::arrangement});
  register_contacts(registry);
  registry.begin_family(
      {"rays and thickness", "Where rays meet surfaces and solids, and how thick solids are.", Cost::linear});
  register_rays(registry);
  registry.begin_family(
      {"enclosing shapes", "Convex shapes around points, boxes, surfaces and solids.", Cost::sorting});
  register_enclosing_shapes(registry);
  registry.begin_family({"congruence", "Solids that are equal up to a motion.", Cost::linear});
  register_congruence(registry);
  registry.begin_family({"parts of solids", "The parts of a surface or solid.", Cost::linear});
  register_decomposition(registry);
  registry.begin_family({"meshes",
                         "Meshes of polygons: from solids and surfaces and back, built by hand, and their attributes.",
                         Cost::linear});
  register_meshes(registry);
  register_mesh_building(registry);
  register_mesh_attributes(registry);
  registry.begin_family(
      {"subdivision", "Smooth surfaces from meshes, by repeated division of their faces.", Cost::linear});
  register_subdivision(registry);
  registry.begin_family({"mesh elements",
                         "Vertices, edges, half-edges and faces of surfaces, solids and meshes, and their neighbours.",
                         Cost::linear});
  register_mesh_elements(registry);
  register_mesh_neighbours(registry);
  registry.begin_family({"topology", "How the faces of surfaces, solids and meshes hang together.", Cost::linear});
  register_topology(registry);
  registry.begin_family({"edits of meshes", "Edits of single edges, faces and vertices of a mesh.", Cost::linear});
  register_mesh_edits(registry);
  registry.begin_family({"simplification", "Meshes, surfaces and solids with fewer triangles.", Cost::sorting});
  register_simplification(registry);
  registry.begin_family({"mesh files",
                         "Import of solids and surfaces from STL, OBJ and OFF files, with repair and reports.",
                         Cost::file});
  register_imports(registry);
  register_exports(registry);
  register_repair_reports(registry);
  register_mesh_bytes(registry);
  registry.begin_family({"rounding", "Solids with short coordinates.", Cost::arrangement});
  register_rounding(registry);
  registry.begin_family(
      {"regions", "Polygons with holes in the plane, and solids and surfaces made of them.", Cost::sorting});
  register_regions(registry);
  register_space_time(registry);
  registry.begin_family({"region files", "Regions from WKT and GeoJSON, and back.", Cost::linear});
  register_region_texts(registry);
  register_json_members(registry);
  register_geojson_features(registry);
  register_make_regions(registry);
  registry.begin_family(
      {"well-known binary", "Geometries as PostGIS and GDAL exchange them (WKB and EWKB).", Cost::linear});
  register_well_known_binary(registry);
  registry.begin_family({"time", "Instants, durations and intervals.", Cost::constant});
  register_time(registry);
  registry.begin_family({"moving regions", "Regions that move over time.", Cost::linear});
  register_moving_regions(registry);
  registry.begin_family({"aggregates", "One value of many.", Cost::linear});
  register_aggregates(registry);
  register_set_aggregates(registry);
  registry.begin_family({"sequences", "Sequences of numbers.", Cost::linear});
  register_sequences(registry);
  registry.begin_family({"files and folders", "Names of files.", Cost::file});
  register_directories(registry);
  return registry;
}

}  // namespace algebra3d
