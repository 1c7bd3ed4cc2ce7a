#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/values/display/shape.h"

namespace algebra3d {

/// A shape as a node of a file, and the number of the row that it belongs to.
struct GlbNode {
  std::uint64_t row = 0;
  const DrawnShape* shape = nullptr;
};

/// A file in binary glTF 2.0 with a node for each shape; docs/http-api.md, "Shapes", describes it. An empty shape is a
/// node without mesh. Normals use the extension KHR_mesh_quantization, search trees and numbers of elements are
/// described in `extras`. Errors: limit_exceeded beyond 4 GB, which the format cannot have. Cost: a copy of the shapes.
Result<std::string> glb_of(std::span<const GlbNode> nodes);

/// About the bytes that a shape takes in a file.
std::size_t glb_bytes(const DrawnShape& shape);

}  // namespace algebra3d
