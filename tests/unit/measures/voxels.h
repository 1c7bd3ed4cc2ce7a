#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "algebra3d/values/types/spatial.h"
#include "base/box_corners.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d {

/// A set of unit cells of a small grid: a solid of which everything can be counted.
class Voxels {
 public:
  static constexpr int kSide = 4;
  using Cell = std::array<int, 3>;

  bool has(const Cell& cell) const { return cells_.contains(cell); }
  void add(const Cell& cell) { cells_.insert(cell); }
  const std::set<Cell>& cells() const { return cells_; }
  bool is_empty() const { return cells_.empty(); }

  /// A block, perhaps with other blocks and cells added and taken away.
  static Voxels draw(solids::Chance& chance) {
    Voxels result;
    for (int n = chance.between(1, 3); n > 0; --n) {
      const bool adds = result.is_empty() || !chance.one_in(3);
      Cell low{}, high{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = chance.below(kSide);
        high[axis] = chance.between(low[axis], kSide - 1);
      }
      for (int x = low[0]; x <= high[0]; ++x)
        for (int y = low[1]; y <= high[1]; ++y)
          for (int z = low[2]; z <= high[2]; ++z) adds ? result.add({x, y, z}) : void(result.cells_.erase({x, y, z}));
    }
    return result;
  }

  /// The union of the cells, with coordinates times a factor, plus a shift.
  Volume3d solid(const Rational& factor = 1, const Rational& shift = 0) const {
    std::vector<TriangleMesh> cubes;
    for (const auto& [x, y, z] : cells_) {
      PointArray points;
      for (unsigned i = 0; i < 8; ++i) {
        const auto at = [&](int cell, unsigned bit) { return Rational(cell + int(i >> bit & 1U)) * factor + shift; };
        points.push_back(ExactPoint(RationalVec3(at(x, 0), at(y, 1), at(z, 2))));
      }
      cubes.emplace_back(std::move(points), kBoxTriangles);
    }
    std::vector<Operand> operands;
    for (const TriangleMesh& cube : cubes) operands.push_back({&cube, 0});
    const auto any = [](const WindingVector& windings) { return windings[0] > 0; };
    return cubes.empty() ? Volume3d() : Volume3d::trusted(*combine_solids(operands, any));
  }

  /// The bodies: cells that are connected across squares.
  std::vector<Voxels> bodies() const {
    std::vector<Voxels> result;
    std::set<Cell> left = cells_;
    while (!left.empty()) {
      std::vector<Cell> stack{*left.begin()};
      left.erase(left.begin());
      Voxels& body = result.emplace_back();
      while (!stack.empty()) {
        const Cell cell = stack.back();
        stack.pop_back();
        body.add(cell);
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const int step : {-1, 1}) {
            Cell next = cell;
            next[axis] += step;
            if (left.erase(next) > 0) stack.push_back(next);
          }
      }
    }
    return result;
  }
  Voxels without(const Voxels& other) const {
    Voxels result;
    for (const Cell& cell : cells_)
      if (!other.has(cell)) result.add(cell);
    return result;
  }
  std::size_t common_count(const Voxels& other) const { return cells_.size() - without(other).cells_.size(); }

  /// A unit square by its axis and the cell in front of it.
  using Square = std::pair<std::size_t, Cell>;
  std::set<Square> boundary() const {
    std::set<Square> squares;
    for (const Cell& cell : cells_)
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int step : {0, 1}) {
          Cell square = cell, neighbour = cell;
          square[axis] += step;
          neighbour[axis] += step == 0 ? -1 : 1;
          if (!has(neighbour)) squares.insert({axis, square});
        }
    return squares;
  }

  /// The square of the distance of two sets of cells.
  static int squared_distance(const Voxels& a, const Voxels& b) {
    int least = 3 * kSide * kSide;
    for (const Cell& p : a.cells_)
      for (const Cell& q : b.cells_) {
        int sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int gap = std::max(0, std::abs(p[axis] - q[axis]) - 1);
          sum += gap * gap;
        }
        least = std::min(least, sum);
      }
    return least;
  }

  enum class Place : std::uint8_t { outside, boundary, inside };
  /// Where a point lies that is given in quarters.
  Place place(const Cell& quarters) const {
    bool is_touched = false, is_surrounded = true;
    std::array<std::array<int, 2>, 3> ranges{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int whole = quarters[axis] >= 0 ? quarters[axis] / 4 : (quarters[axis] - 3) / 4;
      ranges[axis] = {quarters[axis] % 4 == 0 ? whole - 1 : whole, whole};
    }
    for (const int x : ranges[0])
      for (const int y : ranges[1])
        for (const int z : ranges[2]) {
          is_touched = is_touched || has({x, y, z});
          is_surrounded = is_surrounded && has({x, y, z});
        }
    return is_surrounded ? Place::inside : is_touched ? Place::boundary : Place::outside;
  }

 private:
  std::set<Cell> cells_;
};

}  // namespace algebra3d
