#include "algebra3d/halfedge/normals.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "algebra3d/base/large_allocator.h"
#include "algebra3d/base/scheduler.h"
#include "algebra3d/exact/plane.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/detail/angles.h"

namespace algebra3d {
namespace {

/// Resizes an empty array in huge pages: fewer faults of the processor.
template <typename T>
void resize_large(std::vector<T>& array, std::size_t size) {
  array.reserve(size);
  prefer_huge_pages(array.data(), size * sizeof(T));
  array.resize(size);
}

// ---- faces

/// A multiple of a normal by doubles, and the size of the products that it is a sum of, squared.
struct RoundedNormal {
  Vec3 sum;
  double squared_products = 0;
};

RoundedNormal rounded_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
  const auto product = [](const Vec3& u, const Vec3& v) { return RoundedNormal{cross(u, v), dot(u, u) * dot(v, v)}; };
  const Vec3 &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]];
  if (corners.size() == 3) return product(b - a, c - a);
  if (corners.size() == 4) return product(c - a, points[corners[3]] - b);
  RoundedNormal result;
  double products = 0;
  Vec3 before = b - a;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 next = points[corners[i]] - a;
    result.sum = result.sum + cross(before, next);
    products += 0.5 * (dot(before, before) + dot(next, next));  // no less than the product of the lengths
    before = next;
  }
  result.squared_products = products * products;
  return result;
}

/// The normal by doubles alone; nothing where that is not within 1e-9: relative to the products the error is below
/// 2^-50 per corner.
std::optional<Vec3> quick_normal(const PointArray& points, std::span<const std::uint32_t> corners) {
  constexpr double kLeastShare = 0x1p-20;
  if (points.exact_count() != 0 &&
      !std::ranges::all_of(corners, [&](std::uint32_t corner) { return points[corner].is_double(); }))
    return std::nullopt;
  const RoundedNormal rounded = rounded_normal(points.approx(), corners);
  const double squared = dot(rounded.sum, rounded.sum);
  if (!(squared > kLeastShare * kLeastShare * rounded.squared_products) || !(squared > 0x1p-800) ||
      !(squared < 0x1p800))
    return std::nullopt;
  return 1 / std::sqrt(squared) * rounded.sum;
}

// ---- edges

/// The sign of the angle at an edge: positive if it is convex. Exact.
template <typename Layout>
int turning_sign(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const auto exact_normal = [&](FaceId f) { return exact_doubled_vector_area(mesh.points(), corner_indices(mesh, f)); };
  const RationalVec3 along = mesh.point(mesh.target(edge)).rational() - mesh.point(mesh.origin(edge)).rational();
  return dot(cross(exact_normal(mesh.face(edge)), exact_normal(mesh.face(mesh.opposite(edge)))), along).sign();
}

// ---- vertices

/// A vector of any size brought to the length 1; the zero vector stays.
Vec3 direction(const Vec3& v) {
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

double with_reflex(double angle, bool is_reflex) {
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
  return with_reflex(detail::angle_of_direction(corner.sine, corner.cosine), corner.is_reflex);
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

  /// Those of the vertices from `begin` to `end`, from the place `first` on.
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
    for (std::size_t i = 0; i < angles_.size(); ++i) angles_[i] = detail::angle_of_direction(sines_[i], cosines_[i]);
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

// ---- corners

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
  CornerNormalsMaker(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals, const CreaseTest& is_crease,
                     std::vector<std::uint32_t>& of_corner)
      : mesh_(mesh), face_normals_(face_normals), is_crease_(is_crease), of_corner_(of_corner) {}

  std::vector<Vec3> make(std::size_t begin, std::size_t end) && {
    // Most vertices have one normal.
    std::vector<Vec3> vertex_normals(end - begin);
    VertexNormalsMaker<Layout>(mesh_, face_normals_, vertex_normals).make(begin, end, 0);
    for (std::size_t v = begin; v < end; ++v) {
      const std::span<const HalfedgeId> fans = mesh_.fans(VertexId(v));
      if (fans.size() == 1 && is_smooth(fans.front()))
        add_smooth_fan(fans.front(), vertex_normals[v - begin]);
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
    WeightedNormal sum;
    for (const HalfedgeId h : corners) {
      sum.add(normal(h), corner_angle(mesh_, h, normal(h)));
      of_corner_[h.index()] = static_cast<std::uint32_t>(normals_.size());
    }
    const Vec3 direction = sum.direction();
    normals_.push_back(direction == Vec3{} ? normal(corners.front()) : direction);
  }

  const HalfedgeMesh<Layout>& mesh_;
  std::span<const Vec3> face_normals_;
  const CreaseTest& is_crease_;
  std::vector<std::uint32_t>& of_corner_;
  std::vector<Vec3> normals_;
  std::vector<HalfedgeId> fan_;
};

constexpr std::size_t kVerticesPerTask = 10000;

std::size_t vertex_task_count(std::size_t vertex_count) {
  return (vertex_count + kVerticesPerTask - 1) / kVerticesPerTask;
}

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
std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const HalfedgeId opposite = mesh.opposite(edge);
  if (!opposite.is_valid()) return std::nullopt;
  const VectorArea left = vector_area(mesh, mesh.face(edge)), right = vector_area(mesh, mesh.face(opposite));
  if (!left.has_normal() || !right.has_normal()) return std::nullopt;
  const double angle = detail::angle_between(left.normal, right.normal) * detail::kDegreesPerRadian;
  if (angle == 0) return 0;
  // Where the faces nearly lie upon each other rounding could turn 180 degrees round.
  constexpr double kNearlyFolded = 179.99;
  if (angle > kNearlyFolded) return turning_sign(mesh, edge) < 0 ? -angle : angle;
  const Vec3 along = mesh.point(mesh.target(edge)).approx - mesh.point(mesh.origin(edge)).approx;
  return dot(cross(left.normal, right.normal), along) < 0 ? -angle : angle;
}

template <typename Layout>
void face_normals(const HalfedgeMesh<Layout>& mesh, std::span<Vec3> normals) {
  assert(normals.size() == mesh.face_count());
  constexpr std::size_t kFacesPerTask = 20000;
  parallel_for(mesh.face_count(), kFacesPerTask, [&](std::size_t f) {
    const std::optional<Vec3> quick = quick_normal(mesh.points(), corner_indices(mesh, FaceId(f)));
    normals[f] = quick ? *quick : vector_area(mesh, FaceId(f)).normal;
  });
}

template <typename Layout>
std::vector<Vec3> face_normals(const HalfedgeMesh<Layout>& mesh) {
  std::vector<Vec3> normals;
  resize_large(normals, mesh.face_count());
  face_normals(mesh, normals);
  return normals;
}

template <typename Layout>
Vec3 vertex_normal(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  WeightedNormal sum;
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    const Vec3 normal = vector_area(mesh, mesh.face(h)).normal;
    sum.add(normal, corner_angle(mesh, h, normal));
  }
  return sum.direction();
}

template <typename Layout>
void vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals, std::span<Vec3> normals) {
  assert(face_normals.size() == mesh.face_count() && normals.size() == mesh.vertex_count());
  parallel_for(vertex_task_count(mesh.vertex_count()), 1, [&](std::size_t task) {
    const std::size_t begin = task * kVerticesPerTask, end = std::min(mesh.vertex_count(), begin + kVerticesPerTask);
    VertexNormalsMaker<Layout>(mesh, face_normals, normals).make(begin, end, begin);
  });
}

template <typename Layout>
std::vector<Vec3> vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals) {
  std::vector<Vec3> normals(mesh.vertex_count());
  vertex_normals(mesh, face_normals, normals);
  return normals;
}

template <typename Layout>
CornerNormals corner_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals,
                             double crease_angle_degrees) {
  const CreaseTest is_crease(crease_angle_degrees);
  CornerNormals result;
  resize_large(result.of_corner, mesh.halfedge_count());
  std::vector<std::vector<Vec3>> parts(vertex_task_count(mesh.vertex_count()));
  parallel_for(parts.size(), 1, [&](std::size_t task) {
    const std::size_t begin = task * kVerticesPerTask, end = std::min(mesh.vertex_count(), begin + kVerticesPerTask);
    parts[task] = CornerNormalsMaker<Layout>(mesh, face_normals, is_crease, result.of_corner).make(begin, end);
  });
  JoinedNormals all = joined(parts);
  constexpr std::size_t kCornersPerTask = 100000;
  parallel_for(mesh.halfedge_count(), kCornersPerTask,
               [&](std::size_t h) { result.of_corner[h] += all.begins[mesh.origins()[h] / kVerticesPerTask]; });
  result.normals = std::move(all.normals);
  return result;
}

template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<TriangleLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<TriangleLayout>&);
template void face_normals(const HalfedgeMesh<TriangleLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<TriangleLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>);
template void vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>, std::span<Vec3>);
template CornerNormals corner_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>, double);
template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<PolygonLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<PolygonLayout>&);
template void face_normals(const HalfedgeMesh<PolygonLayout>&, std::span<Vec3>);
template Vec3 vertex_normal(const HalfedgeMesh<PolygonLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>);
template void vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>, std::span<Vec3>);
template CornerNormals corner_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>, double);

}  // namespace algebra3d
