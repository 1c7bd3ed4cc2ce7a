#include "algebra3d/arrangement/detail/build_result_mesh.h"

#include <optional>
#include <utility>

#include "algebra3d/arrangement/detail/pseudo_nodes.h"
#include "algebra3d/arrangement/detail/regions.h"
#include "algebra3d/arrangement/detail/stage_audit.h"
#include "algebra3d/arrangement/detail/task_sizes.h"
#include "algebra3d/base/scheduler.h"
#include "algebra3d/halfedge/audit.h"

namespace algebra3d::arrangement {
namespace {

/// The edges of regions, without pseudo-nodes.
Result<std::vector<RegionEdge>> find_straight_edges(const Subdivision& subdivision, const Selection& selection,
                                                    const PatchCorners& patch_corners) {
  const std::vector<RegionEdge> boundaries = region_edges(subdivision, selection);
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the region edges", [&] { return audit(subdivision, boundaries); }));
  const std::vector<PseudoNode> pseudo_nodes = find_pseudo_nodes(subdivision, boundaries, patch_corners);
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the pseudo-nodes", [&] { return audit(subdivision, pseudo_nodes); }));
  std::vector<RegionEdge> straight = straightened(boundaries, pseudo_nodes);
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the straight edges", [&] { return audit(subdivision, straight); }));
  return straight;
}

Result<std::vector<Region>> find_regions(const Subdivision& subdivision, const Selection& selection,
                                         const PatchCorners& patch_corners) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<RegionEdge> straight,
                             find_straight_edges(subdivision, selection, patch_corners));
  ALGEBRA3D_ASSIGN_OR_RETURN(std::vector<Region> regions, triangulate_regions(subdivision, straight));
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the regions", [&] { return audit(subdivision, straight, regions); }));
  return regions;
}

}  // namespace

Result<UnlinkedMesh> build_unlinked_mesh(const Subdivision& subdivision, const Selection& selection) {
  KeptPatches kept;
  kept.reserve(subdivision.patches.patches.size());
  for (const PatchId patch : subdivision.patches.ids()) kept.push_back(selection.patch(patch));
  const PatchCorners patch_corners(subdivision, kept);

  std::optional<ResultMesh> mesh;
  Result<std::vector<Region>> regions = std::vector<Region>();
  const auto make_regions = [&] { regions = find_regions(subdivision, selection, patch_corners); };
  const auto take_patches = [&] { mesh.emplace(subdivision, patch_corners, kept); };
  parallel_invoke(subdivision.operands.face_count() >= kFacesWorthATask, make_regions, take_patches);
  if (!regions.ok()) return std::move(regions).error();
  for (Region& region : *regions) {
    mesh->add(region);
    region = {};
  }
  return mesh->finish();
}

Result<TriangleMesh> linked_and_audited(UnlinkedMesh mesh) {
  TriangleMesh result = linked(std::move(mesh));
  ALGEBRA3D_RETURN_IF_ERROR(check_stage("the result mesh", [&] { return audit(result); }));
  return result;
}

Result<TriangleMesh> build_result_mesh(const Subdivision& subdivision, const Selection& selection) {
  ALGEBRA3D_ASSIGN_OR_RETURN(UnlinkedMesh mesh, build_unlinked_mesh(subdivision, selection));
  return linked_and_audited(std::move(mesh));
}

}  // namespace algebra3d::arrangement
