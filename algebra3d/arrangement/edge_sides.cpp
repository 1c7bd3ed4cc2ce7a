#include "algebra3d/arrangement/edge_sides.h"

#include <utility>

#include "algebra3d/exact/predicates_filter.h"

namespace algebra3d::arrangement {
namespace {

std::size_t hash_of(const std::array<std::uint32_t, 4>& numbers) {
  std::uint64_t hash = 0;
  for (const std::uint32_t number : numbers) hash = (hash ^ number) * 0x9E3779B97F4A7C15U;
  return hash >> 32U;
}

}  // namespace

int EdgeSides::side(const NumberedEdge& edge, const NumberedEdge& other) {
  const bool are_doubles = edge.a.is_double() && edge.b.is_double() && other.a.is_double() && other.b.is_double();
  if (are_doubles) return orient3d(edge.a, edge.b, other.a, other.b);
  const int rounded = detail::filter_rounded_orient3d(edge.a.approx, edge.b.approx, other.a.approx, other.b.approx);
  if (rounded != detail::kUndecided) {
    detail::count_call();
    return rounded;
  }
  // Two edges that change places are an even permutation; the ends of one edge are not.
  std::array<std::uint32_t, 4> numbers{edge.number_of_a, edge.number_of_b, other.number_of_a, other.number_of_b};
  int sign = 1;
  for (const std::size_t i : {0U, 2U})
    if (numbers[i] > numbers[i + 1]) {
      std::swap(numbers[i], numbers[i + 1]);
      sign = -sign;
    }
  if (numbers[0] > numbers[2]) {
    std::swap(numbers[0], numbers[2]);
    std::swap(numbers[1], numbers[3]);
  }
  if (known_.empty()) known_.resize(kPlaces);
  Known& known = known_[hash_of(numbers) % kPlaces];
  if (known.numbers != numbers) known = {numbers, sign * orient3d(edge.a, edge.b, other.a, other.b)};
  return sign * known.side;
}

}  // namespace algebra3d::arrangement
