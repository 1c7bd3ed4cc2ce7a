#include "algebra3d/kernel/repair/detail/generalized_winding_number.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/disjoint_ids.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

constexpr std::size_t kLeafTriangles = 16;

bool is_outside(const Box3& box, const Vec3& p) {
  return p.x < box.min.x || p.y < box.min.y || p.z < box.min.z || p.x > box.max.x || p.y > box.max.y || p.z > box.max.z;
}

constexpr auto ends_of = [](const auto& edge) { return std::tuple(edge.from, edge.to); };

/// Adds up edges that are sorted by their ends; those that cancel each other vanish.
template <typename Edges>
void add_up(Edges& edges) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size();) {
    auto sum = edges[i];
    for (++i; i < edges.size() && edges[i].from == sum.from && edges[i].to == sum.to; ++i) sum.count += edges[i].count;
    if (sum.count != 0) edges[kept++] = sum;
  }
  edges.resize(kept);
}

}  // namespace

GeneralizedWindingNumbers::GeneralizedWindingNumbers(const IndexedSoup& soup) : soup_(soup) {
  find_components();
  for (const FaceId triangle : soup.triangles.ids()) order_.push_back(triangle);
  if (!order_.empty()) add_part(0, order_.size());
}

/// Triangles that have a corner in common, or are connected by others, are one component.
void GeneralizedWindingNumbers::find_components() {
  DisjointIds<VertexId> sets(soup_.points.size());
  for (const TriangleMesh::Triangle& t : soup_.triangles) {
    sets.unite(VertexId(t[0]), VertexId(t[1]));
    sets.unite(VertexId(t[0]), VertexId(t[2]));
  }
  IdVector<VertexId, ComponentId> known(soup_.points.size());
  IdVector<ComponentId, Box3> boxes;
  for (const FaceId triangle : soup_.triangles.ids()) {
    ComponentId& component = known[sets.find(VertexId(soup_.triangles[triangle][0]))];
    if (component.is_none()) {
      component = boxes.next_id();
      boxes.push_back({});
    }
    for (std::size_t i = 0; i < 3; ++i) boxes[component].extend(soup_.corner(triangle, i));
    component_of_.push_back(component);
  }
  for (const Box3& box : boxes) middles_.push_back(0.5 * box.min + 0.5 * box.max);
}

/// Orders the triangles of a part, so that it can be cut in two at the place that is given. Components are not cut as
/// long as there are several: closed ones have no boundary.
std::size_t GeneralizedWindingNumbers::halve(std::span<FaceId> triangles, std::size_t axis) const {
  const std::size_t half = triangles.size() / 2;
  const auto at = [&](std::size_t place) { return triangles.begin() + static_cast<std::ptrdiff_t>(place); };
  const auto of_component = [&](FaceId triangle) {
    const ComponentId component = component_of_[triangle];
    return std::pair(middles_[component][axis], component);
  };
  std::ranges::nth_element(triangles, at(half), {}, of_component);
  const auto middle = of_component(triangles[half]);
  const auto comes_before = [&](FaceId triangle) { return of_component(triangle) < middle; };
  const auto comes_not_behind = [&](FaceId triangle) { return of_component(triangle) <= middle; };
  const auto begin = static_cast<std::size_t>(std::ranges::partition(triangles, comes_before).begin() - at(0));
  const auto end =
      static_cast<std::size_t>(std::ranges::partition(triangles.subspan(begin), comes_not_behind).begin() - at(0));
  if (begin > 0 && (half - begin <= end - half || end == triangles.size())) return begin;
  if (end < triangles.size()) return end;
  std::ranges::nth_element(triangles, at(half), {},
                           [&](FaceId triangle) { return std::pair(soup_.middle(triangle)[axis], triangle); });
  return half;
}

GeneralizedWindingNumbers::Boundary GeneralizedWindingNumbers::boundary_of(std::span<const FaceId> triangles) const {
  Boundary edges;
  for (const FaceId triangle : triangles) {
    const TriangleMesh::Triangle& t = soup_.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from(t[i]), to(t[(i + 1) % 3]);
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::ranges::sort(edges, {}, ends_of);
  add_up(edges);
  return edges;
}

/// Adds the part with its children; gives its boundary.
GeneralizedWindingNumbers::Boundary GeneralizedWindingNumbers::add_part(std::size_t begin, std::size_t end) {
  poll_interruption();
  const std::size_t number = parts_.size();
  Part part{.box = {}, .begin = begin, .end = end};
  const std::span<FaceId> triangles = std::span(order_).subspan(begin, end - begin);
  for (const FaceId triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) part.box.extend(soup_.corner(triangle, i));
  parts_.push_back(part);
  Boundary boundary;
  if (triangles.size() <= kLeafTriangles) {
    boundary = boundary_of(triangles);
  } else {
    const Vec3 extent = part.box.max - part.box.min;
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t half = begin + halve(triangles, axis);
    const Boundary first = add_part(begin, half), second = add_part(half, end);
    std::ranges::merge(first, second, std::back_inserter(boundary), {}, ends_of, ends_of);
    add_up(boundary);
  }
  Part& made = parts_[number];
  made.behind = parts_.size();
  made.has_cone = boundary.size() < triangles.size();
  made.boundary_begin = boundaries_.size();
  if (made.has_cone) boundaries_.insert(boundaries_.end(), boundary.begin(), boundary.end());
  made.boundary_end = boundaries_.size();
  return boundary;
}

/// A sum of angles, each given by a vector in the plane: the product of these as complex numbers has the sum as its
/// angle, but for whole turns, which are counted. One arc tangent serves for all of them.
class GeneralizedWindingNumbers::AngleSum {
 public:
  /// Adds atan2(y, x).
  void add(double y, double x) {
    const double real = real_ * x - imaginary_ * y;
    double imaginary = real_ * y + imaginary_ * x;
    const double size = std::abs(real) + std::abs(imaginary);
    if (!(size > kSmallest && size < kLargest)) return add_apart(y, x);
    // Angles up to half a turn of the same sign: together they are more if the sign of the product is the other one.
    const bool is_negative = std::signbit(y);
    if (is_negative == std::signbit(imaginary_)) {
      const bool is_full = imaginary == 0 && x < 0 && real_ < 0;
      if (is_negative ? imaginary > 0 || is_full : imaginary < 0 || is_full)
        turns_ += is_negative ? -1 : 1;
      else if (imaginary == 0)  // half a turn is positive or negative, too
        imaginary = std::copysign(imaginary, y);
    }
    real_ = real;
    imaginary_ = imaginary;
  }

  double total() const { return std::atan2(imaginary_, real_) + 2 * std::numbers::pi * turns_ + apart_; }

 private:
  static constexpr double kSmallest = 1e-100, kLargest = 1e100;

  /// When the product becomes too large or too small.
  void add_apart(double y, double x) {
    apart_ += std::atan2(imaginary_, real_) + std::atan2(y, x);
    real_ = 1;
    imaginary_ = 0;
  }

  double real_ = 1, imaginary_ = 0;
  int turns_ = 0;
  double apart_ = 0;
};

/// Adds half the solid angle of a triangle, that many times; negative: turned over. A normal points away from places
/// that see it from inside.
void GeneralizedWindingNumbers::add_half_angle(VertexId i, VertexId j, VertexId k, const Vec3& point, int count,
                                               AngleSum& sum) const {
  const Vec3 a = soup_.point(i) - point, b = soup_.point(j) - point, c = soup_.point(k) - point;
  const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  const double y = dot(a, cross(b, c));
  const double x = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  for (int n = std::abs(count); n > 0; --n) sum.add(count < 0 ? -y : y, x);
}

void GeneralizedWindingNumbers::add_triangles(const Part& part, const Vec3& point, AngleSum& sum) const {
  for (std::size_t at = part.begin; at < part.end; ++at) {
    const auto& [i, j, k] = soup_.triangles[order_[at]];
    add_half_angle(VertexId(i), VertexId(j), VertexId(k), point, 1, sum);
  }
  angle_count_ += part.end - part.begin;
}

/// The tip of the cone is an end of its first edge.
void GeneralizedWindingNumbers::add_cone(const Part& part, const Vec3& point, AngleSum& sum) const {
  for (std::size_t at = part.boundary_begin; at < part.boundary_end; ++at) {
    const BoundaryEdge& edge = boundaries_[at];
    const VertexId tip = boundaries_[part.boundary_begin].from;
    if (edge.from != tip && edge.to != tip) add_half_angle(tip, edge.from, edge.to, point, edge.count, sum);
  }
  angle_count_ += part.boundary_end - part.boundary_begin;
}

double GeneralizedWindingNumbers::at(const Vec3& point) const {
  AngleSum sum;
  for (std::size_t number = 0; number < parts_.size();) {
    const Part& part = parts_[number];
    const bool is_leaf = part.behind == number + 1;
    if (part.has_cone && is_outside(part.box, point)) {
      add_cone(part, point, sum);
      number = part.behind;
    } else if (is_leaf) {
      add_triangles(part, point, sum);
      number = part.behind;
    } else {
      ++number;
    }
  }
  return sum.total() / (2 * std::numbers::pi);
}

}  // namespace algebra3d
