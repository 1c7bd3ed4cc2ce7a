// What polygon_defect says of random cycles in random faces, against CGAL's Boolean operations on polygons.
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "algebra3d/kernel/planar/polygon_validity.h"
#include "support/plane_shapes.h"

namespace algebra3d {
namespace {

using namespace plane_shapes;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using OraclePolygon = CGAL::Polygon_2<Kernel>;
using OracleSet = CGAL::Polygon_set_2<Kernel>;

OraclePolygon to_oracle(const Cycle& cycle) {
  OraclePolygon polygon;
  for (const Vec3& p : cycle) polygon.push_back({p.x, p.y});
  if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
  return polygon;
}

Kernel::FT area(const OracleSet& set) {
  std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  Kernel::FT sum = 0;
  for (const auto& part : parts) {
    sum += part.outer_boundary().area();
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) sum += hole->area();
  }
  return sum;
}

Kernel::FT common_area(OracleSet a, const OracleSet& b) {
  a.intersection(b);
  return area(a);
}

bool cross_or_overlap(const OraclePolygon& a, const OraclePolygon& b) {
  for (auto s = a.edges_begin(); s != a.edges_end(); ++s) {
    for (auto t = b.edges_begin(); t != b.edges_end(); ++t) {
      const auto common = CGAL::intersection(*s, *t);
      if (!common) continue;
      const auto* point = boost::get<Kernel::Point_2>(&*common);
      if (point == nullptr) return true;
      const auto is_end = [&](const Kernel::Segment_2& of) { return *point == of.source() || *point == of.target(); };
      if (!is_end(*s) && !is_end(*t)) return true;
    }
  }
  return false;
}

bool oracle_is_valid(const std::vector<Face>& faces) {
  std::vector<OraclePolygon> cycles;
  for (const Face& face : faces)
    for (const Cycle& cycle : face) cycles.push_back(to_oracle(cycle));
  for (std::size_t i = 0; i < cycles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cross_or_overlap(cycles[i], cycles[j])) return false;
  OracleSet covered;
  std::size_t next = 0;
  for (const Face& face : faces) {
    const OracleSet outer(cycles[next++]);
    OracleSet inside = outer;
    for (std::size_t hole = 1; hole < face.size(); ++hole) {
      const OracleSet removed(cycles[next++]);
      if (common_area(inside, removed) != area(removed)) return false;
      inside.difference(removed);
    }
    if (common_area(covered, inside) != 0) return false;
    covered.join(inside);
  }
  return true;
}

TEST(PolygonNesting, agrees_with_cgal_on_random_faces) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  int valid_count = 0, compared_count = 0;
  while (compared_count < 600) {
    // Triangles and quadrangles of three sizes, so that many lie in others.
    std::vector<Face> faces;
    for (std::size_t k = 0; k < 2 + random() % 3; ++k) {
      Cycle cycle;
      const auto size = static_cast<double>(std::size_t{2} << random() % 3);
      const Vec3 corner{static_cast<double>(random() % 4), static_cast<double>(random() % 4), 0};
      for (std::size_t i = 0; i < 3 + random() % 2; ++i)
        cycle.push_back(corner + Vec3{static_cast<double>(random() % 3) / 2 * size,
                                      static_cast<double>(random() % 3) / 2 * size, 0});
      OraclePolygon polygon;
      for (const Vec3& p : cycle) polygon.push_back({p.x, p.y});
      if (!polygon.is_simple() || polygon.area() == 0) continue;
      if (faces.empty() || random() % 2 == 0)
        faces.push_back({cycle});
      else
        faces.back().push_back(cycle);
    }
    if (faces.empty()) continue;
    ++compared_count;
    const bool is_valid = oracle_is_valid(faces);
    valid_count += is_valid ? 1 : 0;
    const auto defect = polygon_defect(polygons_of(faces));
    ASSERT_TRUE(defect.ok());
    ASSERT_EQ(!defect->has_value(), is_valid) << defect->value_or("") << ", sample " << compared_count;
  }
  EXPECT_GE(valid_count, 60);
}

}  // namespace
}  // namespace algebra3d
