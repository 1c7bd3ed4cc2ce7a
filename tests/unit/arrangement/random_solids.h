#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {

/// Random numbers that depend on the seed alone, with every standard library, unlike the library's own distributions.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  /// 0 to limit - 1.
  int below(int limit) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(limit)); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool one_in(int n) { return below(n) == 0; }
  /// From -1 to 1.
  double unit() { return static_cast<double>(static_cast<std::int64_t>(engine_())) * 0x1p-63; }
  Vec3 direction() {
    const double x = unit(), y = unit();
    return {x, y, unit() + 1.5};
  }
  Vec3 grid_point(int size) {
    const int x = below(size), y = below(size);
    return {double(x), double(y), double(below(size))};
  }

 private:
  std::mt19937_64 engine_;
};

enum class Family : std::uint8_t {
  grid_boxes,          // integer corners on a small grid: everything touches
  grid_tetrahedra,     // the same with slanted faces
  common_corners,      // tetrahedra and prisms over few corners that are not integers: whole faces and edges in common
  rotated_cubes,       // general position
  rotated_grid_boxes,  // one rotation for all, rounded: nearly touching
  spheres,
  extrusions,  // polygons with integer corners, along any axis
  mixed,
};
inline constexpr int kFamilyCount = 8;

/// Where the solids of one trial lie: moved by 1e9, scaled by 1e-9 or 1e9, axes permuted.
struct Frame {
  Vec3 shift;
  double factor = 1;
  int turns = 0;

  TriangleMesh place(const TriangleMesh& mesh) const {
    return with_axes_permuted(mapped(mesh, [this](const Vec3& p) { return factor * p + shift; }), turns);
  }
};

/// Valid solids of one family in one frame. Operands may themselves be results of operations, as they are in a
/// database.
class RandomSolids {
 public:
  RandomSolids(std::uint64_t seed, SetOperations& engine)
      : chance_(seed), engine_(engine), family_(static_cast<Family>(chance_.below(kFamilyCount))) {
    axis_ = chance_.direction();
    angle_ = 3 * chance_.unit();
    has_short_coordinates_ = !chance_.one_in(3);
    for (Vec3& corner : corners_) corner = {3 * chance_.unit(), 3 * chance_.unit(), 3 * chance_.unit()};
    switch (chance_.below(6)) {
      case 0:
        frame_.shift = {1e9, -1e9, 1e9};
        break;
      case 1:
        frame_.factor = 1e-9;
        break;
      case 2:
        frame_.factor = 1e9;
        break;
      default:
        break;
    }
    frame_.turns = chance_.below(3);
  }

  Family family() const { return family_; }
  Chance& chance() { return chance_; }

  /// In general position every pair of faces gives numbers of its own, so that a trial takes a hundred times as long as
  /// one on a grid: it gets fewer and smaller operands, or most of the time would go into the cases that are rarely
  /// wrong.
  bool is_costly() const {
    return family_ == Family::rotated_cubes || family_ == Family::rotated_grid_boxes || family_ == Family::spheres;
  }

  /// An operand: mostly a plain solid, else what a few operations on such give.
  TriangleMesh operand() {
    TriangleMesh result = plain();
    if (!chance_.one_in(is_costly() ? 5 : 3)) return result;
    for (int n = is_costly() ? 1 : chance_.between(1, 3); n > 0; --n) {
      const TriangleMesh other = plain();
      switch (chance_.below(4)) {
        case 0:
          result = engine_.intersect(result, other);
          break;
        case 1:
          result = engine_.subtract(result, other);
          break;
        case 2:
          result = engine_.difference_of_both(result, other);
          break;
        default:
          result = engine_.unite(result, other);
          break;
      }
    }
    return result;
  }

  /// One that holds all the others.
  TriangleMesh surroundings() const { return frame_.place(cube(-20, 20)); }

  /// Drawn until rounding has left it valid, which it nearly always has.
  TriangleMesh plain() {
    for (;;) {
      TriangleMesh result = frame_.place(draw(family_));
      if (prove_volume(result)->is_valid()) return result;
    }
  }

 private:
  TriangleMesh draw(Family family) {
    switch (family) {
      case Family::grid_boxes:
        return grid_box(5);
      case Family::grid_tetrahedra:
        return grid_tetrahedron();
      case Family::common_corners:
        return tetrahedron_over_common_corners();
      case Family::rotated_cubes:
        return shortened(rotated_cube());
      case Family::rotated_grid_boxes:
        return shortened(rotated(grid_box(4), axis_, angle_));
      case Family::spheres:
        return shortened(any_sphere());
      case Family::extrusions:
        return extrusion();
      case Family::mixed:
        return draw(static_cast<Family>(chance_.below(kFamilyCount - 1)));
    }
    return {};
  }

  TriangleMesh grid_box(int size) {
    Vec3 low = chance_.grid_point(size), high = chance_.grid_point(size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
      if (low[axis] == high[axis]) high[axis] += 1;
    }
    return box(low, high);
  }

  TriangleMesh grid_tetrahedron() {
    for (;;) {
      const Vec3 a = chance_.grid_point(5), b = chance_.grid_point(5), c = chance_.grid_point(5);
      const Vec3 d = chance_.grid_point(5);
      if (dot(cross(b - a, c - a), d - a) != 0) return tetrahedron(a, b, c, d);
    }
  }

  TriangleMesh tetrahedron_over_common_corners() {
    for (;;) {
      const auto corner = [this] { return corners_[static_cast<std::size_t>(chance_.below(7))]; };
      const Vec3 a = corner(), b = corner(), c = corner(), d = corner();
      if (std::abs(dot(cross(b - a, c - a), d - a)) > 1e-6) return tetrahedron(a, b, c, d);
    }
  }

  /// Coordinates of a few bits, in most trials: as exact, and the numbers that grow out of them are half as long.
  TriangleMesh shortened(const TriangleMesh& mesh) const {
    if (!has_short_coordinates_) return mesh;
    const auto rounded = [](double x) { return std::round(x * 0x1p12) * 0x1p-12; };
    return mapped(mesh, [&](const Vec3& p) { return Vec3{rounded(p.x), rounded(p.y), rounded(p.z)}; });
  }

  /// A cube, or the regular tetrahedron in one.
  TriangleMesh rotated_cube() {
    const Vec3 axis = chance_.direction();
    const TriangleMesh plain =
        chance_.one_in(3) ? cube(-1, 1) : tetrahedron({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1});
    const TriangleMesh turned = rotated(plain, axis, 3 * chance_.unit());
    const double x = chance_.unit(), y = chance_.unit();
    return shifted(turned, {x, y, chance_.unit()});
  }

  TriangleMesh any_sphere() {
    const Vec3 centre = chance_.one_in(2) ? chance_.grid_point(2) : Vec3{chance_.unit(), 0, 0};
    switch (chance_.below(3)) {
      case 0:
        return shifted(sphere(chance_.between(2, 4), chance_.between(3, 5), 1), centre);
      case 1:
        return shifted(geodesic_sphere(chance_.between(1, 2)), centre);
      default:
        return shifted(rotated(geodesic_sphere(1), axis_, angle_), centre);
    }
  }

  /// Corners of a square grid round the middle one, in order of angle, seen from the first.
  TriangleMesh extrusion() {
    constexpr std::array<std::array<Corner, 8>, 4> kShapes{{
        {{{2, 2}, {0, 2}, {0, 0}, {4, 0}, {4, 1}, {4, 2}, {2, 2}, {2, 2}}},
        {{{1, 1}, {1, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 1}}},
        {{{2, 1}, {4, 4}, {2, 2}, {0, 4}, {0, 0}, {4, 0}, {2, 1}, {2, 1}}},
        {{{2, 1}, {3, 1}, {2, 3}, {1, 3}, {0, 2}, {0, 1}, {1, 0}, {2, 0}}},
    }};
    std::vector<Corner> polygon;
    for (const Corner& corner : kShapes[static_cast<std::size_t>(chance_.below(4))]) {
      if (polygon.empty() || corner != polygon.front()) polygon.push_back(corner);
    }
    const double dx = chance_.below(3), dy = chance_.below(3);
    const int quarter_turns = chance_.below(4);
    for (Corner& corner : polygon) {
      for (int i = 0; i < quarter_turns; ++i) corner = {4 - corner[1], corner[0]};
      corner = {corner[0] + dx, corner[1] + dy};
    }
    const int low = chance_.below(4);
    const int high = low + 1 + chance_.below(3);
    return with_axes_permuted(prism(polygon, low, high), chance_.below(3));
  }

  Chance chance_;
  SetOperations& engine_;
  Family family_;
  Frame frame_;
  Vec3 axis_;
  double angle_ = 0;
  bool has_short_coordinates_ = false;
  std::array<Vec3, 7> corners_;
};

}  // namespace algebra3d::solids
