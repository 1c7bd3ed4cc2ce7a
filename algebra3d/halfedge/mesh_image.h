#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/exact/affine_map.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The reason of an undefined image.
inline constexpr const char* kImageOutOfRange = "a coordinate of the image is beyond the range of doubles";

/// The triangles of an image in their order; a map that mirrors swaps the second and third corner of each, so that the
/// outside stays outside. Cost: linear.
std::vector<TriangleMesh::Triangle> image_triangles(const AffineMap& map, const TriangleMesh& mesh);

/// The exact images of all points, in their order. Undefined if one is beyond the range of doubles. Errors:
/// interrupted. Cost: that of AffineMap::apply for each.
Result<Maybe<PointArray>> exact_images(const AffineMap& map, const PointArray& points,
                                       const std::atomic<bool>* cancel = nullptr);

/// The exact image of a mesh, with the images of the planes that are known. The map must not flatten. An image keeps
/// all that makes a valid surface or volume: common points stay common, distinct ones distinct, and inside stays
/// inside. Undefined and errors as `exact_images`. Cost: the same, and that of linking the triangles.
Result<Maybe<TriangleMesh>> exact_image(const AffineMap& map, const TriangleMesh& mesh,
                                        const std::atomic<bool>* cancel = nullptr);

/// The valid mesh that was mapped, as a help in a proof of its rounded image: where its triangles are far apart, those
/// of the image are apart too.
struct Preimage {
  const TriangleMesh* mesh = nullptr;  ///< null: none
  double reach = 0;  ///< triangles of the image only meet if those of the mesh are no farther apart than this
  int turn = 1;      ///< -1 if the image mirrors, so that its triangles are turned over
};

/// The mesh as a preimage of the triangles over `rounded`, the images of its points each rounded once. None where it is
/// no help: the boxes of its triangles take nearly as much room as those of the image, or the map flattens. Proved.
/// Cost: linear, some nanoseconds for each triangle.
Preimage preimage_of(const AffineMap& map, const TriangleMesh& mesh, std::span<const Vec3> rounded);

}  // namespace algebra3d
