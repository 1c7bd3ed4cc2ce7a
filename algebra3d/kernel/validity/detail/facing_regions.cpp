#include "algebra3d/kernel/validity/detail/facing_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kFacesPerTask = 4096;
/// The least cosine of the angle between the normal of a face and the direction of its region.
constexpr double kLeastCosine = 0.25;

/// A set of directions: bit 2 * axis, or 2 * axis + 1 for the negative direction.
using DirectionBits = std::uint8_t;

/// The normal of a triangle of doubles, rounded.
struct Normal {
  Vec3 value;
  double error = 0;  // of each coordinate, at most
};

inline Normal normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double longest = std::max(detail::largest(u), detail::largest(v)), square = longest * longest;
  // Two products of at most longest^2, each with three roundings of 2^-53, and the rounding of their difference.
  // Outside this range underflow would break the bound, or overflow make it void.
  const bool is_in_range = square > 1e-250 && square < 1e250;
  return {cross(u, v), is_in_range ? 2e-15 * square : std::numeric_limits<double>::infinity()};
}

/// The directions in which the front of a triangle is seen well.
inline DirectionBits directions_of(const Normal& normal) {
  const double least = std::max(normal.error, kLeastCosine * std::sqrt(dot(normal.value, normal.value)));
  unsigned bits = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    bits |= static_cast<unsigned>(normal.value[axis] > least) << (2 * axis);
    bits |= static_cast<unsigned>(normal.value[axis] < -least) << (2 * axis + 1);
  }
  return static_cast<DirectionBits>(bits);
}

/// The number of the direction in which the front is seen best.
unsigned best_direction(const Normal& normal) {
  unsigned best = 0;
  for (unsigned axis = 1; axis < 3; ++axis)
    if (std::abs(normal.value[axis]) > std::abs(normal.value[best])) best = axis;
  return 2 * best + (normal.value[best] < 0 ? 1 : 0);
}

class RegionGrowing {
 public:
  explicit RegionGrowing(const TriangleMesh& mesh) : mesh_(mesh), directions_(mesh.face_count()) {
    parallel_for(mesh.face_count(), kFacesPerTask, [&](std::size_t f) {
      if (has_double_corners(FaceId(f))) directions_[FaceId(f)] = directions_of(rounded_normal(FaceId(f)));
    });
  }

  FacingRegions run() {
    found_.of_face.resize(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
      if (found_.of_face[FaceId(f)].is_none()) grow(FaceId(f));
    return std::move(found_);
  }

 private:
  bool has_double_corners(FaceId face) const {
    if (mesh_.points().exact_count() == 0) return true;
    return std::ranges::all_of(mesh_.corners(face), [](const PointRef& corner) { return corner.is_double(); });
  }
  Normal rounded_normal(FaceId face) const {
    const std::vector<Vec3>& points = mesh_.points().approx();
    const TriangleMesh::Triangle t = mesh_.triangle(face);
    return normal_of(points[t[0]], points[t[1]], points[t[2]]);
  }
  void grow(FaceId seed) {
    const RegionId region = found_.regions.push_back({{}, seed, 1});
    found_.of_face[seed] = region;
    const unsigned number = best_direction(rounded_normal(seed));
    const auto bit = static_cast<DirectionBits>(1U << number);
    if ((directions_[seed] & bit) == 0) return;
    FacingRegion& grown = found_.regions[region];
    grown.direction = {static_cast<Projection>(number / 2), number % 2 != 0};
    stack_.push_back(seed);
    while (!stack_.empty()) {
      const FaceId face = stack_.back();
      stack_.pop_back();
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const HalfedgeId opposite = mesh_.opposite(TriangleMesh::halfedge(face, corner));
        if (!opposite.is_valid()) continue;
        const FaceId next = TriangleMesh::face(opposite);
        if ((directions_[next] & bit) == 0 || !found_.of_face[next].is_none()) continue;
        found_.of_face[next] = region;
        stack_.push_back(next);
        ++grown.face_count;
      }
    }
  }

  const TriangleMesh& mesh_;
  IdVector<FaceId, DirectionBits> directions_;  // in which the front of each face is seen well
  FacingRegions found_;
  std::vector<FaceId> stack_;
};

}  // namespace

FacingRegions find_facing_regions(const TriangleMesh& mesh) {
  return RegionGrowing(mesh).run();
}

}  // namespace algebra3d
