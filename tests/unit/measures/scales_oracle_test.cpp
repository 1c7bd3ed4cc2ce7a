// Searches in rounded arithmetic before exact decisions, at all ratios of scale: sets of sizes, and at distances, from
// 2^-80 to 2^80, whose coordinates are doubles or not, against CGAL's distances over GMP rationals and against signs of
// rational determinants.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "algebra3d/values/measures/hausdorff_distance.h"
#include "algebra3d/values/measures/ray_hits.h"
#include "algebra3d/values/spatial_relations/boundary_faces.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/place_of_box.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "support/rounds.h"
#include "unit/distance/exact_distances.h"

namespace algebra3d {
namespace {

using namespace exact_distances;

int round_count() {
  return rounds(25);
}

Rational power_of_two(int exponent) {
  return Rational(std::ldexp(1.0, exponent));
}

/// A set for the layers, and what the oracle needs of it.
struct TestSet {
  enum class Kind { points, surface, solid } kind;
  std::vector<ExactPoint> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::optional<Surface3d> surface;
  std::optional<Volume3d> solid;

  SpatialSet set() const {
    if (kind == Kind::surface) return *surface;
    if (kind == Kind::solid) return *solid;
    return PointSet{points};
  }
  const Geometry& geometry() const { return kind == Kind::solid ? solid->geometry() : surface->geometry(); }
  /// Its boundary as points or triangles.
  std::vector<Corners> faces() const {
    std::vector<Corners> faces;
    if (kind == Kind::points)
      for (const ExactPoint& p : points) faces.push_back({point(p.rational())});
    for (const auto& triangle : triangles) {
      Corners& face = faces.emplace_back();
      for (const std::size_t corner : triangle) face.push_back(point(points[corner].rational()));
    }
    return faces;
  }
};

/// Sets of random sizes at random places.
class RandomSets {
 public:
  explicit RandomSets(unsigned seed) : random_(seed) {}

  /// At a place near a power of two, or at the origin; solids are tetrahedra.
  TestSet next() {
    // Some sizes are alike, so that sets meet.
    static constexpr int kSame = 3;
    const int size = below(kSame) == 0 ? last_size_ : exponent();
    last_size_ = size;
    const RationalVec3 place = below(3) == 0 ? RationalVec3() : vector(exponent());
    TestSet set{static_cast<TestSet::Kind>(below(3)), {}, {}, {}, {}};
    const int count = set.kind == TestSet::Kind::points ? 1 + below(4) : 4;
    do {
      set.points.clear();
      for (int i = 0; i < count; ++i) set.points.emplace_back(place + vector(size));
      std::ranges::sort(set.points);
    } while (has_repeated(set.points) || (count == 4 && volume(set.points).sign() == 0));
    if (set.kind != TestSet::Kind::points) make_tetrahedron(set);
    return set;
  }
  ExactPoint next_point() {
    return ExactPoint((below(3) == 0 ? RationalVec3() : vector(exponent())) + vector(exponent()));
  }
  RationalVec3 vector(int size) { return {number(size), number(size), number(size)}; }
  int exponent() { return below(161) - 80; }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  static Rational volume(const std::vector<ExactPoint>& p) {
    const RationalVec3 a = p[0].rational();
    return dot(cross(p[1].rational() - a, p[2].rational() - a), p[3].rational() - a);
  }

 private:
  static bool has_repeated(const std::vector<ExactPoint>& points) {
    return std::adjacent_find(points.begin(), points.end()) != points.end();
  }
  Rational number(int size) {
    const Rational unit = power_of_two(size);
    switch (below(4)) {
      case 0:
        return 0;
      case 1:
        return unit * Rational(below(5) - 2);
      case 2:
        return unit * Rational(below(9) - 4, 3);
      default:
        return unit * Rational(std::uniform_real_distribution<double>(-1, 1)(random_));
    }
  }

  static void make_tetrahedron(TestSet& set) {
    if (volume(set.points).sign() > 0) std::swap(set.points[0], set.points[1]);
    set.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    PointArray points;
    for (const ExactPoint& p : set.points) points.push_back(p);
    if (set.kind == TestSet::Kind::surface) set.triangles.pop_back();
    std::vector<TriangleMesh::Triangle> triangles;
    for (const auto& [a, b, c] : set.triangles)
      triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    TriangleMesh mesh(std::move(points), triangles);
    if (set.kind == TestSet::Kind::surface)
      set.surface = Surface3d::trusted(std::move(mesh));
    else
      set.solid = Volume3d::trusted(std::move(mesh));
  }

  std::mt19937 random_;
  int last_size_ = 0;
};

CGAL::Gmpq squared_distance(const Corners& from, const std::vector<Corners>& to) {
  CGAL::Gmpq least = exact_distances::squared_distance(from, to[0]);
  for (const Corners& face : to) least = std::min(least, exact_distances::squared_distance(from, face));
  return least;
}
CGAL::Gmpq squared_distance(const std::vector<Corners>& a, const std::vector<Corners>& b) {
  CGAL::Gmpq least = squared_distance(a[0], b);
  for (const Corners& face : a) least = std::min(least, squared_distance(face, b));
  return least;
}

Placement placement(const Rational& own, const Rational& whole, Placement so_far) {
  if (own.sign() == 0 && so_far != Placement::outside) return Placement::boundary;
  return own.sign() * whole.sign() < 0 ? Placement::outside : so_far;
}

/// By the signs of four determinants.
Placement place_in_tetrahedron(const ExactPoint& where, const std::vector<ExactPoint>& corners) {
  const Rational whole = RandomSets::volume(corners);
  Placement result = Placement::inside;
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<ExactPoint> replaced = corners;
    replaced[i] = where;
    result = placement(RandomSets::volume(replaced), whole, result);
  }
  return result;
}

/// True if a corner of a set lies in a solid: of sets whose boundaries are apart, one encloses a part of the other.
bool has_corner_in(const TestSet& solid, const TestSet& other) {
  return solid.kind == TestSet::Kind::solid && std::ranges::any_of(other.points, [&](const ExactPoint& p) {
           return place_in_tetrahedron(p, solid.points) != Placement::outside;
         });
}

CGAL::Gmpq square(double x) {
  return number(Rational(x)) * number(Rational(x));
}

void expect_distances(const TestSet& a, const TestSet& b) {
  const SpatialSet first = a.set(), second = b.set();
  const CGAL::Gmpq between = squared_distance(a.faces(), b.faces());
  const bool do_enclose = has_corner_in(a, b) || has_corner_in(b, a);
  const CGAL::Gmpq expected = do_enclose ? CGAL::Gmpq(0) : between;
  EXPECT_EQ(number(**squared_distance_of(first, second)), expected);
  EXPECT_EQ(number((*nearest_points(first, second))->squared_distance), expected);
  EXPECT_EQ(*do_meet(first, second), expected == 0);
  const double distance = (*squared_distance_of(first, second))->nearest_root();
  for (const double d : {std::nextafter(distance, 0.0), distance, std::nextafter(distance, 1e300), 2 * distance})
    EXPECT_EQ(*are_within(first, second, Rational(d)), expected <= square(d)) << d;
  const auto range = distance_range_of(first, second, Box3::kInfinity);
  EXPECT_TRUE(square((*range)->lower) <= expected && expected <= square((*range)->upper));
  EXPECT_TRUE(distance_range_of(first, second, std::nextafter(distance, 1e300))->has_value());
}

TEST(Scales, distances) {
  RandomSets sets(1);
  for (int round = 0; round < 2 * round_count() && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const TestSet a = sets.next(), b = sets.next();
    expect_distances(a, b);
    expect_distances(b, a);
  }
}

/// The square of the largest distance of a corner; that of any point if `to` is a single face, whose distance is
/// convex.
CGAL::Gmpq squared_farthest(const TestSet& from, const TestSet& to) {
  CGAL::Gmpq farthest = 0;
  for (const ExactPoint& p : from.points)
    farthest = std::max(farthest, squared_distance(Corners{point(p.rational())}, to.faces()));
  return farthest;
}

double largest_coordinate(const TestSet& a, const TestSet& b) {
  double largest = 0;
  for (const TestSet* set : {&a, &b})
    for (const ExactPoint& p : set->points)
      for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p.approx()[axis]));
  return largest;
}

/// Points, and faces of which there is one.
void expect_farthest(const TestSet& a, const TestSet& b) {
  const FarthestPoint found = **hausdorff_distance(a.set(), b.set());
  const CGAL::Gmpq expected = std::max(squared_farthest(a, b), squared_farthest(b, a));
  const CGAL::Gmpq squared = number(found.squared_distance);
  EXPECT_LE(squared, expected);
  EXPECT_LE(expected, square(found.upper_bound));
  EXPECT_TRUE(found.is_bounded);
  const double distance = found.squared_distance.nearest_root();
  const double promised = distance * (1 + 2e-9) + 0x1p-43 * largest_coordinate(a, b);
  EXPECT_LE(expected, square(promised)) << distance;
}

TEST(Scales, hausdorff_distances) {
  RandomSets sets(2);
  int compared = 0;
  for (int round = 0; compared < 2 * round_count() && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const TestSet a = sets.next(), b = sets.next();
    const bool are_points = a.kind == TestSet::Kind::points && b.kind == TestSet::Kind::points;
    const bool is_one_point = b.kind == TestSet::Kind::points && b.points.size() == 1;
    if (!are_points && !is_one_point) continue;
    ++compared;
    expect_farthest(a, b);
    expect_farthest(b, a);
  }
}

TEST(Scales, a_small_point_beside_far_ones) {
  for (int size = -80; size <= 80; ++size)
    for (const Rational& small : {Rational(1, 3), Rational(1)}) {
      TestSet far{TestSet::Kind::points, {}, {}, {}, {}}, single = far;
      far.points = {ExactPoint(RationalVec3()), ExactPoint(RationalVec3(5, 5, 5))};
      single.points = {ExactPoint(RationalVec3(small * power_of_two(size), 0, 0))};
      expect_farthest(far, single);
      expect_distances(far, single);
    }
}

TEST(Scales, point_location) {
  RandomSets sets(3);
  std::array<int, 3> seen{};
  for (int round = 0; round < 20 * round_count() && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const TestSet set = sets.next();
    if (set.kind == TestSet::Kind::points) continue;
    // In the set, in a face, or anywhere.
    const RationalVec3 corner = set.points[0].rational(), other = set.points[1].rational();
    const Rational share = power_of_two(sets.exponent() / 2 - 41);
    const RationalVec3 inner = Rational(1, 4) * (corner + other + set.points[2].rational() + set.points[3].rational());
    const std::array<ExactPoint, 4> points{sets.next_point(), ExactPoint(corner + share * (other - corner)),
                                           ExactPoint(corner + share * (inner - corner)),
                                           ExactPoint(corner - share * (inner - corner))};
    for (const ExactPoint& where : points) {
      if (set.kind == TestSet::Kind::solid) {
        const Placement expected = place_in_tetrahedron(where, set.points);
        ++seen[static_cast<std::size_t>(expected)];
        EXPECT_EQ(place_in_solid(where, set.geometry()), expected);
        const std::array<PointRef, 1> one{where};
        EXPECT_EQ(place_in_solid(one, set.geometry()), std::vector{expected});
      } else {
        const bool is_on = squared_distance(Corners{point(where.rational())}, set.faces()) == 0;
        EXPECT_EQ(place_on_surface(where, set.geometry()) != Placement::outside, is_on);
      }
    }
  }
  EXPECT_GT(*std::ranges::min_element(seen), round_count());
}

TEST(Scales, places_of_boxes_are_bounds) {
  RandomSets sets(4);
  for (int round = 0; round < 5 * round_count() && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const TestSet set = sets.next();
    if (set.kind == TestSet::Kind::points) continue;
    const Vec3 where = sets.next_point().approx();
    const CGAL::Gmpq expected = squared_distance(Corners{point(RationalVec3(where))}, set.faces());
    const double distance = std::sqrt(CGAL::to_double(expected));
    for (const double reach : {Box3::kInfinity, distance * (1 + 0x1p-40), distance / 2}) {
      const PlaceOfBox place = place_of_box(Box3::of(where), set.set(), reach);
      EXPECT_TRUE(place.gap == Box3::kInfinity ? square(reach == Box3::kInfinity ? 0 : reach) < expected
                                               : square(place.gap) <= expected)
          << place.gap;
      if (reach > distance) {
        EXPECT_LT(place.gap, Box3::kInfinity);
      }
      if (place.is_inside) {
        EXPECT_EQ(place_in_tetrahedron(ExactPoint(where), set.points), Placement::inside);
      }
    }
  }
}

/// The parameters at which the ray passes the boundary of a tetrahedron, by clipping with its planes; nothing if it
/// misses, or touches it in an edge or face only.
std::optional<std::pair<Rational, Rational>> passage(const std::vector<ExactPoint>& corners, const RationalVec3& origin,
                                                     const RationalVec3& direction) {
  std::optional<Rational> begin, end;
  for (std::size_t i = 0; i < 4; ++i) {
    const RationalVec3 a = corners[(i + 1) % 4].rational();
    const RationalVec3 normal = cross(corners[(i + 2) % 4].rational() - a, corners[(i + 3) % 4].rational() - a);
    const int inward = dot(normal, corners[i].rational() - a).sign();
    const Rational height = Rational(inward) * dot(normal, origin - a),
                   rise = Rational(inward) * dot(normal, direction);
    if (rise.sign() == 0) {
      if (height.sign() <= 0) return std::nullopt;
      continue;
    }
    const Rational at = Rational(0) - height / rise;
    std::optional<Rational>& bound = rise.sign() > 0 ? begin : end;
    if (!bound || (rise.sign() > 0 ? at > *bound : at < *bound)) bound = at;
  }
  if (!begin || !end || *begin >= *end) return std::nullopt;
  return std::pair(*begin, *end);
}

TEST(Scales, rays) {
  RandomSets sets(5);
  int passages = 0;
  for (int round = 0; round < 20 * round_count() && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const TestSet set = sets.next();
    if (set.kind != TestSet::Kind::solid) continue;
    const RationalVec3 origin = sets.next_point().rational();
    const RationalVec3 inner = Rational(1, 4) * (set.points[0].rational() + set.points[1].rational() +
                                                 set.points[2].rational() + set.points[3].rational());
    const RationalVec3 direction = power_of_two(sets.exponent()) * (inner - origin);
    const auto expected = passage(set.points, origin, direction);
    if (!expected || expected->second.sign() < 0) continue;
    ++passages;
    const std::vector<RayHit> hits = ray_hits(*set.solid, origin, direction);
    const std::size_t count = expected->first.sign() < 0 ? 1 : 2;
    ASSERT_EQ(hits.size(), count);
    if (count == 2) {
      EXPECT_EQ(hits[0].first, expected->first);
    }
    EXPECT_EQ(hits.back().first, expected->second);
  }
  EXPECT_GT(passages, round_count());
}

/// A sphere of 8 * 4^levels triangles about the origin, of radius 1: convex, with a corner at each end of the x axis.
TriangleMesh sphere(int levels) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<TriangleMesh::Triangle> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      const Vec3 sum = points[a] + points[b];
      if (is_new) points.push_back((1 / length(sum)) * sum);
      return entry->second;
    };
    std::vector<TriangleMesh::Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return {PointArray(std::move(points)), triangles};
}

/// A sphere of another radius, whose lower end is at a place of the x axis.
TriangleMesh sphere_from(const Rational& begin, const Rational& radius) {
  const TriangleMesh unit = sphere(4);
  PointArray points;
  for (std::size_t v = 0; v < unit.vertex_count(); ++v) {
    const RationalVec3 p = unit.point(VertexId(v)).rational();
    points.push_back(ExactPoint(RationalVec3(begin + radius * (p.x + 1), radius * p.y, radius * p.z)));
  }
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < unit.face_count(); ++f) triangles.push_back(unit.triangle(FaceId(f)));
  return {std::move(points), triangles};
}

// The unit sphere is below the plane x = 1, and the other one above a plane: they are as far apart as the planes, and
// the lower end of the unit sphere is 2 farther from the lower end of the other one, as no point is that is not.
TEST(Scales, large_sets) {
  const SpatialSet unit = Volume3d::trusted(sphere(4));
  for (const int gap : {-80, -30, 0})
    for (const int radius : {-80, -56, -10, 0, 80}) {
      // One gap for each radius, or all.
      if (!is_thorough() && gap != (radius < -56 ? -30 : radius < 0 ? 0 : -80)) continue;
      SCOPED_TRACE(testing::Message() << "gap " << gap << ", radius " << radius);
      const Rational between = power_of_two(gap), size = power_of_two(radius);
      const SpatialSet other = Volume3d::trusted(sphere_from(between + 1, size));
      EXPECT_EQ(**squared_distance_of(unit, other), between * between);
      EXPECT_EQ(**squared_distance_of(other, unit), between * between);
      EXPECT_FALSE(*do_meet(unit, other));
      EXPECT_TRUE(*are_within(unit, other, between));
      EXPECT_FALSE(*are_within(unit, other, between * Rational(1 - 0x1p-53)));
      if (radius > -10) continue;
      const FarthestPoint farthest = **hausdorff_distance(unit, other);
      EXPECT_EQ(farthest.squared_distance, (between + 2) * (between + 2));
    }
}

}  // namespace
}  // namespace algebra3d
