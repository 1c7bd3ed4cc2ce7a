#include "algebra3d/kernel/rounding/detail/vertex_fan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d {
namespace {

/// No less than the length of a vector.
double sum_of_sizes(const Vec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

Vec3 sizes(const Vec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

double norm(const Vec3& v) {
  return std::sqrt(dot(v, v));
}

/// The answer of an estimate in doubles to a question.
enum class Certainty : std::uint8_t { no, unknown, yes };

Certainty is_positive(double value, double error) {
  return value > error ? Certainty::yes : value < -error ? Certainty::no : Certainty::unknown;
}
Certainty both(Certainty a, Certainty b) {
  return std::min(a, b);
}
Certainty either(Certainty a, Certainty b) {
  return std::max(a, b);
}

/// Bounds the error of a scalar or cross product of differences, and that of a scalar product with it, by the sums of
/// the sizes of their coordinates: no more than ten roundings.
constexpr double kProductError = 0x1p-49;

}  // namespace

bool VertexFan::surround(const TriangleStars& stars, std::uint32_t vertex, std::size_t most_neighbours) {
  vertex_ = vertex;
  sides_.clear();
  stars.for_each_at(vertex, [&](std::uint32_t triangle) {
    const IndexTriangle& t = stars[triangle];
    const auto at = static_cast<std::size_t>(std::ranges::find(t, vertex) - t.begin());
    sides_.emplace_back(t[(at + 1) % 3], t[(at + 2) % 3]);
  });
  const std::size_t count = sides_.size();
  if (count < 3 || count > most_neighbours) return false;
  ring_.clear();
  // The side that follows is mostly the next one.
  for (std::size_t side = 0; ring_.size() < count;) {
    ring_.push_back(sides_[side].first);
    const std::uint32_t end = sides_[side].second;
    std::size_t tried = 0;
    do {
      side = side + 1 == count ? 0 : side + 1;
    } while (sides_[side].first != end && ++tried < count);
    if (sides_[side].first != end || (side == 0) != (ring_.size() == count)) return false;
  }
  sorted_ = ring_;
  std::ranges::sort(sorted_);
  return std::ranges::adjacent_find(sorted_) == sorted_.end();
}

void VertexFan::measure(const TriangleStars& stars, double tolerance) {
  tolerance_ = tolerance;
  const std::size_t count = ring_.size();
  const Vec3& middle = stars.rounded_place(vertex_);
  places_.resize(count);
  spokes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    places_[i] = stars.rounded_place(ring_[i]);
    spokes_[i] = places_[i] - middle;
  }
  // The normal of a new triangle is that of the sector and the product of its side and the spoke.
  const double widened = (1 + 0x1p-40) * tolerance;
  sectors_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &u = spokes_[i], &v = spokes_[next(i)];
    const Vec3 first{u.y * v.z, u.z * v.x, u.x * v.y}, second{u.z * v.y, u.x * v.z, u.y * v.x};
    const Vec3 normal = first - second;
    sectors_[i] = {normal, sizes(first) + sizes(second), widened * sum_of_sizes(normal), widened * sum_of_sizes(v - u)};
  }
  last_bent_ = 0;
}

double VertexFan::volume_error(const Sector& sector, const Vec3& spoke) const {
  const Vec3 size = sizes(spoke);
  return detail::kOrient3dError * dot(size, sector.magnitude) +
         detail::kUnderflowError * (1 + (size.x + size.y + size.z));
}

bool VertexFan::bends(std::size_t target) {
  const Vec3& spoke = spokes_[target];
  const double reach = sum_of_sizes(spoke);
  for (std::size_t tried = 0, i = last_bent_; tried < ring_.size(); ++tried, i = next(i)) {
    if (is_at(i, target)) continue;
    const Sector& sector = sectors_[i];
    const double most = sector.fixed + sector.per_reach * reach + volume_error(sector, spoke);
    if (!(std::abs(dot(sector.normal, spoke)) > most)) continue;
    last_bent_ = i;
    return true;
  }
  return false;
}

std::optional<double> VertexFan::least_height(std::size_t target) const {
  const Vec3& w = spokes_[target];  // the vertex is the origin
  double least = std::numeric_limits<double>::max();
  Certainty is_near = Certainty::no;
  for (std::size_t i = next(target); next(i) != target; i = next(i)) {
    const Vec3 &a = spokes_[i], &b = spokes_[next(i)];
    const Vec3 to_a = places_[i] - places_[target], to_b = places_[next(i)] - places_[target], side = to_b - to_a;
    const Vec3 normal = cross(to_a, to_b);
    const double size = norm(normal), error = kProductError * sum_of_sizes(to_a) * sum_of_sizes(to_b);

    const double off = std::abs(dot(sectors_[i].normal, w)) - tolerance_ * size;
    const double off_error = volume_error(sectors_[i], w) + tolerance_ * error;
    if (off > off_error) return 0;
    const auto is_along = [&](const Vec3& u, const Vec3& v) {
      return is_positive(dot(cross(u, v), normal), error * sum_of_sizes(u) * sum_of_sizes(v));
    };
    const Certainty is_upright = is_along(a, b);
    if (is_upright == Certainty::no) return 0;
    if (off > -off_error || is_upright == Certainty::unknown) return std::nullopt;

    least = std::min(least, size / std::sqrt(std::max({dot(to_a, to_a), dot(to_b, to_b), dot(side, side)})));
    if (is_near == Certainty::yes) continue;
    is_near = either(is_near, both(is_along(w, a), is_along(b, w)));
    const auto is_on = [&](const Vec3& edge) {
      const double product_error = kProductError * sum_of_sizes(w) * sum_of_sizes(edge);
      return both(is_positive(-dot(w, edge), product_error),
                  is_positive(tolerance_ * norm(edge) - norm(cross(w, edge)), product_error));
    };
    is_near = either(is_near, either(is_on(to_a), is_on(to_b)));
  }
  if (is_near == Certainty::unknown) return std::nullopt;
  return is_near == Certainty::yes ? least : 0;
}

}  // namespace algebra3d
