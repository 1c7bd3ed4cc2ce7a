#include "import_peers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#ifdef BENCH_WITH_ADMESH
#include <admesh/stl.h>
#endif
#ifdef BENCH_WITH_ASSIMP
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace bench {
namespace {

// The kernel that CGAL recommends for this: exact predicates, inexact constructions.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

using Points = std::vector<Kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;

PeerMesh failed(const char* why) {
  PeerMesh result;
  result.failure = why;
  return result;
}

PeerMesh result_of(const Mesh& mesh, bool with_proof) {
  PeerMesh result;
  result.triangles = mesh.number_of_faces();
  result.vertices = mesh.number_of_vertices();
  result.is_closed = CGAL::is_closed(mesh);
  result.crosses_itself = with_proof && pmp::does_self_intersect(mesh);
  return result;
}

void close_holes(Mesh& mesh) {
  std::vector<Mesh::Halfedge_index> holes;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(holes));
  for (const Mesh::Halfedge_index hole : holes) {
    std::vector<Mesh::Face_index> patch;
    pmp::triangulate_hole(mesh, hole, std::back_inserter(patch));
  }
}

}  // namespace

PeerMesh import_with_cgal(const std::filesystem::path& path, bool with_proof) {
  Points points;
  Polygons polygons;
  if (!CGAL::IO::read_polygon_soup(path.string(), points, polygons)) return failed("not read");
  pmp::merge_duplicate_points_in_polygon_soup(points, polygons);
  pmp::orient_polygon_soup(points, polygons);
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return result_of(mesh, with_proof);
}

PeerMesh repair_with_cgal(const std::filesystem::path& path) {
  Points points;
  Polygons polygons;
  if (!CGAL::IO::read_polygon_soup(path.string(), points, polygons)) return failed("not read");
  pmp::repair_polygon_soup(points, polygons);
  pmp::orient_polygon_soup(points, polygons);
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  pmp::stitch_borders(mesh);
  close_holes(mesh);
  return result_of(mesh, true);
}

struct CgalSoup::Content {
  Points points;
  Polygons polygons;
};

CgalSoup::CgalSoup(std::span<const algebra3d::TriangleSoup::Triangle> triangles)
    : content_(std::make_unique<Content>()) {
  for (const auto& triangle : triangles) {
    const std::size_t first = content_->points.size();
    for (const auto& corner : triangle) content_->points.emplace_back(corner.x, corner.y, corner.z);
    content_->polygons.push_back({first, first + 1, first + 2});
  }
}

CgalSoup::~CgalSoup() = default;

std::size_t CgalSoup::merge() {
  pmp::merge_duplicate_points_in_polygon_soup(content_->points, content_->polygons);
  return content_->points.size();
}

#ifdef BENCH_WITH_ADMESH
PeerMesh repair_with_admesh(const std::filesystem::path& path) {
  stl_file stl{};
  std::string name = path.string();
  stl_open(&stl, name.data());
  if (stl_get_error(&stl) != 0) return failed("not read");
  // The values that the program has if no option is given: all is done, with tolerances of its own.
  constexpr int kAll = 1, kNot = 0, kIterations = 2;
  stl_repair(&stl, kAll, kNot, kNot, 0, kNot, 0, kNot, kIterations, kNot, kNot, kNot, kNot, kNot, kNot);
  PeerMesh result;
  if (stl_get_error(&stl) != 0) result.failure = "not repaired";
  result.triangles = static_cast<std::size_t>(stl.stats.number_of_facets);
  result.is_closed = stl.stats.connected_facets_3_edge == stl.stats.number_of_facets;
  stl_close(&stl);
  return result;
}
#endif

#ifdef BENCH_WITH_ASSIMP
PeerMesh import_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr) return failed("not read");
  PeerMesh result;
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
    result.triangles += mesh->mNumFaces;
    result.vertices += mesh->mNumVertices;
  }
  return result;
}
#endif

}  // namespace bench
