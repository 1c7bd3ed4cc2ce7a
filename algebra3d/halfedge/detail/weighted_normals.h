#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "algebra3d/base/large_allocator.h"
#include "algebra3d/halfedge/detail/angles.h"
#include "algebra3d/halfedge/halfedge_mesh.h"

/// Normals as sums of the normals of faces, weighted by the angles of their corners.
namespace algebra3d::detail {

/// A vector of any size brought to the length 1; the zero vector stays.
inline Vec3 direction(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) return v;
  const Vec3 scaled{v.x / largest, v.y / largest, v.z / largest};
  const double size = std::sqrt(dot(scaled, scaled));
  return {scaled.x / size, scaled.y / size, scaled.z / size};
}

/// A corner as the direction (cosine, sine), up to a factor, from which its angle is computed; sine >= 0.
struct CornerDirection {
  double sine = 0, cosine = 0;
  bool is_reflex = false;

  /// Between two edges, in a face with this normal if that has more than three corners.
  CornerDirection(const Vec3& u, const Vec3& v, const Vec3* normal) {
    const Vec3 turn = cross(u, v);
    sine = std::sqrt(dot(turn, turn));
    cosine = dot(u, v);
    is_reflex = normal != nullptr && dot(turn, *normal) < 0;
  }
  bool is_in_range() const {
    const double size = sine + std::abs(cosine);
    return size > 0x1p-450 && size < 0x1p450;
  }
};

inline double with_reflex(double angle, bool is_reflex) {
  return is_reflex ? 2 * std::numbers::pi - angle : angle;
}

/// The direction of the corner that `h` leaves, of any size.
template <typename Layout>
CornerDirection corner_direction(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, const Vec3& face_normal) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3& corner = points[mesh.origin(h).index()];
  const Vec3 &next = points[mesh.target(h).index()], &before = points[mesh.origin(mesh.prev(h)).index()];
  const Vec3* normal = mesh.degree(mesh.face(h)) > 3 ? &face_normal : nullptr;
  const CornerDirection plain(next - corner, before - corner, normal);
  if (plain.is_in_range()) return plain;
  // Differences of the largest doubles are beyond their range.
  const double scale = plain.sine + std::abs(plain.cosine) < 1 ? 1 : 0.25;
  return {direction(scale * next - scale * corner), direction(scale * before - scale * corner), normal};
}

/// The angle of the corner that `h` leaves, in a face with this normal: more than pi at a reflex corner.
template <typename Layout>
double corner_angle(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, const Vec3& normal) {
  const CornerDirection corner = corner_direction(mesh, h, normal);
  return with_reflex(angle_of_direction(corner.sine, corner.cosine), corner.is_reflex);
}

/// A sum of normals weighted by angles.
struct WeightedNormal {
  Vec3 sum;
  double angles = 0;

  void add(const Vec3& normal, double angle) {
    sum = sum + angle * normal;
    angles += angle;
  }
  /// The direction of the sum; zero if the normals cancel.
  Vec3 direction() const {
    const double size = std::sqrt(dot(sum, sum));
    return size > 0x1p-40 * angles ? 1 / size * sum : Vec3{};
  }
};

/// Makes the normals of consecutive vertices. The angles of a batch of corners are computed together: without
/// anything between them, the processor works on several at once.
template <typename Layout>
class VertexNormalsMaker {
 public:
  VertexNormalsMaker(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals, std::span<Vec3> normals)
      : mesh_(mesh), points_(mesh.points().approx()), face_normals_(face_normals), normals_(normals) {}

  /// Makes the normals of the vertices from `begin` to `end`, from the place `first` on.
  void make(std::size_t begin, std::size_t end, std::size_t first) {
    constexpr std::size_t kCornersPerBatch = 512;
    first_ = first;
    for (std::size_t v = begin; v < end; ++v) {
      for (const HalfedgeId fan : mesh_.fans(VertexId(v))) add_fan(VertexId(v), fan);
      ends_.push_back(sines_.size());
      if (sines_.size() >= kCornersPerBatch) finish_batch();
    }
    finish_batch();
  }

 private:
  void add_fan(VertexId v, HalfedgeId first) {
    const Vec3& corner = points_[v.index()];
    Vec3 u = points_[mesh_.target(first).index()] - corner;
    HalfedgeId h = first;
    do {
      const HalfedgeId incoming = mesh_.prev(h);
      const Vec3 w = points_[mesh_.origin(incoming).index()] - corner;
      const FaceId face = mesh_.face(h);
      const Vec3* normal = mesh_.degree(face) > 3 ? &face_normals_[face.index()] : nullptr;
      CornerDirection direction(u, w, normal);
      if (!direction.is_in_range()) direction = corner_direction(mesh_, h, face_normals_[face.index()]);
      sines_.push_back(direction.sine);
      cosines_.push_back(direction.cosine);
      corners_.push_back({face.index(), direction.is_reflex});
      u = w;
      h = mesh_.opposite(incoming);
    } while (h.is_valid() && h != first);
  }

  void finish_batch() {
    angles_.resize(sines_.size());
    for (std::size_t i = 0; i < angles_.size(); ++i) angles_[i] = angle_of_direction(sines_[i], cosines_[i]);
    std::size_t corner = 0;
    for (const std::size_t end : ends_) {
      WeightedNormal sum;
      for (; corner < end; ++corner) {
        const Corner& at = corners_[corner];
        sum.add(face_normals_[at.face], with_reflex(angles_[corner], at.is_reflex));
      }
      normals_[first_++] = sum.direction();
    }
    sines_.clear();
    cosines_.clear();
    corners_.clear();
    ends_.clear();
  }

  struct Corner {
    std::uint32_t face;
    bool is_reflex;
  };

  const HalfedgeMesh<Layout>& mesh_;
  const std::vector<Vec3>& points_;
  std::span<const Vec3> face_normals_;
  std::span<Vec3> normals_;
  std::size_t first_ = 0;                         // place of the normals of the batch
  std::vector<double> sines_, cosines_, angles_;  // per corner of the batch
  std::vector<Corner> corners_;
  std::vector<std::size_t> ends_;  // per vertex of the batch, in the corners
};

/// Vertices of a parallel task.
inline constexpr std::size_t kVerticesPerTask = 10000;

inline std::size_t vertex_task_count(std::size_t vertex_count) {
  return (vertex_count + kVerticesPerTask - 1) / kVerticesPerTask;
}

/// Resizes an empty array in huge pages: fewer faults of the processor.
template <typename T>
void resize_large(std::vector<T>& array, std::size_t size) {
  array.reserve(size);
  prefer_huge_pages(array.data(), size * sizeof(T));
  array.resize(size);
}

}  // namespace algebra3d::detail
