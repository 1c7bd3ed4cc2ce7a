#include "algebra3d/operators/descriptions/all.h"

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/all.h"

namespace algebra3d {

Registry make_registry() {
  Registry registry;
  for (const Type* type : all_types()) registry.add(*type);
  registry.begin_family(
      {"arithmetic", "Sums, differences, products and quotients of numbers, times and texts.", Cost::constant});
  registry.add("+ - * / div mod", register_arithmetic);
  registry.begin_family(
      {"functions of numbers", "Roots, powers, logarithms, angles, rounding, and numbers as texts.", Cost::constant});
  registry.add("abs floor ceil round int2real real2int int2bool bool2int num2string str2real str2int tostring totext",
               register_numbers);
  registry.add(
      "sqrt exp ln log logB pow sin cos tan arcsin asin arccos acos arctan atan arctan2 atan2 deg2rad rad2deg const_pi "
      "const_e",
      register_mathematics);
  registry.begin_family({"comparison", "Equality and order of values of every type.", Cost::linear});
  registry.add("= # < <= > >= between isdefined ifthenelse", register_comparison);
  registry.begin_family({"logic", "Truth values.", Cost::constant});
  registry.add("and or not", register_logic);
  registry.begin_family({"strings and texts", "Searches in strings and texts; bytes as texts.", Cost::linear});
  registry.add("startsWith hex2bytes bytes2hex", register_strings);
  registry.begin_family({"points, vectors and planes",
                         "Points, vectors and planes from numbers, and their coordinates.", Cost::constant});
  registry.add("getx gety getz makePoint3D makeVector3D makePlane3D length dot cross", register_points);
  registry.begin_family({"boxes", "Axis-parallel boxes.", Cost::constant});
  registry.add("rectangle3 enlargeRect minD maxD", register_boxes);
  registry.begin_family({"facts about values", "Sizes, boxes and emptiness of spatial values.", Cost::constant});
  registry.add("size isEmpty isempty bbox bbox3d bboxDistance bboxIntersects", register_information);
  registry.begin_family(
      {"measures", "Volume, area, centre and inertia of solids, surfaces and regions.", Cost::linear});
  registry.add("volume volumeExact area centroid", register_measure);
  registry.add("inertia", register_inertia);
  registry.begin_family({"creation of solids", "Cubes, cylinders, cones and spheres.", Cost::linear});
  registry.add("createCube createCylinder createCone createSphere", register_creation);
  registry.begin_family({"transformations", "Translation, rotation, reflection and scaling.", Cost::linear});
  registry.add("rotate mirror translate scale scaleDir", register_transformation);
  registry.begin_family(
      {"set operations", "Unions, intersections, differences and cuts, all exact.", Cost::arrangement});
  registry.add("union intersection minus symmetricDifference", register_set_operations);
  registry.add("split clip section shells", register_cuts);
  registry.begin_family({"spatial relations",
                         "Whether and how points, boxes, surfaces, solids and regions meet, all exact.", Cost::linear});
  registry.add("intersects disjoint touches overlaps inside contains coveredBy covers relation commonPoint",
               register_spatial_relations);
  registry.begin_family({"distances", "Distances of points, boxes, surfaces, solids and regions.", Cost::linear});
  registry.add("distance withinDistance closestPoints", register_distances);
  registry.add("hausdorffDistance", register_hausdorff);
  registry.begin_family(
      {"clashes and contacts", "Where and how much solids and surfaces overlap and touch.", Cost::arrangement});
  registry.add("clash contactArea commonVolume", register_contacts);
  registry.begin_family(
      {"rays and thickness", "Where rays meet surfaces and solids, and how thick solids are.", Cost::linear});
  registry.add("rayHits thickness facetThickness", register_rays);
  registry.begin_family(
      {"enclosing shapes", "Convex shapes around points, boxes, surfaces and solids.", Cost::sorting});
  registry.add("convexHull boundingSphere minimalBox boundingCylinder", register_enclosing_shapes);
  registry.begin_family({"congruence", "Solids that are equal up to a motion.", Cost::linear});
  registry.add("isCongruent congruence", register_congruence);
  registry.begin_family({"parts of solids", "The parts of a surface or solid.", Cost::linear});
  registry.add("components", register_decomposition);
  registry.begin_family({"meshes",
                         "Meshes of polygons: from solids and surfaces and back, built by hand, and their attributes.",
                         Cost::linear});
  registry.add("surface2mesh volume2mesh mesh2surface mesh2volume triangulate", register_meshes);
  registry.add("addVertex addFace removeFace", register_mesh_building);
  registry.add(
      "withAttribute setAttribute clearAttribute removeAttribute meshAttributes realAttribute pointAttribute "
      "vectorAttribute textAttribute",
      register_mesh_attributes);
  registry.begin_family(
      {"subdivision", "Smooth surfaces from meshes, by repeated division of their faces.", Cost::linear});
  registry.add("subdivide limitPosition", register_subdivision);
  registry.begin_family({"mesh elements",
                         "Vertices, edges, half-edges and faces of surfaces, solids and meshes, and their neighbours.",
                         Cost::linear});
  registry.add("vertices edges halfedges faces", register_mesh_elements);
  registry.add(
      "oneRing vertexEdges vertexFaces edgeVertices edgeEdges edgeFaces faceVertices faceEdges faceFaces "
      "outgoingHalfedges incomingHalfedges faceHalfedges halfedge",
      register_mesh_neighbours);
  registry.begin_family({"topology", "How the faces of surfaces, solids and meshes hang together.", Cost::linear});
  registry.add("isClosed isManifold isOriented genus eulerCharacteristic valence boundaryLoops dual",
               register_topology);
  registry.begin_family({"edits of meshes", "Edits of single edges, faces and vertices of a mesh.", Cost::linear});
  registry.add("flipEdge splitEdge collapseEdge splitFace splitVertex moveVertex", register_mesh_edits);
  registry.begin_family({"simplification", "Meshes, surfaces and solids with fewer triangles.", Cost::sorting});
  registry.add("simplify", register_simplification);
  registry.begin_family({"mesh files",
                         "Import of solids and surfaces from STL, OBJ and OFF files, with repair and reports.",
                         Cost::file});
  registry.add("importSTL importOBJ importOFF checkSTL importSurface importMesh", register_imports);
  registry.add("exportSTL exportOBJ exportOFF", register_exports);
  registry.add("repairReport", register_repair_reports);
  registry.add("toSTL toOBJ toOFF toGLB", register_mesh_bytes);
  registry.begin_family({"rounding", "Solids with short coordinates.", Cost::arrangement});
  registry.add("roundCoordinates rotateRounded", register_rounding);
  registry.begin_family(
      {"regions", "Polygons with holes in the plane, and solids and surfaces made of them.", Cost::sorting});
  registry.add(
      "makePoint rectangle2 rect2region areaExact perimeter faceCount holeCount region2surface region2volume slice "
      "projectXY",
      register_regions);
  registry.add("mregion2volume", register_space_time);
  registry.begin_family({"region files", "Regions from WKT and GeoJSON, and back.", Cost::linear});
  registry.add("wkt2region region2wkt geojson2region", register_region_texts);
  registry.add("jsonText jsonNumber", register_json_members);
  registry.add("importGeoJSON", register_geojson_features);
  registry.add("makeRegion", register_make_regions);
  registry.begin_family(
      {"well-known binary", "Geometries as PostGIS and GDAL exchange them (WKB and EWKB).", Cost::linear});
  registry.add("fromWKB surfaceFromWKB meshFromWKB pointsFromWKB pointFromWKB regionFromWKB sridOfWKB toWKB",
               register_well_known_binary);
  registry.begin_family({"time", "Instants, durations and intervals.", Cost::constant});
  registry.add(
      "theInstant now year_of month_of day_of hour_of minute_of second_of millisecond_of weekday_of create_duration "
      "duration2real makeInterval minimum maximum leftClosed rightClosed",
      register_time);
  registry.begin_family({"moving regions", "Regions that move over time.", Cost::linear});
  registry.add("atinstant initial final deftime units", register_moving_regions);
  registry.begin_family({"aggregates", "One value of many.", Cost::linear});
  registry.add("sum avg min max", register_aggregates);
  registry.add("union_aggr intersection_aggr extent", register_set_aggregates);
  registry.begin_family({"sequences", "Sequences of numbers.", Cost::linear});
  registry.add("intstream realstream", register_sequences);
  registry.begin_family({"files and folders", "Names of files.", Cost::file});
  registry.add("getDirectory", register_directories);
  return registry;
}

}  // namespace algebra3d
