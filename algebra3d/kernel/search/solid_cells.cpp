#include "algebra3d/kernel/search/solid_cells.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/kernel/search/boxes.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// How many cells the boxes of all triangles may reach: each cell costs some nanoseconds.
constexpr std::size_t kMostReachedPerCell = 16, kMostReachedPerFace = 16;
/// Triangles that reach so few cells mark all of them.
constexpr std::size_t kFewCells = 8;

/// A direction that is near the normal of a triangle; any direction does for a proof that sets are apart.
Vec3 near_normal(const TriangleRef& corners) {
  return cross(corners[1].approx - corners[0].approx, corners[2].approx - corners[0].approx);
}

/// The side of cubes that divide a box into so many parts. An axis along which the box is thinner has one slice.
double side_of_cells(const Vec3& sizes, std::size_t cell_count) {
  double side = 0;
  for (std::size_t round = 0; round < 3; ++round) {
    double content = 1 / static_cast<double>(cell_count);
    int axes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (sizes[axis] > side) {
        content *= sizes[axis];
        ++axes;
      }
    if (axes > 0) side = std::pow(content, 1.0 / axes);
  }
  return side;
}

}  // namespace

SolidCells::SolidCells(const Box3& box, std::size_t cell_count) : box_(box) {
  const Vec3 sizes = box.max - box.min;
  const double side = side_of_cells(sizes, cell_count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr double kMostSlices = 1024;
    counts_[axis] = static_cast<Slices::value_type>(std::clamp(std::ceil(sizes[axis] / side), 1.0, kMostSlices));
    scale_[axis] = counts_[axis] / sizes[axis];
  }
  states_.assign(this->cell_count(), State::unvisited);
}

std::unique_ptr<const SolidCells> SolidCells::make(const TriangleMesh& mesh, const Box3& box, std::size_t cell_count,
                                                   const AreInside& are_inside) {
  constexpr double kSmallest = 0x1p-100, kLargest = 0x1p200;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = box.max[axis] - box.min[axis];
    if (!(size > kSmallest && size < kLargest && std::abs(box.min[axis]) < kLargest)) return nullptr;
  }
  std::unique_ptr<SolidCells> cells(new SolidCells(box, cell_count));
  if (!cells->mark_reached(mesh)) return nullptr;
  // Each connected set of cells that nothing reaches is first taken as outside, from the cell that is met first.
  std::vector<Slices> firsts, stack;
  std::vector<Vec3> middles;
  for (Slices::value_type z = 0; z < cells->counts_[2]; ++z)
    for (Slices::value_type y = 0; y < cells->counts_[1]; ++y)
      for (Slices::value_type x = 0; x < cells->counts_[0]; ++x) {
        const Slices first{x, y, z};
        State& state = cells->states_[cells->cell_at(first)];
        if (state != State::unvisited) continue;
        const Vec3 middle = cells->middle_of(first);
        const Range range = cells->range_of({middle, middle});
        if (range.first != first || !box.contains(middle)) {
          state = State::reached;
          continue;
        }
        firsts.push_back(first);
        middles.push_back(middle);
        cells->spread(first, State::outside, stack);
      }
  const std::vector<bool> inside = are_inside(middles);
  for (std::size_t i = 0; i < firsts.size(); ++i)
    if (inside[i]) cells->spread(firsts[i], State::inside, stack);
  return cells;
}

Vec3 SolidCells::middle_of(const Slices& slices) const {
  Vec3 middle;
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = box_.min[axis] + (slices[axis] + 0.5) / scale_[axis];
  return middle;
}

SolidCells::Range SolidCells::range_of(const Box3& box) const {
  Range range;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    range.first[axis] = slice_of(std::max(box.min[axis], box_.min[axis]), axis);
    range.last[axis] = slice_of(std::min(box.max[axis], box_.max[axis]), axis);
  }
  return range;
}

/// False if the triangles reach too many cells.
bool SolidCells::mark_reached(const TriangleMesh& mesh) {
  std::size_t left = kMostReachedPerCell * cell_count() + kMostReachedPerFace * mesh.face_count();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const TriangleRef corners = mesh.corners(FaceId(f));
    const Range range = range_of(box_of_triangle(corners));
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) count *= range.last[axis] - range.first[axis] + 1U;
    if (count > left) return false;
    left -= count;
    if (count > kFewCells) {
      mark_reached_by(corners, range);
      continue;
    }
    for (auto z = range.first[2]; z <= range.last[2]; ++z)
      for (auto y = range.first[1]; y <= range.last[1]; ++y) {
        const std::size_t row = cell_at({0, y, z});
        for (auto x = range.first[0]; x <= range.last[0]; ++x) states_[row + x] = State::reached;
      }
  }
  return true;
}

/// A cell is left out if a plane along the triangle separates the two. Both sides are sums of three products of
/// numbers below `largest`, so 2^-40 of that covers the roundings: of the sums, of the normal (which may be any
/// direction), of exact corners, and of the slice of a coordinate, which is off by 2^-40 of the box at most; and
/// 2^-1000 covers products of subnormal numbers.
void SolidCells::mark_reached_by(const TriangleRef& corners, const Range& range) {
  const Vec3 normal = near_normal(corners);
  double largest = 0, reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::abs(normal[axis]);
    largest += size * std::max(std::abs(box_.min[axis]), std::abs(box_.max[axis]));
    reach += size * 0.5 / scale_[axis];
  }
  const double margin = largest * 0x1p-38 + 0x1p-1000;
  double least = Box3::kInfinity, greatest = -Box3::kInfinity;
  for (const PointRef& corner : corners) {
    const double height = dot(normal, corner.approx);
    least = std::min(least, height);
    greatest = std::max(greatest, height);
  }
  for (auto z = range.first[2]; z <= range.last[2]; ++z)
    for (auto y = range.first[1]; y <= range.last[1]; ++y)
      for (auto x = range.first[0]; x <= range.last[0]; ++x) {
        const double height = dot(normal, middle_of({x, y, z}));
        // Not a number where the normal is too long: reached.
        if (height - reach > greatest + margin || height + reach < least - margin) continue;
        states_[cell_at({x, y, z})] = State::reached;
      }
}

void SolidCells::spread(const Slices& from, State state, std::vector<Slices>& stack) {
  states_[cell_at(from)] = state;
  stack.assign(1, from);
  while (!stack.empty()) {
    const Slices slices = stack.back();
    stack.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const Slices::value_type step : {~0U, 1U}) {
        Slices next = slices;
        next[axis] += step;  // -1 as an unsigned number: before the first slice is beyond the last one
        if (next[axis] >= counts_[axis]) continue;
        State& reached = states_[cell_at(next)];
        if (reached == State::reached || reached == state) continue;
        reached = state;
        stack.push_back(next);
      }
  }
}

}  // namespace algebra3d
