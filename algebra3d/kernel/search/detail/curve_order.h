#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/face_order.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"

namespace algebra3d::curve_order {

/// Stable sort by places; faces must ascend. Cost: linear (radix sort), in parallel.
void sort_by_places(LargeVector<PlacedFace>& faces);

/// Faces that ascend by places, and others that are sorted, as one order by places. Cost: linear.
LargeVector<PlacedFace> merged(std::span<const PlacedFace> known, std::span<const PlacedFace> others);

/// The faces below `face_count` that `known` does not have, ascending. Cost: linear.
std::vector<std::uint32_t> faces_beyond(std::span<const PlacedFace> known, std::size_t face_count);

/// Orders faces of one place: by their full codes if they are more than `few`, small parts far apart, else by number.
/// code_of(face) is the full code.
template <typename CodeOf>
void sort_ties(LargeVector<PlacedFace>& faces, std::size_t few, const CodeOf& code_of) {
  const auto by_code = [&](PlacedFace placed) {
    poll_interruption();
    return std::pair(code_of(placed.face()), placed);
  };
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].place() == faces[begin].place()) ++end;
    const std::span<PlacedFace> ties = std::span(faces).subspan(begin, end - begin);
    if (ties.size() > few)
      std::ranges::sort(ties, {}, by_code);
    else if (!std::ranges::is_sorted(ties))
      std::ranges::sort(ties);
  }
}

}  // namespace algebra3d::curve_order
