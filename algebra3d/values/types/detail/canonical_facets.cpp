#include "algebra3d/values/types/detail/canonical_facets.h"

#include <algorithm>
#include <numeric>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/indices.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Places of the points in their lexicographic order; equal points do not occur in valid meshes.
std::vector<std::uint32_t> ranks_of(const PointArray& points) {
  std::vector<std::uint32_t> order(points.size()), ranks(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    poll_interruption();
    return std::is_lt(compare(points[a], points[b]));
  });
  for (std::uint32_t place = 0; place < order.size(); ++place) ranks[order[place]] = place;
  return ranks;
}

class FacetFinder {
 public:
  FacetFinder(const TriangleMesh& mesh, Orientation orientation)
      : mesh_(mesh), orientation_(orientation), ranks_(ranks_of(mesh.points())), facet_of_(mesh.face_count(), kNone) {}

  CanonicalFacets run();

 private:
  /// The other half-edge of an edge with two faces, whichever way they turn.
  HalfedgeId partner(HalfedgeId h) const {
    if (const HalfedgeId other = mesh_.opposite(h); other.is_valid()) return other;
    if (!mesh_.is_nonmanifold(h)) return {};
    const auto along = mesh_.edge_halfedges(h);
    return along.size() == 2 ? along[along[0] == h ? 1 : 0] : HalfedgeId();
  }
  bool is_coplanar_across(HalfedgeId h, HalfedgeId other) const {
    const TriangleRef corners = mesh_.corners(TriangleMesh::face(h));
    return orient3d(corners[0], corners[1], corners[2], mesh_.point(mesh_.origin(TriangleMesh::prev(other)))) == 0;
  }
  void flood(FaceId start, std::uint32_t facet);
  FacetSegment boundary(HalfedgeId h) const;
  void join_straight();
  bool is_before(const FacetSegment& a, const FacetSegment& b) const {
    poll_interruption();
    return std::pair(ranks_[a.first], ranks_[a.second]) < std::pair(ranks_[b.first], ranks_[b.second]);
  }
  bool runs_up(const FacetSegment& s) const { return ranks_[s.first] < ranks_[s.second]; }

  const TriangleMesh& mesh_;
  Orientation orientation_;
  std::vector<std::uint32_t> ranks_;
  std::vector<std::uint32_t> facet_of_;
  std::vector<FaceId> faces_;           // of the facet at hand
  std::vector<FacetSegment> segments_;  // of the facet at hand
};

void FacetFinder::flood(FaceId start, std::uint32_t facet) {
  faces_.assign(1, start);
  segments_.clear();
  facet_of_[start.index()] = facet;
  for (std::size_t next = 0; next < faces_.size(); ++next) {
    poll_interruption();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfedgeId h = TriangleMesh::halfedge(faces_[next], corner), other = partner(h);
      if (!other.is_valid() || !is_coplanar_across(h, other)) {
        segments_.push_back(boundary(h));
        continue;
      }
      const FaceId neighbour = TriangleMesh::face(other);
      if (facet_of_[neighbour.index()] != kNone) continue;
      facet_of_[neighbour.index()] = facet;
      faces_.push_back(neighbour);
    }
  }
}

FacetSegment FacetFinder::boundary(HalfedgeId h) const {
  const FacetSegment segment{mesh_.origin(h).index(), mesh_.target(h).index()};
  const bool is_turned = orientation_ == Orientation::does_not_count && !runs_up(segment);
  return is_turned ? FacetSegment{segment.second, segment.first} : segment;
}

/// Makes one segment of those that continue each other.
void FacetFinder::join_straight() {
  std::ranges::sort(segments_);
  segments_.erase(std::unique(segments_.begin(), segments_.end()), segments_.end());
  std::vector<std::uint32_t> next(segments_.size(), kNone);
  std::vector<bool> continues_another(segments_.size());
  const PointArray& points = mesh_.points();
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    poll_interruption();
    const auto [from, to] = segments_[s];
    auto candidate = std::ranges::lower_bound(segments_, FacetSegment{to, 0});
    for (; candidate != segments_.end() && candidate->first == to; ++candidate) {
      if (runs_up(*candidate) != runs_up(segments_[s])) continue;
      if (!collinear(points[from], points[to], points[candidate->second])) continue;
      next[s] = static_cast<std::uint32_t>(candidate - segments_.begin());
      continues_another[next[s]] = true;
    }
  }
  std::vector<FacetSegment> joined;
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    if (continues_another[s]) continue;
    std::uint32_t last = s;
    while (next[last] != kNone) last = next[last];
    joined.emplace_back(segments_[s].first, segments_[last].second);
  }
  std::ranges::sort(joined, [&](const auto& a, const auto& b) { return is_before(a, b); });
  segments_ = std::move(joined);
}

CanonicalFacets FacetFinder::run() {
  CanonicalFacets found;
  found.first_of_facet.push_back(0);
  for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
    poll_interruption_at(f);
    if (facet_of_[f] != kNone) continue;
    flood(FaceId(f), static_cast<std::uint32_t>(found.facet_count()));
    join_straight();
    found.segments.insert(found.segments.end(), segments_.begin(), segments_.end());
    found.first_of_facet.push_back(static_cast<std::uint32_t>(found.segments.size()));
  }
  std::vector<std::uint32_t> order(found.facet_count());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::lexicographical_compare(found.facet(a), found.facet(b),
                                                [&](const auto& s, const auto& t) { return is_before(s, t); });
  });
  CanonicalFacets sorted;
  sorted.first_of_facet.push_back(0);
  for (const std::uint32_t facet : order) {
    sorted.segments.insert(sorted.segments.end(), found.facet(facet).begin(), found.facet(facet).end());
    sorted.first_of_facet.push_back(static_cast<std::uint32_t>(sorted.segments.size()));
  }
  return sorted;
}

}  // namespace

CanonicalFacets canonical_facets(const TriangleMesh& mesh, Orientation orientation) {
  return FacetFinder(mesh, orientation).run();
}

}  // namespace algebra3d
