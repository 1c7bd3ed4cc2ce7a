#include "algebra3d/kernel/distance/detail/exact_closest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>
#include <utility>

#include "algebra3d/kernel/distance/detail/half_space.h"
#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d::distances {
namespace {

/// At most so many elements, in place: the numbers below are few, and would cost more to allocate than to compute.
template <typename T, std::size_t kCapacity>
class ShortList {
 public:
  void push_back(T element) { elements_[count_++] = std::move(element); }
  std::size_t size() const { return count_; }
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return elements_.data() + count_; }

 private:
  std::array<T, kCapacity> elements_;
  std::size_t count_ = 0;
};

/// The corners of a simplex as rationals, and those that a feature has.
using Corners = ShortList<RationalVec3, 3>;

Corners corners_of(const Simplex& simplex) {
  Corners corners;
  for (std::size_t i = 0; i < simplex.size; ++i) corners.push_back(simplex.corners[i].rational());
  return corners;
}

Corners corners_of(const Corners& all, Feature feature) {
  Corners corners;
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((feature >> i & 1) != 0) corners.push_back(all[i]);
  return corners;
}

/// Up to four unknowns: the weights of two corners of each simplex.
constexpr std::size_t kMostUnknowns = 4;
using Row = ShortList<Rational, kMostUnknowns + 1>;

/// Solves a symmetric system of equations by elimination; nothing if it is singular. The matrix is one of inner
/// products, so no pivot is 0 unless it is.
std::optional<Row> solved(ShortList<Row, kMostUnknowns> rows) {
  const std::size_t count = rows.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (rows[i][i].sign() == 0) return std::nullopt;
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i || rows[j][i].sign() == 0) continue;
      const Rational factor = rows[j][i] / rows[i][i];
      for (std::size_t k = i; k <= count; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  Row solution;
  for (std::size_t i = 0; i < count; ++i) solution.push_back(rows[i][count] / rows[i][i]);
  return solution;
}

/// The point of the affine hull of `corners` with the weights, that of the first corner left out, from `begin` on;
/// nothing if a weight is negative: then the point lies outside of the feature.
std::optional<RationalVec3> weighted(const Corners& corners, const Rational* begin) {
  RationalVec3 point = corners[0];
  Rational first_weight = 1;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Rational& weight = begin[i - 1];
    if (weight.sign() < 0) return std::nullopt;
    first_weight -= weight;
    point = point + weight * (corners[i] - corners[0]);
  }
  if (first_weight.sign() < 0) return std::nullopt;
  return point;
}

/// The points of the affine hulls of two features that are nearest to each other, if each lies in its feature. Nothing
/// if there are several such pairs: then smaller features have one of them.
std::optional<ExactClosest> closest_of_features(const Corners& a, const Corners& b) {
  ShortList<RationalVec3, kMostUnknowns> directions;
  for (std::size_t i = 1; i < a.size(); ++i) directions.push_back(a[i] - a[0]);
  for (std::size_t i = 1; i < b.size(); ++i) directions.push_back(b[0] - b[i]);
  const RationalVec3 to_second = b[0] - a[0];
  ShortList<Row, kMostUnknowns> rows;
  for (const RationalVec3& each : directions) {
    Row row;
    for (const RationalVec3& direction : directions) row.push_back(dot(each, direction));
    row.push_back(dot(each, to_second));
    rows.push_back(std::move(row));
  }
  const std::optional<Row> weights = solved(std::move(rows));
  if (!weights) return std::nullopt;
  std::optional<RationalVec3> first = weighted(a, weights->begin()),
                              second = weighted(b, weights->begin() + (a.size() - 1));
  if (!first || !second) return std::nullopt;
  const RationalVec3 between = *second - *first;
  return ExactClosest{*std::move(first), *std::move(second), dot(between, between)};
}

/// True if all corners but those of a feature lie in a half-space.
bool are_in(const HalfSpace& half_space, const Simplex& simplex, Feature but) {
  for (std::size_t i = 0; i < simplex.size; ++i)
    if ((but >> i & 1) == 0 && !half_space.has(simplex.corners[i])) return false;
  return true;
}

/// True if no points of the simplices are nearer to each other: between convex sets, the planes through the two points
/// across their connection separate them. The two features lie in these planes.
bool are_closest(const Simplex& a, Feature of_a, const Simplex& b, Feature of_b, const ExactClosest& points) {
  return are_in({points.second, points.second - points.first}, b, of_b) &&
         are_in({points.first, points.first - points.second}, a, of_a);
}

class ClosestSearch {
 public:
  ClosestSearch(const Simplex& a, const Simplex& b)
      : a_(a), b_(b), corners_of_a_(corners_of(a)), corners_of_b_(corners_of(b)) {}

  std::optional<ExactClosest> try_features(Feature first, Feature second) const {
    std::optional<ExactClosest> points =
        closest_of_features(corners_of(corners_of_a_, first), corners_of(corners_of_b_, second));
    if (points && !are_closest(a_, first, b_, second, *points)) points.reset();
    return points;
  }

  /// Small features first, which take the fewest operations.
  ExactClosest try_all() const {
    for (int corner_count = 2; corner_count <= 6; ++corner_count)
      for (unsigned first = 1; first < 1U << a_.size; ++first)
        for (unsigned second = 1; second < 1U << b_.size; ++second) {
          if (std::popcount(first) + std::popcount(second) != corner_count) continue;
          if (std::optional<ExactClosest> points =
                  try_features(static_cast<Feature>(first), static_cast<Feature>(second)))
            return *std::move(points);
        }
    assert(false && "convex sets have closest points");
    return {};
  }

 private:
  const Simplex &a_, &b_;
  Corners corners_of_a_, corners_of_b_;
};

}  // namespace

ExactClosest exact_closest(const Simplex& a, const Simplex& b, const ClosestFeatures& likely) {
  const ClosestSearch search(a, b);
  if (likely.first != 0 && likely.second != 0)
    if (std::optional<ExactClosest> points = search.try_features(likely.first, likely.second))
      return *std::move(points);
  return search.try_all();
}

}  // namespace algebra3d::distances
