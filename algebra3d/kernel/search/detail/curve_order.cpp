#include "algebra3d/kernel/search/detail/curve_order.h"

#include "base/scheduler.h"

namespace algebra3d::curve_order {
namespace {

constexpr unsigned kDigitBits = 11, kRounds = 3;
constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;

constexpr std::size_t kFacesPerHistogram = 16384;
/// Up to so many, comparisons cost less than histograms.
constexpr std::size_t kFewFaces = 256;

unsigned digit(PlacedFace face, unsigned round) {
  return (face.place() >> (round * kDigitBits)) % kBuckets;
}

/// For each range of faces and each digit: the number of faces, then the place of the first one in the sorted order.
class Histograms {
 public:
  explicit Histograms(std::size_t face_count)
      : ranges_((face_count + kFacesPerHistogram - 1) / kFacesPerHistogram), counts_(ranges_ * kBuckets) {}

  /// Calls visit(counts, begin, end) for each range, in parallel.
  template <typename Visit>
  void for_each_range(std::size_t face_count, const Visit& visit) {
    parallel_for(ranges_, 1, [&](std::size_t range) {
      const std::size_t begin = range * kFacesPerHistogram;
      visit(std::span(counts_).subspan(range * kBuckets, kBuckets), begin,
            std::min(begin + kFacesPerHistogram, face_count));
    });
  }
  /// From counts to places. False if all faces have one digit.
  bool add_up(std::size_t face_count) {
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      const std::uint32_t before = sum;
      for (std::size_t range = 0; range < ranges_; ++range)
        sum += std::exchange(counts_[range * kBuckets + bucket], sum);
      if (sum - before == face_count) return false;
    }
    return true;
  }

 private:
  std::size_t ranges_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace

/// A round whose digit is the same everywhere is left out.
void sort_by_places(LargeVector<PlacedFace>& faces) {
  if (faces.size() < kFewFaces) {
    std::ranges::sort(faces);
    return;
  }
  LargeVector<PlacedFace> sorted(faces.size());
  Histograms histograms(faces.size());
  for (unsigned round = 0; round < kRounds; ++round) {
    histograms.for_each_range(faces.size(), [&](auto counts, std::size_t begin, std::size_t end) {
      std::ranges::fill(counts, 0U);
      for (std::size_t i = begin; i < end; ++i) ++counts[digit(faces[i], round)];
    });
    if (!histograms.add_up(faces.size())) continue;
    histograms.for_each_range(faces.size(), [&](auto places, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sorted[places[digit(faces[i], round)]++] = faces[i];
    });
    faces.swap(sorted);
  }
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
