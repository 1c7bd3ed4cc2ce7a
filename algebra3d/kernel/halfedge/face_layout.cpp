#include "algebra3d/kernel/halfedge/face_layout.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/shrink.h"

namespace algebra3d {

PolygonLayout::PolygonLayout(LargeVector<std::uint32_t> starts) {
  starts_ = std::move(starts);
  assert(!starts_.empty() && starts_.front() == 0);
  assert(std::ranges::adjacent_find(starts_, std::greater_equal<>()) == starts_.end());
  const std::size_t face_count = starts_.size() - 1;
  if (face_count == 0) {
    starts_ = LargeVector<std::uint32_t>();  // `{}` would keep the memory
    return;
  }
  const std::uint32_t first_degree = starts_[1];
  bool is_common = true;
  for (std::size_t f = 1; f < face_count && is_common; ++f) is_common = starts_[f + 1] - starts_[f] == first_degree;
  if (is_common) {
    set_degree(first_degree);
    starts_ = LargeVector<std::uint32_t>();  // `{}` would keep the memory
    return;
  }
  shrink(starts_);
  faces_.reserve(starts_.back());
  for (std::size_t f = 0; f < face_count; ++f) faces_.resize(starts_[f + 1], static_cast<std::uint32_t>(f));
}

std::vector<std::string> layout_violations(const PolygonLayout& layout, std::size_t halfedge_count) {
  if (const std::uint32_t degree = layout.common_degree(); degree != 0) {
    if (halfedge_count % degree == 0) return {};
    return {fmt::format("{} half-edges, expected a multiple of {}", halfedge_count, degree)};
  }
  const LargeVector<std::uint32_t>&starts = layout.face_starts(), &faces = layout.faces_of_halfedges();
  if (starts.empty() && faces.empty() && halfedge_count == 0) return {};
  std::vector<std::string> violations;
  if (starts.empty() || starts.front() != 0 || starts.back() != halfedge_count ||
      std::ranges::adjacent_find(starts, std::greater_equal<>()) != starts.end())
    return {fmt::format("the starts of the faces do not divide {} half-edges", halfedge_count)};
  if (faces.size() != halfedge_count)
    return {fmt::format("{} faces of half-edges, expected one per half-edge ({})", faces.size(), halfedge_count)};
  for (std::size_t f = 0; f + 1 < starts.size(); ++f)
    for (std::uint32_t h = starts[f]; h < starts[f + 1]; ++h)
      if (faces[h] != f)
        violations.push_back(fmt::format("half-edge {}: belongs to face {}, face {} is stored", h, f, faces[h]));
  return violations;
}

std::vector<std::string> layout_violations(const TriangleLayout& /*layout*/, std::size_t halfedge_count) {
  if (halfedge_count % 3 == 0) return {};
  return {fmt::format("{} half-edges, expected a multiple of 3", halfedge_count)};
}

}  // namespace algebra3d
