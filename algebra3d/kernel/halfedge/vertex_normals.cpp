// Normals of vertices: the vertices are divided into blocks, whose sums stay in the cache while the faces that have
// corners there add to them. Faces on the border of blocks are measured once for each. Links are not needed.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "algebra3d/kernel/halfedge/detail/corner_weights.h"
#include "algebra3d/kernel/halfedge/detail/face_normal.h"
#include "algebra3d/kernel/halfedge/detail/weighted_normals.h"
#include "base/large_allocator.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using detail::CornerWeights;
using detail::FaceBatch;
using detail::WeightedSum;

constexpr std::uint32_t kBlockBits = 14;
constexpr std::size_t kVerticesPerBlock = std::size_t{1} << kBlockBits;

/// Consecutive faces.
struct FaceRun {
  std::uint32_t begin, end;
};

/// Which of some consecutive faces have a corner in which block of vertices.
class RunsByBlock {
 public:
  explicit RunsByBlock(std::size_t block_count) : last_(block_count, kNone), starts_(block_count + 1) {}

  /// Notes that faces, no less than those before, have corners in `block`.
  void add(std::uint32_t block, const FaceRun& faces) {
    const std::uint32_t last = last_[block];
    if (last != kNone && found_[last].run.end >= faces.begin) {
      found_[last].run.end = faces.end;
      return;
    }
    last_[block] = static_cast<std::uint32_t>(found_.size());
    found_.push_back({block, faces});
  }
  /// To be called after the last face.
  void sort() {
    for (const Found& found : found_) ++starts_[found.block + 1];
    for (std::size_t block = 1; block < starts_.size(); ++block) starts_[block] += starts_[block - 1];
    runs_.resize(found_.size());
    std::ranges::copy_n(starts_.begin(), static_cast<std::ptrdiff_t>(last_.size()), last_.begin());
    for (const Found& found : found_) runs_[last_[found.block]++] = found.run;
    found_ = {};
    last_ = {};
  }
  /// The runs of a block, ascending.
  std::span<const FaceRun> runs(std::size_t block) const {
    return std::span(runs_).subspan(starts_[block], starts_[block + 1] - starts_[block]);
  }

 private:
  struct Found {
    std::uint32_t block;
    FaceRun run;
  };

  std::vector<Found> found_;
  std::vector<std::uint32_t> last_;  // per block, in found_
  std::vector<FaceRun> runs_;        // sorted by block
  std::vector<std::uint32_t> starts_;
};

/// The first of some corners that is not in a block of vertices; their number if all are.
std::size_t first_outside(std::span<const std::uint32_t> corners, std::uint32_t block) {
  constexpr std::size_t kGroup = 32;  // looked at together, without a branch for each
  std::size_t i = 0;
  for (; i + kGroup <= corners.size(); i += kGroup) {
    std::uint32_t differences = 0;
    for (std::size_t j = i; j < i + kGroup; ++j) differences |= corners[j] ^ (block << kBlockBits);
    if (differences >> kBlockBits != 0) break;
  }
  while (i < corners.size() && corners[i] >> kBlockBits == block) ++i;
  return i;
}

template <typename Layout>
RunsByBlock runs_by_block(const HalfedgeMesh<Layout>& mesh, const FaceRun& faces, std::size_t block_count) {
  const std::span<const std::uint32_t> corners(mesh.origins());
  const FaceId last(faces.end - 1);
  const std::size_t corners_end = mesh.halfedge(last).index() + mesh.degree(last);
  RunsByBlock runs(block_count);
  for (std::uint32_t f = faces.begin; f < faces.end;) {
    const std::size_t first = mesh.halfedge(FaceId(f)).index();
    const std::uint32_t block = corners[first] >> kBlockBits;
    const std::size_t outside = first + first_outside(corners.subspan(first, corners_end - first), block);
    const std::uint32_t end = outside == corners_end ? faces.end : mesh.face(HalfedgeId(outside)).index();
    if (end > f) {
      runs.add(block, {f, end});
      f = end;
    } else {
      for (const std::uint32_t corner : corner_indices(mesh, FaceId(f))) runs.add(corner >> kBlockBits, {f, f + 1});
      ++f;
    }
  }
  runs.sort();
  return runs;
}

/// The runs of all faces, which are divided into parts.
template <typename Layout>
std::vector<RunsByBlock> all_runs_by_block(const HalfedgeMesh<Layout>& mesh, std::size_t block_count) {
  constexpr std::size_t kLeastFaces = 32768, kMostParts = 256;
  const std::size_t face_count = mesh.face_count();
  const std::size_t size = std::max(kLeastFaces, (face_count + kMostParts - 1) / kMostParts);
  std::vector<RunsByBlock> parts((face_count + size - 1) / size, RunsByBlock(0));
  parallel_for(parts.size(), 1, [&](std::size_t part) {
    const std::size_t begin = part * size, end = std::min(face_count, begin + size);
    parts[part] =
        runs_by_block(mesh, {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)}, block_count);
  });
  return parts;
}

bool has_common_degree(const HalfedgeMesh<TriangleLayout>& /*mesh*/) {
  return true;
}
bool has_common_degree(const HalfedgeMesh<PolygonLayout>& mesh) {
  return mesh.common_degree() != 0;
}

/// The sums of the vertices of a block.
template <typename Layout>
class BlockSums {
 public:
  BlockSums(const HalfedgeMesh<Layout>& mesh, std::size_t first, std::size_t count)
      : mesh_(mesh), kernels_(detail::corner_weight_kernels()), first_(first), count_(count), sums_(count + 1) {}

  void add(const FaceRun& faces) {
    for (std::uint32_t f = faces.begin; f < faces.end;) {
      const std::uint32_t degree = mesh_.degree(FaceId(f));
      std::uint32_t end = faces.end;
      if (!has_common_degree(mesh_)) end = f + 1;
      if (degree == 3)
        add_to_list({f, end}, triangles_);
      else if (degree == 4)
        add_to_list({f, end}, quadrilaterals_);
      else
        add_polygons({f, end});
      f = end;
    }
  }

  /// Writes the normals, one per vertex of the block.
  void finish(std::span<Vec3> normals) {
    finish_list(triangles_);
    finish_list(quadrilaterals_);
    for (std::size_t v = 0; v < count_; ++v) normals[v] = sums_[v].direction();
  }

 private:
  /// Faces of one degree.
  struct List {
    std::uint32_t degree;
    std::size_t count = 0;
    std::array<std::uint32_t, CornerWeights::kMaxFaces> begins{};
  };

  /// Adds faces whose corners are one after the other.
  void add_to_list(FaceRun faces, List& list) {
    while (faces.begin < faces.end) {
      const std::size_t count = std::min<std::size_t>(faces.end - faces.begin, list.begins.size() - list.count);
      const std::uint32_t first = mesh_.halfedge(FaceId(faces.begin)).index(), degree = list.degree;
      for (std::uint32_t i = 0; i < count; ++i) list.begins[list.count + i] = first + i * degree;
      list.count += count;
      faces.begin += static_cast<std::uint32_t>(count);
      if (list.count == list.begins.size()) finish_list(list);
    }
  }

  void finish_list(List& list) {
    if (list.count == 0) return;
    for (std::size_t i = list.count; i % CornerWeights::kGrain != 0; ++i) list.begins[i] = list.begins[i - 1];
    const FaceBatch faces{mesh_.points().approx().data(), mesh_.origins().data(), list.begins.data(), list.count};
    const bool are_reliable =
        list.degree == 3 ? kernels_.of_triangles(faces, weights_) : kernels_.of_quadrilaterals(faces, weights_);
    if (!are_reliable || mesh_.points().exact_count() != 0) mend_weights(list);
    kernels_.add(faces, list.degree, weights_, {first_, count_, sums_.data()});
    list.count = 0;
  }

  /// Computes what the kernels could not, one by one.
  void mend_weights(const List& list) {
    for (std::size_t i = 0; i < list.count; ++i) {
      const HalfedgeId first(list.begins[i]);
      const FaceId face = mesh_.face(first);
      if (weights_.are_reliable[i] != 0 && has_doubles_only(face)) continue;
      const Vec3 normal = detail::face_normal(mesh_, face);
      for (std::size_t axis = 0; axis < 3; ++axis) weights_.normals[axis][i] = normal[axis];
      for (std::uint32_t corner = 0; corner < list.degree; ++corner)
        weights_.angles[corner][i] = detail::corner_angle(mesh_, HalfedgeId(first.index() + corner), normal);
    }
  }

  bool has_doubles_only(FaceId f) const {
    return std::ranges::all_of(corner_indices(mesh_, f),
                               [&](std::uint32_t corner) { return mesh_.points()[corner].is_double(); });
  }

  void add_polygons(const FaceRun& faces) {
    for (std::uint32_t f = faces.begin; f < faces.end; ++f) {
      const Vec3 normal = detail::face_normal(mesh_, FaceId(f));
      const std::uint32_t first = mesh_.halfedge(FaceId(f)).index();
      for (std::uint32_t h = first; h < first + mesh_.degree(FaceId(f)); ++h) {
        const std::size_t place = mesh_.origins()[h] - first_;
        if (place < count_) sums_[place].add(normal, detail::corner_angle(mesh_, HalfedgeId(h), normal));
      }
    }
  }

  const HalfedgeMesh<Layout>& mesh_;
  const detail::CornerWeightKernels& kernels_;
  std::size_t first_, count_;
  std::vector<WeightedSum> sums_;  // the last one takes the shares of other vertices
  List triangles_{3}, quadrilaterals_{4};
  CornerWeights weights_;
};

}  // namespace

template <typename Layout>
void vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<Vec3> normals) {
  assert(normals.size() == mesh.vertex_count());
  const std::size_t block_count = (mesh.vertex_count() + kVerticesPerBlock - 1) / kVerticesPerBlock;
  const std::vector<RunsByBlock> parts = all_runs_by_block(mesh, block_count);
  parallel_for(block_count, 1, [&](std::size_t block) {
    const std::size_t first = block * kVerticesPerBlock,
                      count = std::min(kVerticesPerBlock, mesh.vertex_count() - first);
    BlockSums<Layout> sums(mesh, first, count);
    for (const RunsByBlock& part : parts)
      for (const FaceRun& run : part.runs(block)) sums.add(run);
    sums.finish(normals.subspan(first, count));
  });
}

template <typename Layout>
std::vector<Vec3> vertex_normals(const HalfedgeMesh<Layout>& mesh) {
  std::vector<Vec3> normals;
  resize_large(normals, mesh.vertex_count());
  vertex_normals(mesh, normals);
  return normals;
}

template std::vector<Vec3> vertex_normals(const HalfedgeMesh<TriangleLayout>&);
template void vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<Vec3>);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<PolygonLayout>&);
template void vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<Vec3>);

}  // namespace algebra3d
