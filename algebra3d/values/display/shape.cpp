#include "algebra3d/values/display/shape.h"

namespace algebra3d {

std::size_t content_bytes(const DrawnShape& shape) {
  const auto bytes = [](const auto& array) { return array.size() * sizeof(array[0]); };
  return bytes(shape.positions) + bytes(shape.normals) + bytes(shape.triangles) + bytes(shape.edges) +
         bytes(shape.boundary) + bytes(shape.nonmanifold) + bytes(shape.lines) + bytes(shape.points) +
         bytes(shape.face_ids) + bytes(shape.vertex_ids) + bytes(shape.tree);
}

}  // namespace algebra3d
