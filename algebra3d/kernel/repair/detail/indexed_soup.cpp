#include "algebra3d/kernel/repair/detail/indexed_soup.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/relinked.h"

namespace algebra3d {

IndexedSoup::IndexedSoup(std::shared_ptr<const TriangleMesh> mesh)
    : points(mesh->points().approx()), triangles(triangles_of(*mesh)), mesh_(std::move(mesh)) {}

double IndexedSoup::diagonal() const {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) box.extend(points[corner]);
  return box.is_empty() ? 0 : length(box.max - box.min);
}

std::shared_ptr<const TriangleMesh> IndexedSoup::mesh() const {
  if (mesh_ == nullptr)
    mesh_ = std::make_shared<const TriangleMesh>(
        before_ == nullptr ? TriangleMesh(PointArray(points), triangles.values())
                           : relinked(*before_, faces_before(), PointArray(points), triangles.values()));
  before_.reset();
  assert(is_linked());
  return mesh_;
}

void IndexedSoup::changed() {
  if (mesh_ != nullptr) before_ = std::exchange(mesh_, nullptr);
}

void IndexedSoup::add(const std::vector<TriangleMesh::Triangle>& more) {
  std::vector<TriangleMesh::Triangle>& all = triangles.values();
  all.insert(all.end(), more.begin(), more.end());
  changed();
}

void IndexedSoup::flip(FaceId triangle) {
  std::swap(triangles[triangle][1], triangles[triangle][2]);
  changed();
}

bool IndexedSoup::drop(const IdVector<FaceId, bool>& is_dropped) {
  std::size_t kept = 0;
  for (const FaceId triangle : triangles.ids()) {
    const bool stays = triangle.index() >= is_dropped.size() || !is_dropped[triangle];
    if (stays) triangles[FaceId(kept++)] = triangles[triangle];
  }
  if (kept == triangles.size()) return false;
  triangles.resize(kept);
  changed();
  return true;
}

bool IndexedSoup::is_linked() const {
  if (mesh_->face_count() != triangles.size()) return false;
  return std::ranges::all_of(triangles.ids(), [&](FaceId f) { return mesh_->triangle(f) == triangles[f]; });
}

/// Which face each triangle was when they were linked last, or kNone, as far as that is easily found: triangles keep
/// their order, though some go, change or are added at the end.
std::vector<std::uint32_t> IndexedSoup::faces_before() const {
  constexpr std::size_t kFarthest = 16;
  std::vector<std::uint32_t> was(triangles.size(), kNone);
  std::size_t next = 0;
  for (std::size_t i = 0; i < triangles.size() && next < before_->face_count(); ++i) {
    const std::size_t end = std::min(next + kFarthest, before_->face_count());
    std::size_t found = next;
    while (found < end && before_->triangle(FaceId(found)) != triangles[FaceId(i)]) ++found;
    if (found < end) was[i] = static_cast<std::uint32_t>(found);
    next = found < end ? found + 1 : next + 1;
  }
  return was;
}

}  // namespace algebra3d
