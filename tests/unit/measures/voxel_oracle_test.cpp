// Clashes, contacts, common volumes and hits of rays of random sets of unit cells, where all can be counted. Most pairs
// touch in corners, edges or faces, or have parts of faces in common.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "algebra3d/values/measures/clash.h"
#include "algebra3d/values/measures/common_volume.h"
#include "algebra3d/values/measures/contact_area.h"
#include "algebra3d/values/measures/hausdorff_distance.h"
#include "algebra3d/values/measures/ray_hits.h"
#include "algebra3d/values/measures/thickness.h"
#include "support/rounds.h"
#include "unit/measures/voxels.h"

namespace algebra3d {
namespace {

using Cell = Voxels::Cell;
using Place = Voxels::Place;

constexpr int kUsualRounds = 15;

struct Frame {
  Rational factor, shift;
};
Frame frame_of(int seed) {
  switch (seed % 4) {
    case 0:
      return {Rational(1, 3), Rational(1, 7)};
    case 1:
      return {1, 1000000000};
    case 2:
      return {Rational(0x1p-300), 0};
    default:
      return {1, 0};
  }
}

bool divides(const Voxels& divider, const Voxels& solid) {
  for (const Voxels& body : solid.bodies())
    if (body.without(divider).bodies().size() > 1) return true;
  return false;
}

std::string expected_kind(const Voxels& a, const Voxels& b, int squared_clearance) {
  if (a.is_empty() || b.is_empty()) return "";
  const std::size_t common = a.common_count(b);
  if (common == 0) {
    bool do_touch = false;
    for (const Cell& p : a.cells())
      for (const Cell& q : b.cells())
        do_touch = do_touch || (std::abs(p[0] - q[0]) <= 1 && std::abs(p[1] - q[1]) <= 1 && std::abs(p[2] - q[2]) <= 1);
    if (do_touch) return "touching";
    return Voxels::squared_distance(a, b) < squared_clearance ? "clearance" : "";
  }
  if (common == a.cells().size() && common == b.cells().size()) return "duplication";
  if (common == a.cells().size() || common == b.cells().size()) return "envelopment";
  return divides(a, b) || divides(b, a) ? "piercing" : "protrusion";
}

/// A lower bound of the depth: points of the boundary of `of` every half unit, inside `within`, against its unit
/// squares.
double sampled_depth(const Voxels& of, const Voxels& within) {
  double deepest = 0;
  const auto squares = within.boundary();
  for (const auto& [axis, cell] : of.boundary())
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= 2; ++j) {
        Cell quarters{4 * cell[0], 4 * cell[1], 4 * cell[2]};
        quarters[(axis + 1) % 3] += 2 * i;
        quarters[(axis + 2) % 3] += 2 * j;
        if (within.place(quarters) != Place::inside) continue;
        double nearest = 1e9;
        for (const auto& [other_axis, other] : squares) {
          double sum = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            const double low = other[k], high = k == other_axis ? low : low + 1, x = quarters[k] / 4.0;
            const double gap = std::max({0.0, low - x, x - high});
            sum += gap * gap;
          }
          nearest = std::min(nearest, std::sqrt(sum));
        }
        deepest = std::max(deepest, nearest);
      }
  return deepest;
}

void expect_clash(const Voxels& a, const Voxels& b, const Volume3d& first, const Volume3d& second, const Frame& frame) {
  constexpr int kClearance = 2;
  const auto found = clash_of(first, second, kClearance * frame.factor);
  ASSERT_TRUE(found.ok());
  const std::optional<Clash>& clash = *found;
  const std::string expected = expected_kind(a, b, kClearance * kClearance);
  ASSERT_EQ(clash ? name_of(clash->kind) : "", expected);
  if (!clash) return;
  const int squared = expected == "clearance" ? Voxels::squared_distance(a, b) : 0;
  EXPECT_EQ(clash->squared_distance, Rational(squared) * frame.factor * frame.factor);
  if (!clash->squared_depth) return;
  const double depth = (*clash->squared_depth / (frame.factor * frame.factor)).nearest_root();
  const double sampled = std::max(sampled_depth(a, b), sampled_depth(b, a));
  EXPECT_GE(depth, sampled - 1e-4);
  EXPECT_LE(depth, sampled + 0.36);  // no point of a unit square is farther from a sample
}

TEST(VoxelOracle, Pairs) {
  std::map<std::string, int> kinds;
  for (int seed = 0; seed < rounds(kUsualRounds); ++seed) {
    SCOPED_TRACE(seed);
    solids::Chance chance(static_cast<std::uint64_t>(seed));
    const Voxels a = Voxels::draw(chance), b = Voxels::draw(chance);
    const Frame frame = frame_of(seed);
    const Volume3d first = a.solid(frame.factor, frame.shift), second = b.solid(frame.factor, frame.shift);
    ++kinds[expected_kind(a, b, 4)];
    expect_clash(a, b, first, second, frame);
    expect_clash(b, a, second, first, frame);

    EXPECT_EQ(*common_volume(first, second), Rational(a.common_count(b)) * frame.factor * frame.factor * frame.factor);
    const auto own = a.boundary(), other = b.boundary();
    std::size_t common_squares = 0;
    for (const auto& square : own) common_squares += other.contains(square) ? 1 : 0;
    const double area = (Rational(common_squares) * frame.factor * frame.factor).nearest_double();
    EXPECT_EQ(*contact_area(first.geometry(), second.geometry()), area);
    EXPECT_EQ(*contact_area(second.geometry(), first.geometry()), area);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(kinds.size(), rounds(kUsualRounds) < 1000 ? 4U : 7U);
}

struct ExpectedHit {
  int first, last;  // numbers of steps
  RayHitKind kind;
};

/// Of a ray that begins at a multiple of half a unit, and moves by a quarter along some axes with each step: it meets
/// planes of the grid after whole numbers of steps, and what lies between them after others.
std::vector<ExpectedHit> expected_hits(const Voxels& set, const Cell& begin, const Cell& step, int count) {
  const auto at = [&](int i) { return Cell{begin[0] + i * step[0], begin[1] + i * step[1], begin[2] + i * step[2]}; };
  std::vector<ExpectedHit> hits;
  for (int i = 0; i <= count; ++i) {
    if (set.place(at(i)) != Place::boundary) continue;
    int last = i;
    while (set.place(at(last + 1)) == Place::boundary) ++last;
    const bool is_after_inside = set.place(at(last + 1)) == Place::inside;
    const bool is_before_inside = i == 0 ? !is_after_inside : set.place(at(i - 1)) == Place::inside;
    hits.push_back({i, last,
                    is_after_inside == is_before_inside ? RayHitKind::touching
                    : is_after_inside                   ? RayHitKind::entering
                                                        : RayHitKind::leaving});
    i = last;
  }
  return hits;
}

TEST(VoxelOracle, Rays) {
  for (int seed = 0; seed < rounds(kUsualRounds); ++seed) {
    SCOPED_TRACE(seed);
    solids::Chance chance(static_cast<std::uint64_t>(seed + 5000));
    const Voxels set = Voxels::draw(chance);
    const Frame frame = frame_of(seed);
    const Volume3d solid = set.solid(frame.factor, frame.shift);
    for (int ray = 0; ray < 20; ++ray) {
      Cell begin{}, step{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        begin[axis] = 2 * chance.between(-2, 2 * Voxels::kSide + 2);
        step[axis] = chance.between(-1, 1);
      }
      if (step == Cell{}) step[0] = 1;
      const Rational quarter = frame.factor / 4;
      const auto scaled = [&](const Cell& c, const Rational& shift) {
        return RationalVec3(c[0] * quarter + shift, c[1] * quarter + shift, c[2] * quarter + shift);
      };
      const std::vector<ExpectedHit> expected = expected_hits(set, begin, step, 12 * Voxels::kSide);
      const std::vector<RayHit> found = ray_hits(solid, scaled(begin, frame.shift), scaled(step, 0));
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].first, expected[i].first);
        EXPECT_EQ(found[i].last, expected[i].last);
        EXPECT_EQ(found[i].kind, expected[i].kind);
        EXPECT_TRUE(is_on_triangle(found[i].first_point, solid.mesh().corners(found[i].face)));
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(VoxelOracle, ThicknessIsAWholeNumberOfCells) {
  for (int seed = 0; seed < rounds(kUsualRounds); ++seed) {
    SCOPED_TRACE(seed);
    solids::Chance chance(static_cast<std::uint64_t>(seed + 9000));
    const Voxels set = Voxels::draw(chance);
    const Frame frame = frame_of(seed);
    const Volume3d solid = set.solid(frame.factor, frame.shift);
    const auto all = facet_thicknesses(solid);
    ASSERT_EQ(all->size(), solid.mesh().face_count());
    for (const FacetThickness& facet : *all) {
      // Count cells along the normal from the cell behind the centroid.
      const TriangleRef triangle = solid.mesh().corners(facet.face);
      const RationalVec3 p = triangle[0].rational(),
                         normal = cross(triangle[1].rational() - p, triangle[2].rational() - p);
      const std::size_t axis = normal.x.sign() != 0 ? 0 : normal.y.sign() != 0 ? 1 : 2;
      std::array<std::vector<int>, 3> candidates;
      const RationalVec3 centroid = centroid_of(triangle).rational();
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational unit = (centroid[i] - frame.shift) / frame.factor;
        const int below = static_cast<int>(std::floor(unit.nearest_double()));
        // A centroid on a line of the grid has cells on both sides; the ray ends where the first of them ends.
        candidates[i] = unit == Rational(below) && i != axis ? std::vector{below - 1, below} : std::vector{below};
        if (i == axis) candidates[i] = {normal[axis].sign() > 0 ? below - 1 : below};
      }
      int least = 100;
      for (const int x : candidates[0])
        for (const int y : candidates[1])
          for (const int z : candidates[2]) {
            Cell cell{x, y, z};
            int count = 0;
            for (; set.has(cell); ++count) cell[axis] += normal[axis].sign() > 0 ? -1 : 1;
            least = std::min(least, count);
          }
      EXPECT_EQ(facet.thickness, (Rational(least * least) * frame.factor * frame.factor).nearest_root());
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace algebra3d
