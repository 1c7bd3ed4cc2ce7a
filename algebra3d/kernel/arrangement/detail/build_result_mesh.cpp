#include "algebra3d/kernel/arrangement/detail/build_result_mesh.h"

#include <functional>
#include <optional>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/pseudo_nodes.h"
#include "algebra3d/kernel/arrangement/detail/regions.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/halfedge/audit.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Called when sub-edges are not needed any more.
using FreeSubEdges = std::function<void()>;

/// The edges of regions, without pseudo-nodes.
Result<std::vector<RegionEdge>> straight_edges(const Subdivision& subdivision, std::vector<RegionEdge> edges,
                                               const PatchCorners& patch_corners) {
  A3D_TRY(check_stage("the region edges", [&] { return audit(subdivision, edges); }));
  const std::vector<PseudoNode> pseudo_nodes = find_pseudo_nodes(subdivision, edges, patch_corners);
  A3D_TRY(check_stage("the pseudo-nodes", [&] { return audit(subdivision, pseudo_nodes); }));
  edges = straightened(std::move(edges), pseudo_nodes);
  A3D_TRY(check_stage("the straight edges", [&] { return audit(subdivision, edges); }));
  return edges;
}

Result<Regions> find_regions(const Subdivision& subdivision, std::vector<RegionEdge> edges,
                             const PatchCorners& patch_corners) {
  A3D_ASSIGN(const std::vector<RegionEdge> straight, straight_edges(subdivision, std::move(edges), patch_corners));
  A3D_ASSIGN(Regions regions, triangulate_regions(subdivision, straight));
  A3D_TRY(check_stage("the regions", [&] { return audit(subdivision, straight, regions); }));
  return regions;
}

Result<UnlinkedMesh> build_unlinked_mesh(const Subdivision& subdivision, Selection selection,
                                         const FreeSubEdges& free_sub_edges) {
  std::vector<RegionEdge> edges;
  std::optional<PatchCorners> patch_corners;
  parallel_invoke(
      subdivision.operands.face_count() >= kFacesWorthATask, [&] { edges = region_edges(subdivision, selection); },
      [&] { patch_corners.emplace(subdivision, selection.patches); });
  // Regions mostly have fewer triangles than half of the sub-edges, one of which has two sides in each of its planes.
  const std::size_t region_triangles = subdivision.sub_edges.size() / 2;

  std::optional<ResultMesh> mesh;
  Result<Regions> regions = Regions();
  const auto make_regions = [&] {
    selection.sub_facets = {};
    free_sub_edges();
    regions = find_regions(subdivision, std::move(edges), *patch_corners);
  };
  const auto take_patches = [&] { mesh.emplace(subdivision, *patch_corners, selection.patches, region_triangles); };
  // Without faces to be taken over, the memory of the sub-edges is free before the mesh needs some.
  const std::size_t faces_in_patches = subdivision.operands.face_count() - subdivision.facets.faces.size();
  parallel_invoke(faces_in_patches >= kFacesWorthATask, make_regions, take_patches);
  if (!regions.ok()) return std::move(regions).error();
  for (const Region& region : regions->regions) mesh->add(region, regions->triangles_of(region));
  return mesh->finish();
}

Result<TriangleMesh> linked_and_audited(UnlinkedMesh mesh) {
  TriangleMesh result = linked(std::move(mesh));
  A3D_TRY(check_stage("the result mesh", [&] { return audit(result); }));
  return result;
}

}  // namespace

Result<TriangleMesh> build_result_mesh(const Subdivision& subdivision, Selection selection) {
  A3D_ASSIGN(UnlinkedMesh mesh, build_unlinked_mesh(subdivision, std::move(selection), [] {}));
  return linked_and_audited(std::move(mesh));
}

Result<TriangleMesh> build_result_mesh(Subdivision&& subdivision, Selection selection) {
  Result<UnlinkedMesh> mesh = UnlinkedMesh();
  {
    Subdivision own = std::move(subdivision);
    mesh = build_unlinked_mesh(own, std::move(selection), [&] { own.sub_edges = {}; });
  }
  if (!mesh.ok()) return std::move(mesh).error();
  return linked_and_audited(*std::move(mesh));
}

}  // namespace algebra3d::arrangement
