#include "algebra3d/repair/bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/scaled_triangles.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// A boundary without a vertex twice, in the order in which new facets run along it.
struct Rim {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> normals;  ///< of the facets beyond the edges from each vertex to the next
  std::uint32_t part = 0;     ///< the connected part of the surface that it is of
  Box3 box;                   ///< scaled, as the area
  double area = 0;            ///< of the flattest cover at least
};

/// Triangles between two rims.
struct Band {
  std::size_t first, second;  ///< rims
  bool turns_one = false;     ///< one of the parts has to be turned over for it
  std::vector<TriangleMesh::Triangle> triangles;
  double area = 0;
  double bend =
      0;  ///< the mean cosine of the angle between its triangles and the facets beyond: -1 if it is folded back
};

class BandCloser {
 public:
  BandCloser(FacetList& facets, double largest, RepairReport& report)
      : facets_(facets),
        largest_(largest),
        report_(report),
        linked_(facets.mesh()),
        parts_(connected_components(*linked_)),
        scale_(largest_coordinate(*linked_)) {}

  /// True if there are some.
  Result<bool> run(const Monitor& monitor);

 private:
  Vec3 point(std::uint32_t vertex) const { return scale_.scaled(facets_.points[vertex]); }
  double distance(std::uint32_t a, std::uint32_t b) const { return length(point(b) - point(a)); }
  void find_rims();
  void add_rim(const BoundaryLoop& boundary);
  bool are_close(const Rim& a, const Rim& b) const;
  std::optional<Band> band_between(std::size_t first, std::size_t second) const;
  Band march(std::size_t first, std::size_t second, bool turns_one) const;
  Result<std::vector<Band>> candidates(const Monitor& monitor) const;
  std::uint32_t smaller_part(const Band& band) const;
  void add(Band band);

  FacetList& facets_;
  double largest_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> linked_;  // the facets as given
  FaceComponents parts_;
  BinaryScale scale_;
  std::vector<Rim> rims_;
};

void BandCloser::add_rim(const BoundaryLoop& boundary) {
  Rim rim;
  rim.part = parts_.of_face[TriangleMesh::face(boundary.halfedges[0]).index()];
  for (std::size_t i = boundary.halfedges.size(); i-- > 0;) {
    const HalfedgeId h = boundary.halfedges[i];
    rim.vertices.push_back(linked_->target(h).index());
    rim.normals.push_back(unit_normal(scale_.scaled(*linked_, TriangleMesh::face(h).index())));
  }
  std::vector<std::uint32_t> sorted = rim.vertices;
  std::ranges::sort(sorted);
  if (sorted.size() < 3 || std::ranges::adjacent_find(sorted) != sorted.end()) return;
  Vec3 doubled;
  for (std::size_t i = 0; i < rim.vertices.size(); ++i) {
    const Vec3 from = point(rim.vertices[i]), to = point(rim.vertices[(i + 1) % rim.vertices.size()]);
    rim.box.extend(from);
    doubled = doubled + cross(from - point(rim.vertices[0]), to - point(rim.vertices[0]));
  }
  rim.area = length(doubled) / 2;
  rims_.push_back(std::move(rim));
}

void BandCloser::find_rims() {
  for (const BoundaryLoop& boundary : boundary_loops(*linked_))
    if (boundary.is_closed) add_rim(boundary);
}

double diameter_of(const Box3& box) {
  return length(box.max - box.min);
}

/// Only if their boxes are nearly the same, and they are not larger than may be.
bool BandCloser::are_close(const Rim& a, const Rim& b) const {
  constexpr double kOfDiameter = 0.5;
  constexpr std::size_t kMostPairs = 4'000'000;
  const double most = kOfDiameter * std::min(diameter_of(a.box), diameter_of(b.box));
  Box3 both = a.box;
  both.extend(b.box.min);
  both.extend(b.box.max);
  return length(a.box.min - b.box.min) <= most && length(a.box.max - b.box.max) <= most &&
         scale_.length(diameter_of(both)) <= largest_ && a.vertices.size() * b.vertices.size() <= kMostPairs;
}

/// From the two corners that are nearest to each other round both rims, over the shorter diagonal each time. New facets
/// run along both rims forward, so the way along the second one leads back, unless it is turned over.
Band BandCloser::march(std::size_t first, std::size_t second, bool turns_one) const {
  const std::vector<std::uint32_t>& a = rims_[first].vertices;
  std::vector<std::uint32_t> b = rims_[second].vertices;
  std::vector<Vec3> beyond_b = rims_[second].normals;
  if (!turns_one) {
    std::ranges::reverse(b);
    // Edges from each vertex to the next, as well.
    std::ranges::reverse(beyond_b);
    std::rotate(beyond_b.begin(), beyond_b.begin() + 1, beyond_b.end());
  }
  std::size_t i = 0, j = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t l = 0; l < b.size(); ++l)
      if (distance(a[k], b[l]) < distance(a[i], b[j])) i = k, j = l;
  Band band{first, second, turns_one, {}, 0, 0};
  double rim_length = 0;
  const auto add = [&](const TriangleMesh::Triangle& t, double edge, const Vec3& beyond) {
    const Triangle3 corners{point(t[0]), point(t[1]), point(t[2])};
    band.triangles.push_back(t);
    band.area += area_of(corners);
    band.bend += edge * dot(unit_normal(corners), beyond);
    rim_length += edge;
  };
  std::size_t left_of_a = a.size(), left_of_b = b.size();
  while (left_of_a + left_of_b > 0) {
    const std::size_t next_i = (i + 1) % a.size(), next_j = (j + 1) % b.size();
    const bool takes_a = left_of_b == 0 || (left_of_a > 0 && distance(a[next_i], b[j]) <= distance(a[i], b[next_j]));
    if (takes_a) {
      add({a[i], a[next_i], b[j]}, distance(a[i], a[next_i]), rims_[first].normals[i]);
      i = next_i;
      --left_of_a;
    } else {
      add({b[next_j], b[j], a[i]}, distance(b[j], b[next_j]), (turns_one ? -1.0 : 1.0) * beyond_b[j]);
      j = next_j;
      --left_of_b;
    }
  }
  band.bend = rim_length > 0 ? band.bend / rim_length : -1;
  return band;
}

/// None if both may as well be closed by themselves.
std::optional<Band> BandCloser::band_between(std::size_t first, std::size_t second) const {
  constexpr double kMuchLess = 0.5, kFoldedBack = -0.7;
  if (!are_close(rims_[first], rims_[second])) return std::nullopt;
  Band best = march(first, second, false);
  Band turned = march(first, second, true);
  if (turned.area < best.area) {
    // The other way round it would twist the surface.
    if (rims_[first].part == rims_[second].part) return std::nullopt;
    best = std::move(turned);
  }
  // What is folded back lies upon the surface between the rims, as between those of a ring.
  if (best.bend < kFoldedBack) return std::nullopt;
  if (best.area < kMuchLess * (rims_[first].area + rims_[second].area)) return best;
  return std::nullopt;
}

/// Those of least area first.
Result<std::vector<Band>> BandCloser::candidates(const Monitor& monitor) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t i = 0; i < rims_.size(); ++i) entries.push_back({Box3::of(rims_[i].box.min), i});
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<Band> result;
  for (std::uint32_t i = 0; i < rims_.size(); ++i) {
    RETURN_IF_ERROR(monitor.check());
    const double reach = diameter_of(rims_[i].box) / 2;
    Box3 window = Box3::of(rims_[i].box.min);
    window.min = window.min - Vec3{reach, reach, reach};
    window.max = window.max + Vec3{reach, reach, reach};
    for (const std::uint32_t other : tree.window(window))
      if (other > i)
        if (auto band = band_between(i, other)) result.push_back(*std::move(band));
  }
  std::ranges::sort(result, {}, [](const Band& band) { return std::tuple(band.area, band.first, band.second); });
  return result;
}

std::uint32_t BandCloser::smaller_part(const Band& band) const {
  const std::uint32_t first = rims_[band.first].part, second = rims_[band.second].part;
  double more = 0;  // area of the first
  for (std::uint32_t f = 0; f < linked_->face_count(); ++f) {
    if (parts_.of_face[f] == first) more += area_of(scale_.scaled(*linked_, f));
    if (parts_.of_face[f] == second) more -= area_of(scale_.scaled(*linked_, f));
  }
  return more < 0 ? first : second;
}

void BandCloser::add(Band band) {
  if (band.turns_one) {
    const std::uint32_t part = smaller_part(band);
    for (std::uint32_t f = 0; f < linked_->face_count(); ++f) {
      if (parts_.of_face[f] != part) continue;
      std::swap(facets_.triangles[f][1], facets_.triangles[f][2]);
      report_.add(RepairStep::turned_facets, facets_.middle(f));
    }
    if (part == rims_[band.first].part)
      for (TriangleMesh::Triangle& triangle : band.triangles) std::swap(triangle[1], triangle[2]);
  }
  HoleCover cover{facets_.points[rims_[band.first].vertices[0]], 0, {}};
  for (const TriangleMesh::Triangle& t : band.triangles) {
    const std::array<Vec3, 3> corners{facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]};
    for (std::size_t i = 0; i < 3; ++i)
      cover.farthest = std::max(cover.farthest, length(corners[(i + 1) % 3] - corners[i]) / std::numbers::sqrt3);
    cover.triangles.push_back(corners);
    facets_.triangles.push_back(t);
  }
  report_.add(std::move(cover));
}

Result<bool> BandCloser::run(const Monitor& monitor) {
  find_rims();
  ASSIGN_OR_RETURN(std::vector<Band> bands, candidates(monitor));
  std::vector<bool> is_closed(rims_.size()), is_changed(parts_.count);
  bool has_some = false;
  for (Band& band : bands) {
    const std::uint32_t first = rims_[band.first].part, second = rims_[band.second].part;
    if (is_closed[band.first] || is_closed[band.second]) continue;
    // Which way parts look is known anew in the next round.
    if (is_changed[first] || is_changed[second]) continue;
    is_closed[band.first] = is_closed[band.second] = true;
    if (first != second) is_changed[first] = is_changed[second] = true;
    add(std::move(band));
    has_some = true;
  }
  if (has_some) facets_.changed();
  return has_some;
}

}  // namespace

Result<bool> close_bands(FacetList& facets, double largest, RepairReport& report, const Monitor& monitor) {
  constexpr int kMostRounds = 20;
  bool has_some = false;
  for (int round = 0; round < kMostRounds; ++round) {
    ASSIGN_OR_RETURN(const bool found, BandCloser(facets, largest, report).run(monitor));
    if (!found) break;
    has_some = true;
  }
  return has_some;
}

}  // namespace algebra3d
