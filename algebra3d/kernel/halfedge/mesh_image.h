#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The reason of an undefined image.
inline constexpr const char* kImageOutOfRange = "a coordinate of the image is beyond the range of doubles";

/// The triangles of an image, in order. A mirroring map swaps the second and third corner of each, so that the outside
/// stays outside. Cost: linear.
std::vector<TriangleMesh::Triangle> image_triangles(const AffineMap& map, const TriangleMesh& mesh);

/// The exact images of all points, in order. Undefined if one is beyond the range of doubles. Errors: interrupted.
/// Cost: that of AffineMap::apply for each.
Result<Maybe<PointArray>> exact_images(const AffineMap& map, const PointArray& points,
                                       const std::atomic<bool>* cancel = nullptr);

/// The exact image of a mesh, with the images of its known planes. The map must not be singular. The image of a valid
/// surface or volume is valid. Undefined and errors as `exact_images`. Cost: the same, and that of linking the
/// triangles.
Result<Maybe<TriangleMesh>> exact_image(const AffineMap& map, const TriangleMesh& mesh,
                                        const std::atomic<bool>* cancel = nullptr);

/// The valid mesh of a rounded image, which speeds up the proof of the image: triangles that are far apart in the mesh
/// are disjoint in the image.
struct Preimage {
  const TriangleMesh* mesh = nullptr;  ///< null: none
  double reach = 0;  ///< triangles of the image can meet only if those of the mesh are within this distance
  int turn = 1;      ///< -1 if the map mirrors, so that triangles are flipped
};

/// The mesh as the preimage of the triangles over `rounded`, the rounded images of its points. Empty if it would not
/// help: the boxes of its triangles are nearly as large as those of the image, or the map is singular. The reach is
/// proved. Cost: linear, some nanoseconds per triangle.
Preimage preimage_of(const AffineMap& map, const TriangleMesh& mesh, std::span<const Vec3> rounded);

}  // namespace algebra3d
