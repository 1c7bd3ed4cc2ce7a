#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// Connected components of the faces, numbered in order of their first face.
struct FaceComponents {
  std::vector<std::uint32_t> of_face;  ///< component of each face
  std::size_t count = 0;

  /// The faces of each component, ascending.
  std::vector<std::vector<FaceId>> faces() const;
};

}  // namespace algebra3d
