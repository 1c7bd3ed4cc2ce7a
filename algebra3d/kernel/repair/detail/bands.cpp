#include "algebra3d/kernel/repair/detail/bands.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/band_loops.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

class BandCloser {
 public:
  BandCloser(IndexedSoup& soup, double largest, RepairReport& report)
      : soup_(soup),
        largest_(largest),
        report_(report),
        mesh_(soup.mesh()),
        components_(connected_components(*mesh_)),
        scale_(largest_coordinate(*mesh_)),
        loops_(band_loops(*mesh_, components_, scale_)) {}

  /// False if there are no bands.
  Result<bool> run(const Monitor& monitor);

 private:
  bool are_close(const BandLoop& a, const BandLoop& b) const;
  std::optional<Band> best_band(LoopId first, LoopId second) const;
  Result<std::vector<Band>> candidates(const Monitor& monitor) const;
  std::uint32_t smaller_component(const Band& band) const;
  void flip_component(Band& band);
  void add(Band band);

  IndexedSoup& soup_;
  double largest_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> mesh_;  // of the soup as given
  FaceComponents components_;
  BinaryScale scale_;
  IdVector<LoopId, BandLoop> loops_;
};

/// True if their boxes are nearly the same, and the loops are no larger than they may be.
bool BandCloser::are_close(const BandLoop& a, const BandLoop& b) const {
  constexpr double kOfDiameter = 0.5;
  constexpr std::size_t kMostPairs = 4'000'000;
  const double most = kOfDiameter * std::min(a.diameter(), b.diameter());
  Box3 both = a.box;
  both.extend(b.box.min);
  both.extend(b.box.max);
  return length(a.box.min - b.box.min) <= most && length(a.box.max - b.box.max) <= most &&
         scale_.unscaled(length(both.max - both.min)) <= largest_ &&
         a.vertices.size() * b.vertices.size() <= kMostPairs;
}

/// None if both loops may as well be closed by themselves.
std::optional<Band> BandCloser::best_band(LoopId first, LoopId second) const {
  constexpr double kMuchLess = 0.5, kFoldedBack = -0.7;
  if (!are_close(loops_[first], loops_[second])) return std::nullopt;
  Band best = band_between(loops_, first, second, false, soup_.points, scale_);
  Band flipped = band_between(loops_, first, second, true, soup_.points, scale_);
  if (flipped.area < best.area) {
    // Within one component it would twist the surface.
    if (loops_[first].component == loops_[second].component) return std::nullopt;
    best = std::move(flipped);
  }
  // A band that is folded back lies upon the surface between the loops, as between those of a ring.
  if (best.bend < kFoldedBack) return std::nullopt;
  if (best.area < kMuchLess * (loops_[first].area + loops_[second].area)) return best;
  return std::nullopt;
}

/// All bands that are worth it, in order of area.
Result<std::vector<Band>> BandCloser::candidates(const Monitor& monitor) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const LoopId i : loops_.ids()) entries.push_back({Box3::of(loops_[i].box.min), i.index()});
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<Band> result;
  for (const LoopId i : loops_.ids()) {
    A3D_TRY(monitor.check());
    const double reach = loops_[i].diameter() / 2;
    Box3 window = Box3::of(loops_[i].box.min);
    window.min = window.min - Vec3{reach, reach, reach};
    window.max = window.max + Vec3{reach, reach, reach};
    for (const std::uint32_t other : tree.window(window))
      if (LoopId(other) > i)
        if (auto band = best_band(i, LoopId(other))) result.push_back(*std::move(band));
  }
  std::ranges::sort(result, {}, [](const Band& band) { return std::tuple(band.area, band.first, band.second); });
  return result;
}

std::uint32_t BandCloser::smaller_component(const Band& band) const {
  const std::uint32_t first = loops_[band.first].component, second = loops_[band.second].component;
  double more = 0;  // area of the first, less that of the second
  for (const FaceId face : faces(*mesh_)) {
    const std::uint32_t component = components_.of_face[face.index()];
    if (component == first) more += area_of(scale_.scaled(*mesh_, face));
    if (component == second) more -= area_of(scale_.scaled(*mesh_, face));
  }
  return more < 0 ? first : second;
}

/// Flips the smaller component of the two; the band, too, if it follows that one.
void BandCloser::flip_component(Band& band) {
  const std::uint32_t component = smaller_component(band);
  for (const FaceId face : faces(*mesh_)) {
    if (components_.of_face[face.index()] != component) continue;
    soup_.flip(face);
    report_.add(RepairStep::flipped_triangles, soup_.middle(face));
  }
  if (component == loops_[band.first].component)
    for (TriangleMesh::Triangle& triangle : band.triangles) std::swap(triangle[1], triangle[2]);
}

void BandCloser::add(Band band) {
  if (band.flips_one) flip_component(band);
  HoleCover cover{soup_.point(loops_[band.first].vertices[0]), 0, {}};
  for (const TriangleMesh::Triangle& t : band.triangles) {
    const std::array<Vec3, 3> corners{soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]};
    for (std::size_t i = 0; i < 3; ++i)
      cover.farthest = std::max(cover.farthest, length(corners[(i + 1) % 3] - corners[i]) / std::numbers::sqrt3);
    cover.triangles.push_back(corners);
  }
  soup_.add(band.triangles);
  report_.add(std::move(cover));
}

Result<bool> BandCloser::run(const Monitor& monitor) {
  A3D_ASSIGN(std::vector<Band> bands, candidates(monitor));
  IdVector<LoopId, bool> is_closed(loops_.size());
  std::vector<bool> has_changed(components_.count);
  bool has_some = false;
  for (Band& band : bands) {
    const std::uint32_t first = loops_[band.first].component, second = loops_[band.second].component;
    if (is_closed[band.first] || is_closed[band.second]) continue;
    // Components and their orientations are known anew in the next round.
    if (has_changed[first] || has_changed[second]) continue;
    is_closed[band.first] = is_closed[band.second] = true;
    if (first != second) has_changed[first] = has_changed[second] = true;
    add(std::move(band));
    has_some = true;
  }
  return has_some;
}

}  // namespace

Result<bool> close_bands(IndexedSoup& soup, double largest, RepairReport& report, const Monitor& monitor) {
  constexpr int kMostRounds = 20;
  bool has_some = false;
  for (int round = 0; round < kMostRounds; ++round) {
    A3D_ASSIGN(const bool found, BandCloser(soup, largest, report).run(monitor));
    if (!found) break;
    has_some = true;
  }
  return has_some;
}

}  // namespace algebra3d
