#include "algebra3d/kernel/search/detail/curve_order.h"

#include "base/radix_sort.h"

namespace algebra3d::curve_order {

void sort_by_places(LargeVector<PlacedFace>& faces) {
  LargeVector<PlacedFace> buffer(faces.size());
  radix_sort<32>(std::span(faces), std::span(buffer), [](PlacedFace placed) { return placed.place(); });
}

LargeVector<PlacedFace> merged(std::span<const PlacedFace> known, std::span<const PlacedFace> others) {
  LargeVector<PlacedFace> result(known.size() + others.size());
  auto end = result.begin();
  auto next = known.begin();
  for (const PlacedFace other : others) {
    const auto from = next;
    while (next != known.end() && next->place() <= other.place()) ++next;
    end = std::copy(from, next, end);
    *end++ = other;
  }
  std::copy(next, known.end(), end);
  return result;
}

std::vector<std::uint32_t> faces_beyond(std::span<const PlacedFace> known, std::size_t face_count) {
  std::vector<std::uint8_t> is_known(face_count);
  for (const PlacedFace placed : known) is_known[placed.face()] = 1;
  std::vector<std::uint32_t> others;
  for (std::uint32_t face = 0; face < face_count; ++face)
    if (is_known[face] == 0) others.push_back(face);
  return others;
}

}  // namespace algebra3d::curve_order
