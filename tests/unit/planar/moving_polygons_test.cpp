// Moving polygons: critical cases by hand, and random ones against sampling with an independent check of single times.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/planar/moving_polygons.h"
#include "support/rounds.h"

namespace algebra3d::moving_polygons_tests {
namespace {

struct MovingCorner {
  double x1, y1, x2, y2;
};
using MovingCycle = std::vector<MovingCorner>;
using MovingFace = std::vector<MovingCycle>;

MovingPolygons polygons(const std::vector<MovingFace>& faces) {
  MovingPolygons result;
  for (const MovingFace& face : faces) {
    for (const MovingCycle& cycle : face) {
      for (const auto& [x1, y1, x2, y2] : cycle) {
        result.start.corners.push_back(Vec3{x1, y1, 0});
        result.end.corners.push_back(Vec3{x2, y2, 0});
      }
      result.start.cycle_ends.push_back(static_cast<std::uint32_t>(result.start.corners.size()));
    }
    result.start.face_ends.push_back(static_cast<std::uint32_t>(result.start.cycle_ends.size()));
  }
  result.end.cycle_ends = result.start.cycle_ends;
  result.end.face_ends = result.start.face_ends;
  return result;
}

std::string defect_of(const MovingPolygons& moving) {
  const auto defect = moving_polygon_defect(moving);
  EXPECT_TRUE(defect.ok());
  return defect->value_or("");
}
std::string defect_of(const std::vector<MovingFace>& faces) {
  return defect_of(polygons(faces));
}

MovingCycle still(const std::vector<std::pair<double, double>>& corners) {
  MovingCycle cycle;
  for (const auto& [x, y] : corners) cycle.push_back({x, y, x, y});
  return cycle;
}
MovingCycle square(double x, double y, double side) {
  return still({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
}
MovingCycle moved(MovingCycle cycle, double dx, double dy) {
  for (auto& [x1, y1, x2, y2] : cycle) {
    x2 += dx;
    y2 += dy;
  }
  return cycle;
}
MovingCycle backwards(MovingCycle cycle) {
  for (auto& [x1, y1, x2, y2] : cycle) {
    std::swap(x1, x2);
    std::swap(y1, y2);
  }
  return cycle;
}
MovingCycle collapsed_at_start(MovingCycle cycle, double x, double y) {
  for (auto& [x1, y1, x2, y2] : cycle) {
    x1 = x;
    y1 = y;
  }
  return cycle;
}

// --- The polygons at one time, by brute force.

struct FlatPoint {
  Rational x, y;
  friend bool operator==(const FlatPoint&, const FlatPoint&) = default;
};
Rational determinant(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
bool is_between(const Rational& a, const Rational& b, const Rational& x) {
  return (a <= x && x <= b) || (b <= x && x <= a);
}
bool is_on(const FlatPoint& a, const FlatPoint& b, const FlatPoint& p) {
  return determinant(a, b, p).sign() == 0 && is_between(a.x, b.x, p.x) && is_between(a.y, b.y, p.y);
}

struct FlatSegment {
  FlatPoint from, to;
};
/// The ends of each that lie on the other: all common points of segments that do not cross.
std::vector<FlatPoint> ends_on_the_other(const FlatSegment& s, const FlatSegment& t) {
  std::vector<FlatPoint> points;
  const auto add = [&](const FlatPoint& p) {
    if (std::ranges::find(points, p) == points.end()) points.push_back(p);
  };
  for (const FlatPoint& p : {s.from, s.to})
    if (is_on(t.from, t.to, p)) add(p);
  for (const FlatPoint& p : {t.from, t.to})
    if (is_on(s.from, s.to, p)) add(p);
  return points;
}
bool is_crossing(const FlatSegment& s, const FlatSegment& t) {
  return determinant(s.from, s.to, t.from).sign() * determinant(s.from, s.to, t.to).sign() < 0 &&
         determinant(t.from, t.to, s.from).sign() * determinant(t.from, t.to, s.to).sign() < 0;
}

using FlatCycle = std::vector<FlatSegment>;

bool is_inside(const FlatCycle& cycle, const FlatPoint& p) {
  bool inside = false;
  for (const auto& [a, b] : cycle) {
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    const Rational x = a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
    if (x > p.x) inside = !inside;
  }
  return inside;
}
bool is_on(const FlatCycle& cycle, const FlatPoint& p) {
  return std::ranges::any_of(cycle, [&](const FlatSegment& s) { return is_on(s.from, s.to, p); });
}
/// 1: all of it outside, -1: all of it inside, 0: some of both. Looks at points of every part of each segment.
int side_of(const FlatCycle& cycle, const FlatCycle& other) {
  bool some_inside = false, some_outside = false;
  for (const FlatSegment& s : cycle) {
    // Between touching points; there are few.
    std::vector<Rational> cuts{0, 1};
    for (const FlatSegment& t : other)
      for (const FlatPoint& p : ends_on_the_other(s, t))
        cuts.push_back(s.to.x != s.from.x ? (p.x - s.from.x) / (s.to.x - s.from.x)
                                          : (p.y - s.from.y) / (s.to.y - s.from.y));
    std::ranges::sort(cuts);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      const Rational t = (cuts[i - 1] + cuts[i]) / 2;
      const FlatPoint p{s.from.x + (s.to.x - s.from.x) * t, s.from.y + (s.to.y - s.from.y) * t};
      if (is_on(other, p)) continue;
      (is_inside(other, p) ? some_inside : some_outside) = true;
    }
  }
  return some_inside == some_outside ? 0 : some_inside ? -1 : 1;
}

bool is_simple(const FlatCycle& cycle) {
  const std::size_t n = cycle.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cycle[i].from == cycle[i].to) return false;
    for (std::size_t j = i + 1; j < n; ++j) {
      if (is_crossing(cycle[i], cycle[j])) return false;
      const std::size_t shared = (j == i + 1 || (i == 0 && j + 1 == n)) ? 1 : 0;
      if (ends_on_the_other(cycle[i], cycle[j]).size() > shared) return false;
    }
  }
  return n >= 3;
}

bool is_valid_at(const MovingPolygons& moving, const Rational& s) {
  std::vector<FlatCycle> cycles;
  std::vector<std::size_t> face_of;
  for (std::size_t face = 0; face < moving.start.face_count(); ++face)
    for (std::size_t c = moving.start.first_cycle(face); c < moving.start.face_ends[face]; ++c) {
      std::vector<FlatPoint> corners;
      for (std::uint32_t i = moving.start.first_corner(c); i < moving.start.cycle_ends[c]; ++i) {
        const auto mix = [&](std::size_t axis) {
          return moving.start.corners[i].coordinate(axis) * (1 - s) + moving.end.corners[i].coordinate(axis) * s;
        };
        corners.push_back({mix(0), mix(1)});
      }
      FlatCycle cycle;
      for (std::size_t i = 0; i < corners.size(); ++i) cycle.push_back({corners[i], corners[(i + 1) % corners.size()]});
      cycles.push_back(cycle);
      face_of.push_back(face);
    }
  for (const FlatCycle& cycle : cycles)
    if (!is_simple(cycle)) return false;
  for (std::size_t a = 0; a < cycles.size(); ++a)
    for (std::size_t b = a + 1; b < cycles.size(); ++b) {
      for (const FlatSegment& s1 : cycles[a])
        for (const FlatSegment& s2 : cycles[b])
          if (is_crossing(s1, s2) || ends_on_the_other(s1, s2).size() > 1) return false;
      const int a_by_b = side_of(cycles[a], cycles[b]);
      const int b_by_a = side_of(cycles[b], cycles[a]);
      if (a_by_b == 0 || b_by_a == 0) return false;
      const bool a_is_outer = moving.start.first_cycle(face_of[a]) == a;
      if (face_of[a] == face_of[b] && a_is_outer) {
        if (b_by_a != -1) return false;
      } else if (face_of[a] == face_of[b]) {
        if (a_by_b != 1 || b_by_a != 1) return false;
      }
    }
  // Faces: one may lie in a hole of another.
  for (std::size_t f = 0; f < moving.start.face_count(); ++f)
    for (std::size_t g = 0; g < moving.start.face_count(); ++g) {
      if (f == g) continue;
      const std::size_t outer = moving.start.first_cycle(f);
      const FlatCycle& inner = cycles[moving.start.first_cycle(g)];
      if (side_of(inner, cycles[outer]) != -1) continue;
      bool is_in_hole = false;
      for (std::size_t hole = outer + 1; hole < moving.start.face_ends[f]; ++hole)
        is_in_hole = is_in_hole || side_of(inner, cycles[hole]) == -1;
      if (!is_in_hole) return false;
    }
  return true;
}

constexpr int kTimes = 48;

bool is_valid_at_samples(const MovingPolygons& moving) {
  for (int i = 1; i < kTimes; ++i)
    if (!is_valid_at(moving, Rational(i, kTimes))) return false;
  return true;
}

void expect_valid(const std::vector<MovingFace>& faces) {
  EXPECT_EQ(defect_of(faces), "");
  EXPECT_TRUE(is_valid_at_samples(polygons(faces)));
  std::vector<MovingFace> reversed = faces;
  for (MovingFace& face : reversed)
    for (MovingCycle& cycle : face) cycle = backwards(cycle);
  EXPECT_EQ(defect_of(reversed), "");
}

// --- At one time

TEST(moving_polygons, have_exact_coordinates_at_any_time) {
  const MovingPolygons moving = polygons({{{{0, 0, 1, 3}, {2, 0, 2, 0}, {0, 2, 0, 3}}}});
  EXPECT_EQ(at(moving, 0), moving.start);
  EXPECT_EQ(at(moving, 1), moving.end);
  const Polygons third = at(moving, Rational(1, 3));
  EXPECT_EQ(third.corners[0].rational(), RationalVec3(Rational(1, 3), 1, 0));
  EXPECT_EQ(third.corners[1].rational(), RationalVec3(2, 0, 0));
  EXPECT_EQ(third.corners[2].rational(), RationalVec3(0, Rational(7, 3), 0));
  EXPECT_EQ(third.cycle_ends, moving.start.cycle_ends);
  EXPECT_EQ(third.face_ends, moving.start.face_ends);
}

// --- Valid ones

TEST(moving_polygons, that_move_and_grow_are_valid) {
  expect_valid({});
  expect_valid({{square(0, 0, 4)}});
  expect_valid({{moved(square(0, 0, 4), 1e6, -1e6)}});
  expect_valid({{square(0, 0, 8), square(1, 1, 2), moved(square(4, 4, 1), 2, 1)}});
  expect_valid({{square(0, 0, 8), square(1, 1, 6)}, {moved(square(2, 2, 2), 2, 2)}});
  expect_valid({{square(0, 0, 2)}, {moved(square(3, 0, 2), 5, 0)}});
}

TEST(moving_polygons, may_be_degenerate_at_the_ends) {
  expect_valid({{collapsed_at_start(square(0, 0, 4), 2, 2)}});
  expect_valid({{collapsed_at_start(square(0, 0, 4), 9, 9)}});
  // A hole opens from a point, from a point on the boundary, and from a segment.
  expect_valid({{square(0, 0, 8), collapsed_at_start(square(2, 2, 2), 3, 3)}});
  expect_valid({{square(0, 0, 8), collapsed_at_start(square(2, 2, 2), 0, 0)}});
  expect_valid({{square(0, 0, 8), {{2, 4, 2, 2}, {6, 4, 6, 2}, {6, 4, 6, 6}, {2, 4, 2, 6}}}});
  // A hole opens from a segment of the boundary.
  expect_valid({{square(0, 0, 8), {{2, 0, 2, 1}, {6, 0, 6, 1}, {6, 0, 6, 5}, {2, 0, 2, 5}}}});
  // Two faces come to share a segment at the end, and to overlap there in one corner's way.
  expect_valid({{square(0, 0, 2)}, {moved(square(5, 0, 2), -3, 0)}});
  expect_valid({{square(0, 0, 2)}, {moved(square(5, 1, 2), -3, 0)}});
  // An edge appears from a corner, and a corner from the middle of an edge.
  expect_valid({{{{0, 0, 0, 0}, {4, 0, 4, 0}, {4, 4, 4, 2}, {4, 4, 2, 4}, {0, 4, 0, 4}}}});
  expect_valid({{{{0, 0, 0, 0}, {2, 0, 2, -1}, {4, 0, 4, 0}, {4, 4, 4, 4}}}});
  // A triangle becomes a segment.
  expect_valid({{{{0, 0, 0, 0}, {4, 0, 4, 0}, {2, 3, 2, 0}}}});
  expect_valid({{{{0, 0, 0, 0}, {4, 0, 4, 0}, {2, 3, 9, 0}}}});
}

TEST(moving_polygons, may_touch_in_points_while_they_move) {
  // A corner of the hole on the outer cycle: at a corner, inside an edge, sliding along it, for an instant.
  expect_valid({{still({{0, 0}, {8, 0}, {8, 8}, {0, 8}}), {{0, 0, 0, 0}, {3, 1, 3, 2}, {1, 3, 2, 3}}}});
  expect_valid({{square(0, 0, 8), still({{4, 0}, {5, 2}, {3, 2}})}});
  expect_valid({{square(0, 0, 8), {{2, 0, 6, 0}, {5, 2, 5, 2}, {3, 2, 3, 2}}}});
  expect_valid({{moved(square(0, 0, 8), 3, 5), moved(still({{4, 0}, {5, 2}, {3, 2}}), 3, 5)}});
  // Two faces that touch in corners that move as one.
  expect_valid({{{{0, 0, 0, 0}, {2, 2, 3, 5}, {0, 4, 0, 9}}}, {{{2, 2, 3, 5}, {6, 0, 6, 0}, {6, 9, 6, 9}}}});
  // A corner bounces: the other face comes near and goes at one and the same speed, so it touches at the end alone;
  // a true bounce needs a turning edge. Corner (1 + 2s, 4s - 2) and edge (0 0)-(2 4s - 2): see moving_segments_test.
  expect_valid({{{{0, 0, 0, 0}, {2, -2, 2, 2}, {0, 9, 0, 9}}}, {{{1, -2, 3, 2}, {1, -9, 3, -9}, {3, -9, 5, -9}}}});
}

TEST(moving_polygons, that_turn_are_valid_while_corners_do_not_meet) {
  const auto turned = [](const std::vector<std::pair<double, double>>& corners, double degrees) {
    const double angle = degrees * std::acos(-1.0) / 180;
    MovingCycle cycle;
    for (const auto& [x, y] : corners)
      cycle.push_back({x, y, x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)});
    return cycle;
  };
  const std::vector<std::pair<double, double>> star{{3, 0},  {1, 1},   {0, 3},  {-1, 1},
                                                    {-3, 0}, {-1, -1}, {0, -3}, {1, -1}};
  for (const double degrees : {1.0, 45.0, 90.0, 179.0}) expect_valid({{turned(star, degrees)}});
  // Turned by 180 degrees every corner goes through the centre, all at one time.
  MovingCycle half_turn;
  for (const auto& [x, y] : star) half_turn.push_back({x, y, -x, -y});
  EXPECT_EQ(defect_of({{half_turn}}),
            "segment (3 0)-(1 1) moving to (-3 0)-(-1 -1) of face 1, cycle 1 has no length at about 0.5 of the unit");
  EXPECT_FALSE(is_valid_at_samples(polygons({{half_turn}})));
}

// --- Invalid ones

TEST(moving_polygons, with_too_few_corners_are_none) {
  EXPECT_EQ(defect_of({{still({{0, 0}, {1, 1}})}}), "face 1, cycle 1 has 2 corners, expected at least 3");
  EXPECT_EQ(defect_of({{square(0, 0, 1)}, {square(5, 5, 1), {}}}),
            "face 2, cycle 2 has 0 corners, expected at least 3");
}

TEST(moving_polygons, whose_segments_vanish_or_fold_say_which_and_when) {
  EXPECT_EQ(defect_of({{still({{0, 0}, {1, 0}, {1, 0}, {0, 1}})}}),
            "segment (1 0)-(1 0) moving to (1 0)-(1 0) of face 1, cycle 1 has no length from its start on");
  // A triangle turns inside out.
  EXPECT_EQ(defect_of({{{{0, 0, 0, 0}, {4, 0, 4, 0}, {2, 3, 2, -3}}}}),
            "segment (0 0)-(4 0) moving to (0 0)-(4 0) of face 1, cycle 1 and segment (4 0)-(2 3) moving to (4 0)-(2 "
            "-3) of face 1, cycle 1 overlap at about 0.5 of the unit");
  EXPECT_EQ(defect_of({{{{0, 0, 0, 0}, {4, 0, 4, 0}, {2, 0, 2, 0}}}}),
            "segment (0 0)-(4 0) moving to (0 0)-(4 0) of face 1, cycle 1 and segment (4 0)-(2 0) moving to (4 0)-(2 "
            "0) of face 1, cycle 1 overlap from its start on");
  // Through one point at sqrt(1/2): (4 0)-(4 - 2s, 1 - ...): area 4 (2 - 4 s^2).
  EXPECT_NE(defect_of({{{{0, 0, 0, 0}, {4, 0, 8, 0}, {1, 1, 1, -1}}}}).find("at about 0.5 of the unit"),
            std::string::npos);
}

TEST(moving_polygons, whose_cycle_meets_itself_are_none) {
  // A corner comes down to the edge (0 0)-(8 0) for an instant, goes through it, or stays on it.
  const auto notched = [](MovingCorner corner) {
    return std::vector<MovingFace>{{{{0, 0, 0, 0}, {8, 0, 8, 0}, {8, 8, 8, 8}, corner, {0, 8, 0, 8}}}};
  };
  expect_valid(notched({4, 4, 4, 0}));
  EXPECT_NE(defect_of(notched({4, 4, 4, -4})).find("touch at about 0.5 of the unit"), std::string::npos);
  EXPECT_NE(defect_of(notched({2, 0, 6, 0})).find("touch from its start on"), std::string::npos);
  // It passes a corner for an instant.
  EXPECT_NE(defect_of(notched({-2, 2, 2, -2})).find(" at about 0.5 of the unit"), std::string::npos);
}

TEST(moving_polygons, whose_cycles_cross_or_overlap_are_none) {
  // Which of the pairs that meet at that time is named depends on their places.
  EXPECT_NE(defect_of({{square(0, 0, 2)}, {moved(square(5, 1, 2), -4, 0)}}).find("about 0.75 of the unit"),
            std::string::npos);
  EXPECT_EQ(defect_of({{square(0, 0, 2)}, {square(2, 0, 2)}}),
            "segment (2 0)-(2 2) moving to (2 0)-(2 2) of face 1, cycle 1 and segment (2 2)-(2 0) moving to (2 2)-(2 "
            "0) of face 2, cycle 1 overlap from its start on");
  // A triangle goes through an edge with a corner ahead.
  const std::string defect = defect_of({{square(0, 0, 8)}, {moved(still({{10, 4}, {12, 3}, {12, 5}}), -3, 0)}});
  EXPECT_NE(defect.find("cross from about 0.666667 of the unit on"), std::string::npos) << defect;
}

TEST(moving_polygons, that_agree_at_an_irrational_time_alone_overlap) {
  // See moving_segments_test: an edge turns so that at sqrt(1/2) it lies along one of the other face.
  const MovingCycle turning{{0, 0, 0, 0}, {4, 0, 4, 4}, {9, -9, 9, -9}};
  const MovingCycle other{{0, 1, 2, 1}, {2, 1, 4, 3}, {-5, 20, -5, 20}};
  const std::string defect = defect_of({{turning}, {other}});
  EXPECT_NE(defect.find("overlap at about 0.707107 of the unit"), std::string::npos) << defect;
}

TEST(moving_polygons, of_wrong_nesting_are_none) {
  for (const auto& faces :
       std::vector<std::vector<MovingFace>>{{{square(0, 0, 2), square(5, 5, 1)}},    // a hole beside its face
                                            {{square(0, 0, 2), square(-1, -1, 4)}},  // a hole around its face
                                            {{square(0, 0, 8), square(1, 1, 6), square(2, 2, 1)}},  // a hole in a hole
                                            {{square(0, 0, 8)}, {square(1, 1, 2)}},                 // a face in a face
                                            {{square(1, 1, 2)}, {square(0, 0, 8)}},
                                            {{square(0, 0, 8), square(1, 1, 2)}, {moved(square(4, 4, 1), 1, 1)}}}) {
    EXPECT_NE(defect_of(faces), "");
    EXPECT_FALSE(is_valid_at_samples(polygons(faces)));
  }
}

TEST(moving_polygons, that_cross_in_corners_all_the_time_are_none) {
  // The corner (4 0) of the second face lies on an edge of the first, and its edges go to both sides.
  EXPECT_NE(defect_of({{square(0, 0, 8)}, {still({{4, 0}, {5, 5}, {20, 5}, {5, -3}})}}), "");
  const std::vector<MovingFace> through_edge{{still({{0, 0}, {8, 0}, {4, 8}})}, {still({{4, 0}, {4, 2}, {5, -9}})}};
  EXPECT_NE(defect_of(through_edge), "");
  EXPECT_FALSE(is_valid_at_samples(polygons(through_edge)));
}

// --- Random ones

TEST(moving_polygons, random_ones_are_valid_or_not_as_samples_say) {
  std::mt19937 random(11);
  int valid = 0, invalid = 0, for_an_instant = 0;
  for (int round = 0; round < rounds(1000); ++round) {
    const int range = 4 + round % 7;
    const auto any = [&] { return static_cast<double>(random() % range); };
    const auto near = [&](double x) { return x + static_cast<double>(random() % 5) - 2; };
    std::vector<MovingFace> faces;
    for (std::size_t f = 0; f <= round % 2U; ++f) {
      MovingCycle cycle;
      for (std::size_t i = 0; i < 3 + random() % 2; ++i) {
        const double x = any() + 6.0 * static_cast<double>(f), y = any();
        cycle.push_back({x, y, near(x), near(y)});
      }
      faces.push_back({cycle});
    }
    const MovingPolygons moving = polygons(faces);
    const std::string defect = defect_of(moving);
    const bool is_valid = is_valid_at_samples(moving);
    EXPECT_TRUE(!defect.empty() || is_valid);
    if (defect.empty())
      ++valid;
    else
      ++invalid;
    // What no sample shows happens for an instant, or for so short a time that none falls in.
    for_an_instant += !defect.empty() && is_valid ? 1 : 0;
  }
  EXPECT_GT(valid, rounds(25));
  EXPECT_GT(invalid, rounds(250));
  EXPECT_GT(for_an_instant, rounds(5));
}

TEST(moving_polygons, with_changed_coordinates_are_judged_alike) {
  // Exact images: by a rational factor, which makes coordinates that are not doubles, and mirrored.
  std::mt19937 random(12);
  for (int round = 0; round < 300; ++round) {
    MovingCycle cycle;
    for (int i = 0; i < 4; ++i) {
      const double x = static_cast<double>(random() % 6), y = static_cast<double>(random() % 6);
      cycle.push_back({x, y, x + static_cast<double>(random() % 3) - 1, y + static_cast<double>(random() % 3) - 1});
    }
    const MovingPolygons moving = polygons({{cycle}});
    MovingPolygons scaled = moving;
    for (Polygons* part : {&scaled.start, &scaled.end}) {
      PointArray corners;
      for (std::size_t i = 0; i < part->corners.size(); ++i) {
        const RationalVec3 p = part->corners[i].rational();
        corners.push_back(ExactPoint(RationalVec3(p.y * Rational(1, 3), p.x / 7 + p.y, 0)));
      }
      part->corners = corners;
    }
    EXPECT_EQ(defect_of(moving).empty(), defect_of(scaled).empty());
  }
}

// --- Large ones

MovingCycle gear(int teeth, double radius, double turn, double growth) {
  MovingCycle cycle;
  const double step = std::acos(-1.0) / teeth;
  for (int i = 0; i < 2 * teeth; ++i) {
    const double r = i % 2 == 0 ? radius : radius * (1 - 2.0 / teeth);
    const double a = step * i;
    cycle.push_back(
        {r * std::cos(a), r * std::sin(a), growth * r * std::cos(a + turn), growth * r * std::sin(a + turn)});
  }
  return cycle;
}

TEST(moving_polygons, of_many_segments_take_little_time_each) {
  EXPECT_EQ(defect_of({{gear(5000, 100, 0.3, 1.5), gear(5000, 90, -0.2, 1.4)}}), "");
  EXPECT_NE(defect_of({{gear(500, 100, 0.3, 1.5), gear(500, 98.5, 0.1, 1.55)}}), "");
  EXPECT_EQ(defect_of({{moved(gear(5000, 100, 0, 1), 1e5, 1e5)}}), "");
  EXPECT_EQ(defect_of({{collapsed_at_start(gear(500, 100, 0, 1), 3, 4)}}), "");
}

TEST(moving_polygons, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const auto defect = moving_polygon_defect(polygons({{gear(3000, 100, 0.1, 1)}}), {&cancel});
  ASSERT_FALSE(defect.ok());
  EXPECT_EQ(defect.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::moving_polygons_tests
