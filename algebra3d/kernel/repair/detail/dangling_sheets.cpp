#include "algebra3d/kernel/repair/detail/dangling_sheets.h"

#include <map>
#include <span>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/manifold_patches.h"

namespace algebra3d {
namespace {

/// A manifold patch; it is found under its first triangle.
struct SheetPatch {
  bool has_boundary = false;
  bool hangs_on_others = false;  ///< at an edge of more than two triangles
  bool is_needed = false;        ///< by the others at such an edge
  double area = 0;

  bool is_dangling() const { return has_boundary && hangs_on_others && !is_needed; }
};

class DanglingSheets {
 public:
  explicit DanglingSheets(const IndexedSoup& soup)
      : soup_(soup), mesh_(soup.mesh()), patch_of_(manifold_patches(*mesh_)), patches_(mesh_->face_count()) {
    measure_patches();
    for (std::size_t n = 0; n < mesh_->nonmanifold_edge_count(); ++n)
      if (const auto edge = mesh_->nonmanifold_edge(n); edge.size() > 2) look_at(edge);
  }

  bool is_dangling(FaceId triangle) { return patch(triangle).is_dangling(); }

 private:
  SheetPatch& patch(FaceId triangle) { return patches_[patch_of_.find(triangle)]; }
  void measure_patches();
  void look_at(std::span<const HalfedgeId> edge);

  const IndexedSoup& soup_;
  std::shared_ptr<const TriangleMesh> mesh_;
  DisjointIds<FaceId> patch_of_;
  IdVector<FaceId, SheetPatch> patches_;
};

void DanglingSheets::measure_patches() {
  for (const FaceId triangle : soup_.triangles.ids()) patch(triangle).area += soup_.area(triangle);
  for (const HalfedgeId h : halfedges(*mesh_))
    if (mesh_->is_boundary(h)) patch(TriangleMesh::face(h)).has_boundary = true;
}

/// Notes which patches hang on others at the edge, and which of them the others need.
void DanglingSheets::look_at(std::span<const HalfedgeId> edge) {
  struct Share {
    int balance = 0;
    std::size_t count = 0;
  };
  int balance = 0;
  std::map<FaceId, Share> shares;  // of each patch in the edge
  for (const HalfedgeId h : edge) {
    const int sign = mesh_->origin(h) == mesh_->origin(edge[0]) ? 1 : -1;
    balance += sign;
    Share& share = shares[patch_of_.find(TriangleMesh::face(h))];
    share.balance += sign;
    ++share.count;
  }
  double area = 0;
  for (const auto& [id, share] : shares) area += patches_[id].area;
  for (const auto& [id, share] : shares) {
    SheetPatch& patch = patches_[id];
    patch.hangs_on_others = true;
    // A needle that lies on the boundary of a hole does not make a dangling sheet of the body.
    const bool is_largest = patch.area > area - patch.area;
    const bool others_balance = balance == share.balance && share.count < edge.size();
    if (is_largest || !others_balance) patch.is_needed = true;
  }
}

/// False if there are none.
bool drop_once(IndexedSoup& soup, RepairReport& report) {
  DanglingSheets sheets(soup);
  IdVector<FaceId, bool> is_dropped(soup.triangles.size());
  for (const FaceId triangle : soup.triangles.ids()) {
    is_dropped[triangle] = sheets.is_dangling(triangle);
    if (is_dropped[triangle]) report.add(RepairStep::dangling_sheets, soup.middle(triangle));
  }
  return soup.drop(is_dropped);
}

}  // namespace

void drop_dangling_sheets(IndexedSoup& soup, RepairReport& report) {
  // Sheets may hang on sheets.
  constexpr int kMostRounds = 20;
  for (int round = 0; round < kMostRounds && drop_once(soup, report); ++round) {
  }
}

}  // namespace algebra3d
