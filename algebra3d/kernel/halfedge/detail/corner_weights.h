#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algebra3d/base/vec3.h"

/// Normals and angles of many faces at once, in the vectors of the processor, and their sums at vertices.
namespace algebra3d::detail {

/// The normals of a batch of faces and the angles at their corners: the summands of vertex normals.
struct CornerWeights {
  static constexpr std::size_t kMaxFaces = 128;
  static constexpr std::size_t kGrain = 8;  ///< lists of faces are padded to a multiple of it

  alignas(64) double normals[3][kMaxFaces];
  double angles[4][kMaxFaces];
  std::int64_t are_reliable[kMaxFaces];  ///< 0: numbers of slivers, of huge or of tiny faces, not to be used
};

/// A sum of normals weighted by angles, and that of the angles.
struct alignas(32) WeightedSum {
  double x = 0, y = 0, z = 0;
  double angles = 0;

  void add(const Vec3& normal, double angle) {
    x += angle * normal.x;
    y += angle * normal.y;
    z += angle * normal.z;
    angles += angle;
  }
  /// The direction of the sum; zero if the normals cancel.
  Vec3 direction() const {
    const double size = std::sqrt(x * x + y * y + z * z);
    return size > 0x1p-40 * angles ? 1 / size * Vec3{x, y, z} : Vec3{};
  }
};

/// The corners of faces by the numbers of their points, and where those of each face of a batch begin: `count` places,
/// padded by repetition to a multiple of CornerWeights::kGrain.
struct FaceBatch {
  const Vec3* points;
  const std::uint32_t* corners;
  const std::uint32_t* begins;
  std::size_t count;
};

/// The vertices from `first` on that sums belong to, one each; one more takes what belongs to other vertices.
struct SumsOfVertices {
  std::size_t first, count;
  WeightedSum* sums;
};

/// The work on batches, for one instruction set. All give the same bits.
struct CornerWeightKernels {
  /// Weights of triangles, reliable if the sine s of the angle at the first corner is above 2^-20 and the face neither
  /// huge nor tiny. Exactness: normals, the bits of `face_normals`, within 2^-50 / s, angles within 2^-49 / s. Returns
  /// true if all faces are reliable.
  bool (*of_triangles)(const FaceBatch& faces, CornerWeights& weights);
  /// Weights of quadrilaterals, also bent and concave ones; here s is the sine of the angle between the diagonals, and
  /// angles are within 2^-49. A reflex corner, as seen from the tip of the normal, has an angle above pi.
  bool (*of_quadrilaterals)(const FaceBatch& faces, CornerWeights& weights);
  /// Adds the weights of faces with `degree` corners, 3 or 4, to their vertices, face after face.
  void (*add)(const FaceBatch& faces, std::size_t degree, const CornerWeights& weights, const SumsOfVertices& sums);
};

/// The kernels for this processor.
const CornerWeightKernels& corner_weight_kernels();

/// All that can run here, for tests; plain code first.
std::span<const CornerWeightKernels* const> available_corner_weight_kernels();

}  // namespace algebra3d::detail
