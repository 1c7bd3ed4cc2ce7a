// Normals of corners, divided at creases.
#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra3d/kernel/halfedge/detail/weighted_normals.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "base/large_allocator.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using detail::kVerticesPerTask;

/// Whether the angle between two normals is larger than a crease angle.
class CreaseTest {
 public:
  explicit CreaseTest(double degrees) : degrees_(degrees), cosine_(std::cos(degrees / detail::kDegreesPerRadian)) {}

  bool operator()(const Vec3& a, const Vec3& b) const {
    // Lengths are 1 within 1e-9, or 0. Where the cosine does not decide, the angle does.
    constexpr double kCertain = 1e-8;
    const double cosine = dot(a, b);
    if (cosine > cosine_ + kCertain) return false;
    if (cosine < cosine_ - kCertain && cosine != 0) return true;
    return a != b && detail::angle_between(a, b) * detail::kDegreesPerRadian > degrees_;
  }

 private:
  double degrees_, cosine_;
};

/// Makes the normals of the corners of consecutive vertices, numbered from 0, fan by fan.
template <typename Layout>
class CornerNormalsMaker {
 public:
  CornerNormalsMaker(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals,
                     std::span<const Vec3> vertex_normals, const CreaseTest& is_crease,
                     std::vector<std::uint32_t>& of_corner)
      : mesh_(mesh),
        face_normals_(face_normals),
        vertex_normals_(vertex_normals),
        is_crease_(is_crease),
        of_corner_(of_corner) {}

  std::vector<Vec3> make(std::size_t begin, std::size_t end) && {
    // Most vertices have one normal.
    for (std::size_t v = begin; v < end; ++v) {
      const std::span<const HalfedgeId> fans = mesh_.fans(VertexId(v));
      if (fans.size() == 1 && is_smooth(fans.front()))
        add_smooth_fan(fans.front(), vertex_normals_[v]);
      else
        for (const HalfedgeId first : fans) add_fan(first);
    }
    return std::move(normals_);
  }

 private:
  Vec3 normal(HalfedgeId h) const { return face_normals_[mesh_.face(h).index()]; }
  HalfedgeId next_in_fan(HalfedgeId h) const { return mesh_.opposite(mesh_.prev(h)); }
  bool is_crease_before(HalfedgeId h) const {
    const HalfedgeId opposite = mesh_.opposite(h);
    return !opposite.is_valid() || is_crease_(normal(h), normal(opposite));
  }

  /// True if the fan is a ring without creases.
  bool is_smooth(HalfedgeId first) const {
    HalfedgeId h = first;
    do {
      const HalfedgeId next = next_in_fan(h);
      if (!next.is_valid() || is_crease_(normal(h), normal(next))) return false;
      h = next;
    } while (h != first);
    return true;
  }

  void add_smooth_fan(HalfedgeId first, const Vec3& vertex_normal) {
    HalfedgeId h = first;
    do {
      of_corner_[h.index()] = static_cast<std::uint32_t>(normals_.size());
      h = next_in_fan(h);
    } while (h != first);
    normals_.push_back(vertex_normal == Vec3{} ? normal(first) : vertex_normal);
  }

  void add_fan(HalfedgeId first) {
    fan_.clear();
    HalfedgeId h = first;
    do {
      fan_.push_back(h);
      h = next_in_fan(h);
    } while (h.is_valid() && h != first);
    const auto begin = std::ranges::find_if(fan_, [&](HalfedgeId corner) { return is_crease_before(corner); });
    if (begin != fan_.end()) std::rotate(fan_.begin(), begin, fan_.end());
    for (std::size_t part = 0; part < fan_.size();) {
      std::size_t end = part + 1;
      while (end < fan_.size() && !is_crease_before(fan_[end])) ++end;
      add_part(std::span(fan_).subspan(part, end - part));
      part = end;
    }
  }

  void add_part(std::span<const HalfedgeId> corners) {
    detail::WeightedSum sum;
    for (const HalfedgeId h : corners) {
      sum.add(normal(h), detail::corner_angle(mesh_, h, normal(h)));
      of_corner_[h.index()] = static_cast<std::uint32_t>(normals_.size());
    }
    const Vec3 direction = sum.direction();
    normals_.push_back(direction == Vec3{} ? normal(corners.front()) : direction);
  }

  const HalfedgeMesh<Layout>& mesh_;
  std::span<const Vec3> face_normals_, vertex_normals_;
  const CreaseTest& is_crease_;
  std::vector<std::uint32_t>& of_corner_;
  std::vector<Vec3> normals_;
  std::vector<HalfedgeId> fan_;
};

/// The normals of all tasks, one after the other, and where those of each begin.
struct JoinedNormals {
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> begins;
};

JoinedNormals joined(const std::vector<std::vector<Vec3>>& parts) {
  JoinedNormals all;
  std::size_t count = 0;
  for (const std::vector<Vec3>& part : parts) {
    all.begins.push_back(static_cast<std::uint32_t>(count));
    count += part.size();
  }
  resize_large(all.normals, count);
  parallel_for(parts.size(), 1,
               [&](std::size_t task) { std::ranges::copy(parts[task], all.normals.begin() + all.begins[task]); });
  return all;
}

}  // namespace

template <typename Layout>
CornerNormals corner_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals,
                             double crease_angle_degrees) {
  const CreaseTest is_crease(crease_angle_degrees);
  CornerNormals result;
  resize_large(result.of_corner, mesh.halfedge_count());
  const std::vector<Vec3> of_vertices = vertex_normals(mesh);
  std::vector<std::vector<Vec3>> parts(detail::vertex_task_count(mesh.vertex_count()));
  parallel_for(parts.size(), 1, [&](std::size_t task) {
    const std::size_t begin = task * kVerticesPerTask, end = std::min(mesh.vertex_count(), begin + kVerticesPerTask);
    parts[task] =
        CornerNormalsMaker<Layout>(mesh, face_normals, of_vertices, is_crease, result.of_corner).make(begin, end);
  });
  JoinedNormals all = joined(parts);
  constexpr std::size_t kCornersPerTask = 100000;
  parallel_for(mesh.halfedge_count(), kCornersPerTask,
               [&](std::size_t h) { result.of_corner[h] += all.begins[mesh.origins()[h] / kVerticesPerTask]; });
  result.normals = std::move(all.normals);
  return result;
}

template CornerNormals corner_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>, double);
template CornerNormals corner_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>, double);

}  // namespace algebra3d
