#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "unit/arrangement/minimality.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {

/// The laws of set algebra on one draw of operands. What does not hold is written down, with its name.
class LawTrial {
 public:
  explicit LawTrial(std::uint64_t seed)
      : solids_(seed, engine_), a_(solids_.operand()), b_(solids_.operand()), c_(solids_.operand()) {}

  void run() {
    unions_and_intersections();
    differences();
    three_operands();
    many_operands();
    minimal_results();
  }

  std::size_t check_count() const { return check_count_; }
  /// Empty if all is well; else one line for each finding.
  std::string findings() const { return findings_ + engine_.complaints(); }
  Family family() const { return solids_.family(); }
  std::array<const TriangleMesh*, 3> operands() const { return {&a_, &b_, &c_}; }

 private:
  void expect(bool holds, const char* law) {
    ++check_count_;
    if (!holds) findings_ += std::string(law) + "\n";
  }
  void expect_same(const TriangleMesh& a, const TriangleMesh& b, const char* law) { expect(engine_.same(a, b), law); }

  void unions_and_intersections() {
    const TriangleMesh both = engine_.unite(a_, b_), common = engine_.intersect(a_, b_);
    const Rational volume_a = exact_volume_of(a_), volume_b = exact_volume_of(b_);
    expect(volume_a + volume_b == exact_volume_of(both) + exact_volume_of(common), "|A| + |B| = |A+B| + |A*B|");
    expect(has_right_places(both, [](bool a, bool b) { return a || b; }), "places of A+B");
    expect(has_right_places(common, [](bool a, bool b) { return a && b; }), "places of A*B");

    const TriangleMesh swapped_both = engine_.unite(b_, a_), swapped_common = engine_.intersect(b_, a_);
    expect_same(both, swapped_both, "A+B = B+A");
    expect_same(common, swapped_common, "A*B = B*A");
    expect(both.face_count() == swapped_both.face_count(), "A+B and B+A have as many triangles");
    expect(common.face_count() == swapped_common.face_count(), "A*B and B*A have as many triangles");

    expect_same(engine_.unite(a_, a_), a_, "A+A = A");
    expect_same(engine_.intersect(a_, a_), a_, "A*A = A");
    expect_same(engine_.unite(a_, common), a_, "A+(A*B) = A");
    expect_same(engine_.intersect(a_, both), a_, "A*(A+B) = A");
  }

  void differences() {
    const TriangleMesh both = engine_.unite(a_, b_), common = engine_.intersect(a_, b_);
    const TriangleMesh rest = engine_.subtract(a_, b_), other_rest = engine_.subtract(b_, a_);
    expect(exact_volume_of(rest) + exact_volume_of(common) == exact_volume_of(a_), "|A-B| + |A*B| = |A|");
    expect(has_right_places(rest, [](bool a, bool b) { return a && !b; }), "places of A-B");
    expect(engine_.subtract(a_, a_).is_empty(), "A-A is empty");
    expect(engine_.intersect(rest, b_).is_empty(), "(A-B)*B is empty");
    expect_same(engine_.subtract(both, b_), rest, "(A+B)-B = A-B");
    expect_same(engine_.subtract(a_, rest), common, "A-(A-B) = A*B");
    expect_same(engine_.unite(rest, common), a_, "(A-B)+(A*B) = A");
    const TriangleMesh apart = engine_.difference_of_both(a_, b_);
    expect_same(engine_.unite(rest, other_rest), apart, "(A-B)+(B-A) = A^B");
    expect_same(engine_.subtract(both, common), apart, "(A+B)-(A*B) = A^B");
    expect_same(engine_.difference_of_both(apart, b_), a_, "(A^B)^B = A");
  }

  void three_operands() {
    const TriangleMesh ab = engine_.unite(a_, b_), bc = engine_.unite(b_, c_), ac = engine_.unite(a_, c_);
    const TriangleMesh a_b = engine_.intersect(a_, b_), b_c = engine_.intersect(b_, c_),
                       a_c = engine_.intersect(a_, c_);
    expect_same(engine_.unite(ab, c_), engine_.unite(a_, bc), "(A+B)+C = A+(B+C)");
    expect_same(engine_.intersect(a_b, c_), engine_.intersect(a_, b_c), "(A*B)*C = A*(B*C)");
    expect_same(engine_.intersect(a_, bc), engine_.unite(a_b, a_c), "A*(B+C) = (A*B)+(A*C)");
    expect_same(engine_.unite(a_, b_c), engine_.intersect(ab, ac), "A+(B*C) = (A+B)*(A+C)");
    const TriangleMesh world = solids_.surroundings();
    const TriangleMesh not_a = engine_.subtract(world, a_), not_b = engine_.subtract(world, b_);
    expect_same(engine_.subtract(world, ab), engine_.intersect(not_a, not_b), "W-(A+B) = (W-A)*(W-B)");
    expect_same(engine_.subtract(world, a_b), engine_.unite(not_a, not_b), "W-(A*B) = (W-A)+(W-B)");
    expect_same(engine_.subtract(a_, bc), engine_.subtract(engine_.subtract(a_, b_), c_), "A-(B+C) = (A-B)-C");
  }

  /// Operands with superfluous corners keep those where nothing touches them, so they lose them first.
  void minimal_results() {
    const TriangleMesh a = engine_.unite(a_, a_), b = engine_.unite(b_, b_), c = engine_.unite(c_, c_);
    const TriangleMesh either = engine_.difference_of_both(a, b), both = engine_.unite(a, b),
                       common = engine_.intersect(a, b), rest = engine_.subtract(a, b),
                       other_rest = engine_.subtract(b, a);
    for (const TriangleMesh* mesh : {&a, &b, &either, &both, &common, &rest})
      expect(Superfluity(*mesh).triangle_count() == 0, "no triangle is superfluous");
    const auto expect_as_many = [&](const TriangleMesh& one, const TriangleMesh& other, const char* law) {
      expect(one.face_count() == other.face_count(), law);
    };
    expect_as_many(either, engine_.unite(rest, other_rest), "A^B and (A-B)+(B-A) have as many triangles");
    expect_as_many(either, engine_.subtract(both, common), "A^B and (A+B)-(A*B) have as many triangles");
    expect_as_many(a, engine_.unite(rest, common), "A and (A-B)+(A*B) have as many triangles");
    const TriangleMesh all = engine_.unite(both, c);
    expect_as_many(all, engine_.unite(a, engine_.unite(b, c)), "(A+B)+C and A+(B+C) have as many triangles");
    expect_as_many(all, engine_.unite_all({&c, &a, &b}), "one union and a chain have as many triangles");
    expect_as_many(engine_.intersect(common, c), engine_.intersect(a, engine_.intersect(b, c)),
                   "(A*B)*C and A*(B*C) have as many triangles");
  }

  void many_operands() {
    std::vector<TriangleMesh> plain;
    for (int n = solids_.is_costly() ? 1 : solids_.chance().between(2, 6); n > 0; --n) plain.push_back(solids_.plain());
    Solids all{&a_, &b_, &c_};
    for (const TriangleMesh& mesh : plain) all.push_back(&mesh);
    TriangleMesh united, common = a_;
    for (const TriangleMesh* mesh : all) {
      united = engine_.unite(united, *mesh);
      common = engine_.intersect(common, *mesh);
    }
    expect_same(engine_.unite_all(all), united, "one union of all = a chain of unions");
    expect_same(engine_.intersect_all(all), common, "one intersection of all = a chain of intersections");
    expect_same(engine_.subtract(united, common), engine_.difference_of_both(common, united), "U-I = I^U");
  }

  /// Winding number from solid angles, which owes nothing to the engine; nothing close to the boundary.
  /// Source: the solid angle of a triangle by van Oosterom and Strackee.
  static std::optional<bool> holds_place(const TriangleMesh& mesh, const Vec3& p) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const TriangleRef t = mesh.corners(FaceId(f));
      const Vec3 a = t[0].approx - p, b = t[1].approx - p, c = t[2].approx - p;
      const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
      const double product = la * lb * lc, triple = dot(a, cross(b, c));
      const double below = product + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
      // On the triangle, or nearly so: far from the origin coordinates are coarse, those of exact corners too.
      const Vec3 normal = cross(b - a, c - a);
      const double blur = 1e-14 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
      const bool is_near_plane =
          std::abs(triple) <= 1e-5 * product || std::abs(triple) <= blur * std::sqrt(dot(normal, normal));
      if (is_near_plane && below <= 0.1 * product) return std::nullopt;
      sum += 2 * std::atan2(triple, below);
    }
    const double winding = sum / (4 * std::numbers::pi);
    if (std::abs(winding - std::round(winding)) > 1e-3) return std::nullopt;
    return std::round(winding) == 1;
  }

  /// A few places near corners of the operands, where something is bound to happen.
  template <typename Rule>
  bool has_right_places(const TriangleMesh& result, const Rule& rule) {
    for (const TriangleMesh* mesh : {&a_, &b_}) {
      if (mesh->is_empty()) continue;
      Chance& chance = solids_.chance();
      for (int n = 0; n < 4; ++n) {
        const auto corner = [&] { return mesh->points().approx()[chance.below(int(mesh->vertex_count()))]; };
        const Vec3 p = corner(), q = corner(), r = corner();
        const double s = 0.5 * (1 + chance.unit()), t = 0.5 * (1 + chance.unit());
        const Vec3 place = p + 0.9 * s * (q - p) + 0.1 * t * (r - p);
        const auto in_a = holds_place(a_, place), in_b = holds_place(b_, place), in_result = holds_place(result, place);
        if (in_a && in_b && in_result && *in_result != rule(*in_a, *in_b)) return false;
      }
    }
    return true;
  }

  SetOperations engine_;
  RandomSolids solids_;
  TriangleMesh a_, b_, c_;
  std::string findings_;
  std::size_t check_count_ = 0;
};

}  // namespace algebra3d::solids
