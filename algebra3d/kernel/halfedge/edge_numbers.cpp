#include "algebra3d/halfedge/edge_numbers.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {
namespace {

/// The place of the n-th set bit, from 0, which must be there: its byte by the counts of all bytes at once, then halves
/// of the byte. Without branches, which nobody could predict. Source: [vigna2008], section 5.
std::size_t place_of_set_bit(std::uint64_t bits, std::uint64_t n) {
  constexpr std::uint64_t kOnes = 0x0101010101010101, kHighBits = 0x8080808080808080;
  constexpr std::uint64_t kCountsOfNibbles = 0x4332322132212110;  // of set bits in 0, 1, ... 15
  std::uint64_t counts = bits - ((bits >> 1) & 0x5555555555555555);
  counts = (counts & 0x3333333333333333) + ((counts >> 2) & 0x3333333333333333);
  counts = ((counts + (counts >> 4)) & 0x0F0F0F0F0F0F0F0F) * kOnes;  // up to each byte
  const std::uint64_t bytes_before = (((((n * kOnes) | kHighBits) - counts) & kHighBits) >> 7) * kOnes >> 56;
  std::uint64_t place = 8 * bytes_before;
  n -= ((counts << 8) >> place) & 0xFF;
  std::uint64_t byte = (bits >> place) & 0xFF;
  for (std::uint64_t width = 4; width > 0; width /= 2) {
    const std::uint64_t low = byte & ((std::uint64_t{1} << width) - 1);
    const std::uint64_t count = (kCountsOfNibbles >> (4 * low)) & 0xF;
    const std::uint64_t is_above = n >= count ? 1 : 0;
    n -= is_above * count;
    place += is_above * width;
    byte >>= is_above * width;
  }
  return place;
}

}  // namespace

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
  // Mostly a word or two further on; where edges are sparse, a binary search among those up to the next sample.
  constexpr int kSteps = 4;
  std::size_t word = samples_[edge.index() / kBits];
  const std::size_t last = samples_[edge.index() / kBits + 1];
  for (int step = 0; step < kSteps && word < last && counts_[word + 1] <= edge.index(); ++step) ++word;
  if (word < last && counts_[word + 1] <= edge.index()) {
    const auto first = counts_.begin();
    const auto after = std::upper_bound(first + word + 1, first + last + 1, edge.index());
    word = static_cast<std::size_t>(after - first) - 1;
  }
  return HalfedgeId(word * kBits + place_of_set_bit(is_first_[word], edge.index() - counts_[word]));
}

template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<TriangleLayout>&);
template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<PolygonLayout>&);

}  // namespace algebra3d
