#include "algebra3d/halfedge/edge_numbers.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

template <typename Layout>
EdgeNumbers::EdgeNumbers(const HalfedgeMesh<Layout>& mesh) {
  const std::size_t word_count = (mesh.halfedge_count() + kBits - 1) / kBits;
  is_first_.resize(word_count);
  counts_.resize(word_count);
  for (std::size_t word = 0; word < word_count; ++word) {
    counts_[word] = static_cast<std::uint32_t>(count_);
    std::uint64_t bits = 0;
    const std::size_t end = std::min(mesh.halfedge_count() - word * kBits, kBits);
    for (std::size_t i = 0; i < end; ++i) {
      const HalfedgeId h(word * kBits + i);
      if (first_along(mesh, h) == h) bits |= std::uint64_t{1} << i;
    }
    is_first_[word] = bits;
    count_ += static_cast<std::size_t>(std::popcount(bits));
    while (samples_.size() * kBits < count_) samples_.push_back(static_cast<std::uint32_t>(word));
  }
  if (word_count > 0) samples_.push_back(static_cast<std::uint32_t>(word_count - 1));
}

HalfedgeId EdgeNumbers::first_halfedge(EdgeId edge) const {
  assert(edge.index() < count_);
  const std::size_t sample = edge.index() / kBits;
  const auto first = counts_.begin() + samples_[sample] + 1, last = counts_.begin() + samples_[sample + 1] + 1;
  const auto after = std::upper_bound(first, last, edge.index());
  const auto word = static_cast<std::size_t>(after - counts_.begin()) - 1;
  std::uint64_t bits = is_first_[word];
  for (std::uint32_t skipped = counts_[word]; skipped < edge.index(); ++skipped) bits &= bits - 1;
  return HalfedgeId(word * kBits + static_cast<std::size_t>(std::countr_zero(bits)));
}

template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<TriangleLayout>&);
template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<PolygonLayout>&);

}  // namespace algebra3d
