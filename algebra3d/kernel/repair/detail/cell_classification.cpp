#include "algebra3d/kernel/repair/detail/cell_classification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr std::size_t kSamplesPerCell = 16;

/// A place beside the middle of a face, in the cell that is sampled.
struct CellSample {
  double area;  ///< twice that of the face
  FaceId face;
  bool is_behind;
};

/// Twice the vector area of a face; rounded.
Vec3 normal_of_face(const TriangleMesh& surface, FaceId face) {
  const TriangleRef c = surface.corners(face);
  return cross(c[1].approx - c[0].approx, c[2].approx - c[0].approx);
}

class CellClassification {
 public:
  CellClassification(const TriangleMesh& surface, SpaceCells& cells, const GeneralizedWindingNumbers& numbers)
      : surface_(surface), cells_(cells), numbers_(numbers) {
    choose_offsets();
  }

  Result<std::map<CellId, bool>> run(const Monitor& monitor, double max_angles);

 private:
  using Samples = std::map<CellId, std::vector<CellSample>>;

  void choose_offsets();
  Samples samples_at_interfaces();
  static std::span<const CellSample> largest(std::vector<CellSample>& samples);
  bool is_inside(std::span<const CellSample> samples) const;
  Vec3 point_beside(const CellSample& sample) const;

  const TriangleMesh& surface_;
  SpaceCells& cells_;
  const GeneralizedWindingNumbers& numbers_;
  double least_offset_ = 0, most_offset_ = 0;  // of a sample point from its face
};

/// Samples lie beside their face whatever rounding does, and no farther than an interface of that size can be thick.
void CellClassification::choose_offsets() {
  constexpr double kPerDiagonal = 1e-7;
  Box3 box;
  for (const FaceId face : faces(surface_))
    for (const PointRef& corner : surface_.corners(face)) box.extend(corner.approx);
  const Vec3 extent = box.max - box.min;
  const double farthest = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                                    std::abs(box.max.y), std::abs(box.max.z)});
  least_offset_ = 64 * std::numeric_limits<double>::epsilon() * farthest;
  most_offset_ = kPerDiagonal * std::sqrt(dot(extent, extent));
}

/// Of faces with the same cell on both sides nothing is sampled.
CellClassification::Samples CellClassification::samples_at_interfaces() {
  Samples result;
  for (const FaceId face : faces(surface_)) {
    const CellId front = cells_.cell(FaceSide::front(face)), back = cells_.cell(FaceSide::back(face));
    if (front == back) continue;
    const Vec3 normal = normal_of_face(surface_, face);
    const double area = std::sqrt(dot(normal, normal));
    result[front].push_back({area, face, false});
    result[back].push_back({area, face, true});
  }
  return result;
}

/// Those at the largest faces, in the order of their area.
std::span<const CellSample> CellClassification::largest(std::vector<CellSample>& samples) {
  const std::size_t count = std::min(kSamplesPerCell, samples.size());
  const auto order = [](const CellSample& s) { return std::tuple(-s.area, s.face, s.is_behind); };
  std::ranges::partial_sort(samples, samples.begin() + static_cast<std::ptrdiff_t>(count), {}, order);
  return std::span(samples).first(count);
}

Vec3 CellClassification::point_beside(const CellSample& sample) const {
  const TriangleRef c = surface_.corners(sample.face);
  const Vec3 middle = (1.0 / 3) * (c[0].approx + c[1].approx + c[2].approx);
  const double offset = std::max(least_offset_, std::min(most_offset_, 1e-3 * std::sqrt(sample.area)));
  return middle + ((sample.is_behind ? -offset : offset) / sample.area) * normal_of_face(surface_, sample.face);
}

bool CellClassification::is_inside(std::span<const CellSample> samples) const {
  double sum = 0, total = 0;
  for (const CellSample& sample : samples) {
    if (!(sample.area > 0)) continue;
    sum += sample.area * numbers_.at(point_beside(sample));
    total += sample.area;
  }
  return total > 0 && sum > total / 2;
}

Result<std::map<CellId, bool>> CellClassification::run(const Monitor& monitor, double max_angles) {
  const std::size_t angles_before = numbers_.angle_count();
  std::map<CellId, bool> result;
  Samples all = samples_at_interfaces();
  for (auto& [cell, samples] : all) {
    if (cell == cells_.unbounded_cell()) continue;
    A3D_TRY(monitor.check());
    result[cell] = is_inside(largest(samples));
    if (static_cast<double>(numbers_.angle_count() - angles_before) > max_angles)
      return Error{ErrorCode::limit_exceeded, "inside and outside need more than {:.0f} million solid angles",
                   max_angles / 1e6};
  }
  return result;
}

}  // namespace

Result<std::map<CellId, bool>> classify_cells(const TriangleMesh& surface, SpaceCells& cells,
                                              const GeneralizedWindingNumbers& numbers, const Monitor& monitor,
                                              double max_angles) {
  return CellClassification(surface, cells, numbers).run(monitor, max_angles);
}

}  // namespace algebra3d
