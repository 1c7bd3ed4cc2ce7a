#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <variant>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/spatial_relations/relation.h"

/// Relations by brute force with CGAL's exact kernel: a sample in every cell of the overlay of two sets, each located
/// by tests of all triangles. Shares neither code nor method with the layer.
namespace algebra3d::brute_force {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Vector = Kernel::Vector_3;

inline Point to_cgal(const PointRef& point) {
  const auto number = [&](std::size_t axis) {
    return Kernel::FT(Kernel::Exact_kernel::FT(point.coordinate(axis).text()));
  };
  return {number(0), number(1), number(2)};
}

enum class Place : std::uint8_t { outside, boundary, inside };

/// A closed set: points, a segment, or triangles of a surface or solid.
struct Set {
  std::vector<Point> points;
  std::vector<Segment> segments;
  std::vector<Triangle> triangles;
  std::vector<Segment> boundary_edges;  // of a surface
  bool is_solid = false;

  bool is_empty() const { return points.empty() && segments.empty() && triangles.empty(); }

  static Set of_mesh(const TriangleMesh& mesh, bool is_solid) {
    Set set;
    set.is_solid = is_solid;
    std::map<std::array<std::uint32_t, 2>, int> edges;
    std::vector<Point> corners;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) corners.push_back(to_cgal(mesh.point(VertexId(v))));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto t = mesh.triangle(FaceId(f));
      set.triangles.emplace_back(corners[t[0]], corners[t[1]], corners[t[2]]);
      for (std::size_t i = 0; i < 3; ++i) ++edges[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
    }
    for (const auto& [edge, count] : edges)
      if (count == 1 && !is_solid) set.boundary_edges.emplace_back(corners[edge[0]], corners[edge[1]]);
    return set;
  }

  Place place(const Point& p) const {
    if (std::ranges::find(points, p) != points.end()) return Place::inside;
    for (const Segment& segment : segments)
      if (segment.has_on(p)) return p == segment.source() || p == segment.target() ? Place::boundary : Place::inside;
    const bool is_on_triangle = std::ranges::any_of(triangles, [&](const Triangle& t) { return t.has_on(p); });
    if (is_solid) return is_on_triangle ? Place::boundary : is_within(p) ? Place::inside : Place::outside;
    if (!is_on_triangle) return Place::outside;
    const bool is_on_edge = std::ranges::any_of(boundary_edges, [&](const Segment& edge) { return edge.has_on(p); });
    return is_on_edge ? Place::boundary : Place::inside;
  }

 private:
  /// For a point off the triangles: an odd number of them along a ray that meets no edge.
  bool is_within(const Point& p) const {
    for (int attempt = 0;; ++attempt) {
      const Point far = p + Vector(1009 + 7 * attempt, 907 - 13 * attempt, 1301 + 3 * attempt);
      int crossings = 0;
      bool is_degenerate = false;
      for (const Triangle& t : triangles) {
        const auto sign = [&](const Point& x) { return CGAL::orientation(t[0], t[1], t[2], x); };
        if (sign(p) == CGAL::ZERO || sign(p) == sign(far)) continue;
        std::array<CGAL::Orientation, 3> turns;
        for (int i = 0; i < 3; ++i)
          turns[static_cast<std::size_t>(i)] = CGAL::orientation(p, far, t[i], t[(i + 1) % 3]);
        const bool has_left = std::ranges::find(turns, CGAL::POSITIVE) != turns.end();
        const bool has_right = std::ranges::find(turns, CGAL::NEGATIVE) != turns.end();
        if (has_left && has_right) continue;
        is_degenerate = is_degenerate || std::ranges::find(turns, CGAL::ZERO) != turns.end();
        ++crossings;
      }
      if (!is_degenerate) return crossings % 2 == 1;
    }
  }
};

struct Sample {
  Point point;
  int dimension;  // of the cell
};

/// Samples of all cells of the overlay that lie on one set or next to its triangles.
class Sampler {
 public:
  Sampler(const Set& own, const Set& other) : own_(own), other_(other) {}

  std::vector<Sample> samples() && {
    for (const Point& p : own_.points) add(p, 0);
    for (const Segment& segment : own_.segments) sample_segment(segment, cuts_of(segment));
    for (const Triangle& triangle : own_.triangles) sample_triangle(triangle);
    return std::move(samples_);
  }

 private:
  // Small against all distances between vertices, edges and planes of the grids of the tests.
  static constexpr double kWithinPlane = 0x1p-32, kOffPlane = 0x1p-46;

  void add(const Point& point, int dimension) { samples_.push_back({point, dimension}); }

  /// Takes apart what CGAL returns for a common part.
  struct Collector {
    using result_type = void;
    std::vector<Segment>& segments;
    std::vector<Point>& points;

    void operator()(const Point& p) const { points.push_back(p); }
    void operator()(const Segment& s) const { segments.push_back(s); }
    void operator()(const Triangle& t) const {
      for (int i = 0; i < 3; ++i) segments.emplace_back(t[i], t[i + 1]);
    }
    void operator()(const std::vector<Point>& polygon) const {
      for (std::size_t i = 0; i < polygon.size(); ++i)
        segments.emplace_back(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
  };

  template <typename Common>
  static void collect(const Common& common, std::vector<Segment>& segments, std::vector<Point>& points) {
    const Collector collector{segments, points};
    if (common) boost::apply_visitor(collector, *common);
  }

  std::vector<Point> cuts_of(const Segment& segment) const {
    std::vector<Segment> parts;
    std::vector<Point> points;
    for (const Triangle& t : other_.triangles)
      if (CGAL::do_intersect(segment, t)) collect(CGAL::intersection(segment, t), parts, points);
    for (const Triangle& t : other_.triangles)
      for (int i = 0; i < 3; ++i) {
        const Segment edge(t[i], t[i + 1]);
        if (CGAL::do_intersect(segment, edge)) collect(CGAL::intersection(segment, edge), parts, points);
      }
    for (const Segment& s : other_.segments)
      if (CGAL::do_intersect(segment, s)) collect(CGAL::intersection(segment, s), parts, points);
    for (const Point& p : other_.points)
      if (segment.has_on(p)) points.push_back(p);
    for (const Segment& part : parts) points.insert(points.end(), {part.source(), part.target()});
    return points;
  }

  /// The pieces of a segment between its cuts; visit(middle) for each.
  template <typename Visit>
  void for_each_piece(const Segment& segment, std::vector<Point> cuts, const Visit& visit) {
    cuts.insert(cuts.end(), {segment.source(), segment.target()});
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    for (const Point& p : cuts) add(p, 0);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) visit(CGAL::midpoint(cuts[i], cuts[i + 1]));
  }
  void sample_segment(const Segment& segment, const std::vector<Point>& cuts) {
    for_each_piece(segment, cuts, [&](const Point& middle) { add(middle, 1); });
  }

  void sample_triangle(const Triangle& triangle) {
    std::vector<Segment> segments;
    std::vector<Point> points;
    for (int i = 0; i < 3; ++i) segments.emplace_back(triangle[i], triangle[i + 1]);
    for (const Triangle& t : other_.triangles)
      if (CGAL::do_intersect(triangle, t)) collect(CGAL::intersection(triangle, t), segments, points);
    for (const Segment& s : other_.segments)
      if (CGAL::do_intersect(triangle, s)) collect(CGAL::intersection(triangle, s), segments, points);
    for (const Point& p : other_.points)
      if (triangle.has_on(p)) points.push_back(p);
    for (const Point& p : points) add(p, 0);
    const Vector normal = CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (const Segment& segment : segments) {
      std::vector<Segment> parts;
      std::vector<Point> cuts;
      for (const Point& p : points)
        if (segment.has_on(p)) cuts.push_back(p);
      for (const Segment& s : segments)
        if (CGAL::do_intersect(segment, s)) collect(CGAL::intersection(segment, s), parts, cuts);
      for (const Segment& part : parts) cuts.insert(cuts.end(), {part.source(), part.target()});
      const Vector aside = CGAL::cross_product(normal, segment.to_vector());
      for_each_piece(segment, cuts, [&](const Point& middle) {
        add(middle, 1);
        for (const double side : {kWithinPlane, -kWithinPlane}) sample_face(triangle, middle + side * aside, normal);
      });
    }
  }

  void sample_face(const Triangle& triangle, const Point& point, const Vector& normal) {
    if (!triangle.has_on(point)) return;
    add(point, 2);
    if (!own_.is_solid && !other_.is_solid) return;
    add(point + kOffPlane * normal, 3);
    add(point - kOffPlane * normal, 3);
  }

  const Set& own_;
  const Set& other_;
  std::vector<Sample> samples_;
};

inline SpatialRelation relation(const Set& a, const Set& b) {
  SpatialRelation result{false, false, true, true, -1, -1};
  std::vector<Sample> samples = Sampler(a, b).samples();
  const std::vector<Sample> others = Sampler(b, a).samples();
  samples.insert(samples.end(), others.begin(), others.end());
  for (const auto& [point, dimension] : samples) {
    const Place in_a = a.place(point), in_b = b.place(point);
    if (in_b == Place::outside && in_a != Place::outside) result.is_first_inside = false;
    if (in_a == Place::outside && in_b != Place::outside) result.is_second_inside = false;
    if (in_a == Place::outside || in_b == Place::outside) continue;
    result.do_meet = true;
    result.shared_dimension = std::max(result.shared_dimension, dimension);
    if (in_a == Place::inside && in_b == Place::inside) result.do_interiors_meet = true;
    if (in_a == Place::boundary && in_b == Place::boundary)
      result.shared_boundary_dimension = std::max(result.shared_boundary_dimension, dimension);
  }
  return result;
}

}  // namespace algebra3d::brute_force
