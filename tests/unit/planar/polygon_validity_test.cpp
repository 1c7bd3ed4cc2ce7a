#include "algebra3d/kernel/planar/polygon_validity.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/plane_shapes.h"

namespace algebra3d {
namespace {

using namespace plane_shapes;

std::string defect_text(const Polygons& polygons) {
  const auto defect = polygon_defect(polygons);
  return defect.ok() ? defect->value_or("") : "error: " + defect.error().message;
}
std::string defect_of(const std::vector<Face>& faces) {
  return defect_text(polygons_of(faces));
}

TEST(PolygonDefect, of_one_cycle) {
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {1, 0, 0}}}}), "face 1, cycle 1 has 2 corners, expected at least 3");
  EXPECT_EQ(defect_of({{box(0, 0, 1, 1)}, {}}), "face 2 has no cycle");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}),
            "segment (1 0)-(1 0) of face 1, cycle 1 has no length");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}}}),
            "segment (0 0)-(0 0) of face 1, cycle 1 has no length");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}}}}),
            "segment (0 2)-(2 0) of face 1, cycle 1 crosses segment (0 0)-(2 2) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}}}}),
            "corner (1 1) of face 1, cycle 1 occurs twice");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}}}),
            "corner (2 0) of face 1, cycle 1 touches segment (0 0)-(4 0) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 2, 0}}}}),
            "segment (0 0)-(4 0) of face 1, cycle 1 overlaps segment (4 0)-(2 0) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}}}}),
            "segment (0 0)-(4 0) of face 1, cycle 1 overlaps segment (1 0)-(0 0) of face 1, cycle 1");
  // Two segments that cross in a corner of another cycle.
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 0, 0}}}, {{{2, 2, 0}, {3, 2, 0}, {4, 3, 0}}}}),
            "segment (0 4)-(4 0) of face 1, cycle 1 crosses segment (0 0)-(4 4) of face 1, cycle 1");
}

TEST(PolygonDefect, of_two_cycles) {
  EXPECT_EQ(defect_of({{box(0, 0, 4, 4), box(2, 2, 6, 3)}}),
            "segment (2 2)-(6 2) of face 1, cycle 2 crosses segment (4 0)-(4 4) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{box(0, 0, 4, 4)}, {box(4, 1, 6, 3)}}),
            "segment (4 3)-(4 1) of face 2, cycle 1 overlaps segment (4 0)-(4 4) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{box(0, 0, 4, 4), box(0, 0, 4, 4)}}),
            "segment (0 0)-(4 0) of face 1, cycle 2 overlaps segment (0 0)-(4 0) of face 1, cycle 1");
}

TEST(PolygonDefect, of_nesting) {
  EXPECT_EQ(defect_of({{box(0, 0, 4, 4), box(5, 1, 6, 3)}}),
            "the hole with segment (5 1)-(6 1) of face 1, cycle 2 does not lie inside the outer cycle");
  EXPECT_EQ(defect_of({{box(1, 1, 3, 3), box(0, 0, 4, 4)}}),
            "the hole with segment (0 0)-(4 0) of face 1, cycle 2 does not lie inside the outer cycle");
  EXPECT_EQ(
      defect_of({{box(0, 0, 9, 9), box(1, 1, 8, 8), box(3, 3, 5, 5)}}),
      "the hole with segment (3 3)-(5 3) of face 1, cycle 3 and the hole with segment (1 1)-(8 1) of face 1, cycle 2 "
      "have inner points in common");
  EXPECT_EQ(defect_of({{box(0, 0, 9, 9)}, {box(1, 1, 8, 8)}}),
            "segment (0 0)-(9 0) of face 1, cycle 1 and segment (1 1)-(8 1) of face 2, cycle 1 bound faces with common "
            "inner points");
  // Cycles that cross in corners of both.
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 4, 0}, {0, 4, 0}}},
                       {{{2, 0, 0}, {7, 2, 0}, {2, 4, 0}, {1, 2, 0}}}}),
            "segment (2 0)-(7 2) of face 2, cycle 1 crosses segment (4 0)-(4 4) of face 1, cycle 1");
  EXPECT_EQ(defect_of({{{{0, 0, 0}, {2, 0, 0}, {3, 2, 0}, {2, 4, 0}, {0, 4, 0}}},
                       {{{2, 0, 0}, {7, 2, 0}, {2, 4, 0}, {1, 2, 0}}}}),
            "segment (0 0)-(2 0) of face 1, cycle 1 and segment (2 0)-(7 2) of face 2, cycle 1 bound faces with common "
            "inner points");
  // A hole within a hole of another face that lies in the first one's hole.
  EXPECT_EQ(defect_of({{box(0, 0, 9, 9), box(1, 1, 8, 8), box(4, 4, 5, 5)}, {box(2, 2, 7, 7), box(3, 3, 6, 6)}})
                .substr(0, 29),
            "the hole with segment (4 4)-(");
}

TEST(PolygonDefect, touching_in_points_is_none) {
  EXPECT_EQ(defect_of({{box(0, 0, 8, 8), {{0, 4, 0}, {4, 3, 0}, {4, 5, 0}}, {{4, 4, 0}, {6, 3, 0}, {8, 4, 0}}}}), "");
  EXPECT_EQ(defect_of({{box(0, 0, 2, 2)}, {box(2, 2, 4, 4)}}), "");
  EXPECT_EQ(defect_of({{box(0, 0, 9, 9), box(1, 1, 8, 8)}, {{{1, 1, 0}, {8, 8, 0}, {2, 5, 0}}}}), "");
  EXPECT_EQ(defect_of(std::vector<Face>{}), "");
}

TEST(PolygonDefect, fractions_are_written_as_such) {
  Polygons polygons;
  const auto add = [&](const Rational& x, const Rational& y) {
    polygons.corners.push_back(ExactPoint(RationalVec3(x, y, Rational())));
  };
  add(Rational(0), Rational(0));
  add(Rational(1, 3), Rational(1, 3));
  add(Rational(0.5), Rational(0));
  add(Rational(0), Rational(1, 4));
  polygons.cycle_ends = {4};
  polygons.face_ends = {1};
  EXPECT_EQ(defect_text(polygons),
            "segment (0.5 0)-(0 0.25) of face 1, cycle 1 crosses segment (0 0)-(1/3 1/3) of face 1, cycle 1");
}

TEST(PolygonDefect, one_ulp_tells) {
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  EXPECT_EQ(defect_of({{box(0, 0, 4, 1)}, {{{1, above, 0}, {2, 2, 0}, {0, 2, 0}}}}), "");
  EXPECT_EQ(defect_of({{box(0, 0, 4, 1)}, {{{1, 1, 0}, {2, 2, 0}, {0, 2, 0}}}}), "");
  EXPECT_NE(defect_of({{box(0, 0, 4, 1)}, {{{1, below, 0}, {2, 2, 0}, {0, 2, 0}}}}), "");
}

/// One cycle of few corners on a small grid is simple or not, as CGAL's sweep finds.
TEST(PolygonDefect, agrees_with_cgal_on_random_cycles) {
  using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  int simple_count = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::size_t count = 3 + random() % 5;
    Cycle cycle;
    CGAL::Polygon_2<ExactKernel> oracle;
    for (std::size_t k = 0; k < count; ++k) {
      cycle.push_back({static_cast<double>(random() % 6), static_cast<double>(random() % 6), 0});
      oracle.push_back({cycle.back().x, cycle.back().y});
    }
    const bool is_simple = oracle.is_simple() && oracle.area() != 0;
    simple_count += is_simple ? 1 : 0;
    const std::string defect = defect_of({{cycle}});
    ASSERT_EQ(defect.empty(), is_simple) << defect << ", sample " << i;
  }
  EXPECT_GE(simple_count, 500);
}

TEST(PolygonDefect, can_be_interrupted) {
  std::mt19937_64 random(2);  // NOLINT(cert-msc51-cpp): the same in every run
  const std::atomic<bool> cancel{true};
  const auto defect = polygon_defect(polygons_of({{star(5000, 0.5, 1, random)}}), Monitor(&cancel));
  ASSERT_FALSE(defect.ok());
  EXPECT_EQ(defect.error().code, ErrorCode::interrupted);
}

TEST(Oriented, keeps_first_corners_and_order) {
  const Polygons polygons = polygons_of({{reversed(box(0, 0, 4, 4)), box(1, 1, 2, 2)}, {box(5, 5, 6, 6)}});
  const Polygons expected =
      polygons_of({{{{0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {{1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}}},
                   {box(5, 5, 6, 6)}});
  EXPECT_EQ(oriented(polygons), expected);
  EXPECT_EQ(oriented(expected), expected);
}

}  // namespace
}  // namespace algebra3d
