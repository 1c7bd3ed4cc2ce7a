#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/validity/validity.h"
#include "unit/arrangement/random_solids.h"
#include "unit/spatial_relations/brute_force.h"

namespace algebra3d {

/// A set for the layer and, before it is moved, for the oracle.
struct TestSet {
  std::vector<ExactPoint> points;
  std::optional<Box3> box;
  std::optional<Surface3d> surface;
  std::optional<Volume3d> solid;
  brute_force::Set oracle;

  SpatialSet set() const {
    if (box) return *box;
    if (surface) return *surface;
    if (solid) return *solid;
    return PointSet{points};
  }
};

/// An exact map of space: axes turned, then a factor and a shift. It keeps relations.
struct ExactMove {
  int turns = 0;
  Rational factor{1}, shift{0};

  RationalVec3 operator()(const RationalVec3& p) const {
    RationalVec3 q = p;
    for (int i = 0; i < turns; ++i) q = RationalVec3(q.z, q.x, q.y);
    return {q.x * factor + shift, q.y * factor - shift, q.z * factor + shift};
  }
  TriangleMesh operator()(const TriangleMesh& mesh) const {
    PointArray points;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      points.push_back(ExactPoint((*this)(mesh.point(VertexId(v)).rational())));
    return {std::move(points), solids::triangles_of(mesh)};
  }
};

/// Sets on a small grid, so that most pairs touch in some degenerate way.
class RandomSets {
 public:
  explicit RandomSets(std::uint64_t seed) : chance_(seed) {
    move_.turns = chance_.below(3);
    switch (chance_.below(5)) {
      case 0:
        move_.factor = Rational(1, 3);
        move_.shift = Rational(1, 7);
        break;
      case 1:
        move_.shift = Rational(1000000000);
        break;
      case 2:
        move_.factor = Rational(1, 1024);
        break;
      default:
        break;
    }
  }

  /// `can_be_box` only where the map keeps doubles.
  TestSet draw() {
    const int kind = chance_.below(10);
    if (kind == 0) return draw_points();
    if (kind <= 2 && move_.factor != Rational(1, 3)) return draw_box();
    if (kind <= 5) return draw_surface();
    return draw_solid();
  }

 private:
  Vec3 grid_point() { return chance_.grid_point(kGrid); }

  TestSet draw_points() {
    TestSet result;
    for (int n = chance_.below(4); n > 0; --n) {
      const Vec3 p = 0.5 * chance_.grid_point(2 * kGrid - 1);
      result.oracle.points.push_back(brute_force::to_cgal(p));
      result.points.emplace_back(move_(RationalVec3(p)));
    }
    std::ranges::sort(result.points);
    result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
    return result;
  }

  TestSet draw_box() {
    TestSet result;
    Box3 box = Box3::of(grid_point());
    box.extend(grid_point());
    int dimension = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) dimension += box.min[axis] < box.max[axis] ? 1 : 0;
    if (dimension == 0) result.oracle.points = {brute_force::to_cgal(box.min)};
    if (dimension == 1) result.oracle.segments = {{brute_force::to_cgal(box.min), brute_force::to_cgal(box.max)}};
    if (dimension == 2) {
      Vec3 b = box.min, c = box.max;
      // One more corner on each side of the diagonal.
      const std::size_t axis = box.min.x < box.max.x ? 0 : 1;
      b[axis] = box.max[axis];
      c[axis] = box.min[axis];
      result.oracle = brute_force::Set::of_mesh(solids::Maker().quad(box.min, b, box.max, c).mesh(), false);
    }
    if (dimension == 3) result.oracle = brute_force::Set::of_mesh(solids::box(box.min, box.max), true);
    const auto moved = [&](const Vec3& p) {
      const RationalVec3 q = move_(RationalVec3(p));
      return Vec3{q.x.nearest_double(), q.y.nearest_double(), q.z.nearest_double()};
    };
    result.box = Box3::of(moved(box.min));
    result.box->extend(moved(box.max));
    return result;
  }

  TestSet draw_surface() {
    for (;;) {
      const TriangleMesh mesh = surface_mesh();
      if (!prove_surface(mesh)->is_valid()) continue;
      TestSet result;
      result.oracle = brute_force::Set::of_mesh(mesh, false);
      result.surface = Surface3d::trusted(move_(mesh));
      return result;
    }
  }

  TriangleMesh surface_mesh() {
    solids::Maker maker;
    switch (chance_.below(5)) {
      case 0:  // triangles anywhere
        for (int n = chance_.between(1, 3); n > 0; --n) maker.triangle(grid_point(), grid_point(), grid_point());
        break;
      case 1: {  // a box with openings
        const TriangleMesh box = grid_box();
        for (std::size_t f = 0; f < box.face_count(); ++f)
          if (!chance_.one_in(3)) add(maker, box, f);
        break;
      }
      case 2: {  // unit squares of a level
        const double z = chance_.below(kGrid);
        for (int x = 0; x + 1 < kGrid; ++x)
          for (int y = 0; y + 1 < kGrid; ++y)
            if (chance_.one_in(2)) add_square(maker, {double(x), double(y), z}, {1, 0, 0}, {0, 1, 0});
        break;
      }
      case 3: {  // pages of a book
        const Vec3 foot = grid_point();
        for (const Vec3& page : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}})
          if (!chance_.one_in(3)) add_square(maker, foot, page, {0, 0, 1});
        break;
      }
      default: {  // a tetrahedron with or without a face
        const TriangleMesh solid = grid_tetrahedron();
        for (std::size_t f = 0; f < 4; ++f)
          if (f > 0 || chance_.one_in(4)) add(maker, solid, f);
        break;
      }
    }
    return maker.mesh();
  }

  static void add(solids::Maker& maker, const TriangleMesh& mesh, std::size_t face) {
    const TriangleRef corners = mesh.corners(FaceId(face));
    maker.triangle(corners[0].approx, corners[1].approx, corners[2].approx);
  }
  static void add_square(solids::Maker& maker, const Vec3& foot, const Vec3& u, const Vec3& v) {
    maker.quad(foot, foot + u, foot + u + v, foot + v);
  }

  TestSet draw_solid() {
    const TriangleMesh mesh = solid_mesh();
    TestSet result;
    result.oracle = brute_force::Set::of_mesh(mesh, true);
    result.solid = Volume3d::trusted(move_(mesh));
    return result;
  }

  TriangleMesh solid_mesh() {
    switch (chance_.below(7)) {
      case 0:
      case 1:
        return grid_box();
      case 2:
      case 3:
        return grid_tetrahedron();
      case 4:
        return combined(grid_box(), grid_box(), [](const WindingVector& w) { return w[0] > 0 && w[1] == 0; });
      case 5:
        return combined(grid_box(), grid_box(), [](const WindingVector& w) { return w[0] != w[1]; });
      default:  // a cavity
        return combined(solids::cube(0, kGrid - 1),
                        chance_.one_in(2) ? solids::cube(1, kGrid - 2) : small_tetrahedron(),
                        [](const WindingVector& w) { return w[0] > 0 && w[1] == 0; });
    }
  }

  static TriangleMesh combined(const TriangleMesh& a, const TriangleMesh& b, const KeepRule& rule) {
    const std::array<Operand, 2> operands{{{&a, 0}, {&b, 1}}};
    return *combine_solids(operands, rule);
  }
  static TriangleMesh small_tetrahedron() { return solids::tetrahedron({1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}); }

  TriangleMesh grid_box() {
    Vec3 low = grid_point(), high = grid_point();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
      if (low[axis] == high[axis]) low[axis] > 0 ? low[axis] -= 1 : high[axis] += 1;
    }
    return solids::box(low, high);
  }
  TriangleMesh grid_tetrahedron() {
    for (;;) {
      const Vec3 a = grid_point(), b = grid_point(), c = grid_point(), d = grid_point();
      if (dot(cross(b - a, c - a), d - a) != 0) return solids::tetrahedron(a, b, c, d);
    }
  }

  static constexpr int kGrid = 4;
  solids::Chance chance_;
  ExactMove move_;
};

}  // namespace algebra3d
