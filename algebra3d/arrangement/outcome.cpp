#include "algebra3d/arrangement/outcome.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "algebra3d/arrangement/bucket_sort.h"
#include "algebra3d/arrangement/clean_edges.h"
#include "algebra3d/arrangement/outcome_mesh.h"
#include "algebra3d/arrangement/triangulation.h"
#include "algebra3d/base/parallel.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A boundary edge of the kept part of a plane, with this part to its left, seen from the front of the plane.
struct KeptEdge {
  std::uint32_t plane;
  bool is_flipped;  ///< the part's own front is the back of the plane
  std::uint32_t from, to;

  auto region() const { return std::tuple(plane, is_flipped); }
  friend auto operator<=>(const KeptEdge&, const KeptEdge&) = default;
};

class OutcomeBuilder {
 public:
  OutcomeBuilder(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches, const Selection& selection)
      : skeleton_(skeleton),
        pieces_(pieces),
        patches_(patches),
        selection_(selection),
        clean_edges_(clean_edges(skeleton, patches)),
        mesh_(skeleton, patches, kept_patches()) {}

  Result<TriangleMesh> run();

 private:
  /// A boundary edge of a region as one of its ends sees it.
  struct Spoke {
    std::uint32_t vertex, other;
    std::tuple<std::uint32_t, bool> region;
    bool is_outgoing;

    friend auto operator<=>(const Spoke&, const Spoke&) = default;
  };
  /// A vertex in the middle of a straight edge of a region, on the way from one vertex to the next.
  struct Passage {
    std::uint32_t vertex;
    std::tuple<std::uint32_t, bool> region;
    std::uint32_t before, after;

    auto place() const { return std::tuple(vertex, region); }
    friend auto operator<=>(const Passage&, const Passage&) = default;
  };

  struct Region {
    std::uint32_t plane;
    bool is_flipped, has_exact_corner;
    bool is_bounded;                                ///< by its edges, all round
    std::vector<TriangleMesh::Triangle> triangles;  ///< that cover it
  };
  static constexpr std::size_t kRegionsWorthAThread = 64;

  std::vector<int> kept_patches() const;
  std::array<int, 2> kept_sides(std::uint32_t number) const;
  void collect_edges();
  void find_passages();
  void find_passages_at(std::span<const Spoke> spokes);
  void find_passages_of_clean_edges();
  bool is_edge_of_patch(const Spoke& spoke) const;
  bool continue_each_other(std::span<const Spoke> one, std::span<const Spoke> other, std::span<const Spoke> all) const;
  bool is_half_disc(const Spoke& spoke, std::uint32_t opposite, std::span<const Spoke> all) const;
  std::span<const Passage> passages(const KeptEdge& edge, std::uint32_t vertex) const;
  bool comes_from_afar(const KeptEdge& edge) const;
  std::uint32_t beyond(const KeptEdge& edge) const;
  void straighten();
  void triangulate_regions();
  Region region_of(std::span<const KeptEdge> boundary) const;
  Status check_regions() const;

  const Skeleton& skeleton_;
  const Pieces& pieces_;
  const Patches& patches_;
  const Selection& selection_;
  std::vector<Passage> passages_;  // ascending
  std::vector<KeptEdge> edges_;
  std::vector<CleanEdge> clean_edges_;
  /// Lines that edges of patches occupy, ascending.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> patch_lines_;
  std::vector<Region> regions_;
  OutcomeMesh mesh_;
};

std::vector<int> OutcomeBuilder::kept_patches() const {
  std::vector<int> kept(patches_.patches.size());
  for (std::uint32_t p = 0; p < kept.size(); ++p) kept[p] = selection_.patch(p);
  return kept;
}

/// What is kept of the cells to the left and right of a piece.
std::array<int, 2> OutcomeBuilder::kept_sides(std::uint32_t number) const {
  return {pieces_.is_covered(2 * number) ? selection_.cell(2 * number) : 0,
          pieces_.is_covered(2 * number + 1) ? selection_.cell(2 * number + 1) : 0};
}

/// A line is an edge of the result unless all that is kept there is one plane on both sides of it, and no patch ends
/// there.
void OutcomeBuilder::collect_edges() {
  for (const CleanEdge& edge : clean_edges_) {
    const auto vertices = pieces_.segments.vertices(edge.segment);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
      patch_lines_.emplace_back(std::minmax(vertices[i], vertices[i + 1]));
  }
  std::ranges::sort(patch_lines_);
  const auto& pieces = pieces_.pieces;
  std::vector<std::array<int, 2>> kept;
  for (std::uint32_t first = 0, last = 0; first < pieces.size(); first = last) {
    kept.clear();
    std::size_t planes = 0;
    bool is_parted = std::ranges::binary_search(patch_lines_, std::pair(pieces[first].u, pieces[first].v));
    for (; last < pieces.size() && pieces[last].u == pieces[first].u && pieces[last].v == pieces[first].v; ++last) {
      kept.push_back(kept_sides(last));
      const auto& [left, right] = kept.back();
      if (left != 0 || right != 0) ++planes;
      is_parted = is_parted || left != right;
    }
    if (planes < 2 && !is_parted) continue;
    for (std::uint32_t p = first; p < last; ++p) {
      const auto& [left, right] = kept[p - first];
      if (left != 0) edges_.push_back({pieces[p].plane, left < 0, pieces[p].u, pieces[p].v});
      if (right != 0) edges_.push_back({pieces[p].plane, right < 0, pieces[p].v, pieces[p].u});
    }
  }
}

void OutcomeBuilder::find_passages() {
  std::vector<Spoke> spokes;
  spokes.reserve(2 * edges_.size());
  for (const KeptEdge& edge : edges_) {
    spokes.push_back({edge.from, edge.to, edge.region(), true});
    spokes.push_back({edge.to, edge.from, edge.region(), false});
  }
  bucket_sort(
      spokes, skeleton_.vertices().size(), [](const Spoke& s) { return s.vertex; }, std::ranges::less());
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    while (end < spokes.size() && spokes[end].vertex == spokes[begin].vertex) ++end;
    find_passages_at(std::span(spokes).subspan(begin, end - begin));
  }
  find_passages_of_clean_edges();
  std::ranges::sort(passages_);
  passages_.erase(std::unique(passages_.begin(), passages_.end()), passages_.end());
}

/// Where a patch ends, its edge is whole; so it has to be whole in the regions on its other sides.
void OutcomeBuilder::find_passages_of_clean_edges() {
  const Operands& operands = skeleton_.operands();
  const Facets& facets = skeleton_.facets();
  for (const CleanEdge& edge : clean_edges_) {
    const auto vertices = pieces_.segments.vertices(edge.segment);
    for (const std::uint32_t h : edge.halfedges) {
      if (facets.of_face(h / 3) == kNone || vertices.size() == 2) continue;
      const Facet& facet = facets[facets.of_face(h / 3)];
      // The facet lies to the left of its half-edge, seen from its own front; the region's edges have it to their left,
      // seen from the front of the plane, whichever way the region looks.
      const bool runs_along = mesh_.vertex_of_corner(operands.vertex(h)) == vertices.front();
      const bool is_forward = runs_along == (facet.orientation > 0);
      for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
        for (const bool is_flipped : {false, true})
          passages_.push_back({vertices[i],
                               {facet.plane, is_flipped},
                               vertices[is_forward ? i - 1 : i + 1],
                               vertices[is_forward ? i + 1 : i - 1]});
    }
  }
}

void OutcomeBuilder::find_passages_at(std::span<const Spoke> spokes) {
  const VertexPool& points = skeleton_.vertices();
  const PointRef here = points[spokes[0].vertex];
  const bool is_fixed = mesh_.is_fixed(spokes[0].vertex);
  std::vector<std::span<const Spoke>> arms;  // the spokes to one other vertex
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    while (end < spokes.size() && spokes[end].other == spokes[begin].other) ++end;
    if (!is_fixed || !is_edge_of_patch(spokes[begin])) arms.push_back(spokes.subspan(begin, end - begin));
  }
  for (std::size_t i = 0; i < arms.size(); ++i)
    for (std::size_t j = i + 1; j < arms.size(); ++j) {
      if (!continue_each_other(arms[i], arms[j], spokes)) continue;
      const PointRef one = points[arms[i][0].other], other = points[arms[j][0].other];
      if (compare(one, here) != compare(here, other) || !collinear(one, here, other)) continue;
      for (const Spoke& spoke : arms[i]) {
        const std::uint32_t from = arms[i][0].other, to = arms[j][0].other;
        passages_.push_back({spoke.vertex, spoke.region, spoke.is_outgoing ? to : from, spoke.is_outgoing ? from : to});
      }
    }
}

/// The edge of a patch is whole or ends here, as the patch has it.
bool OutcomeBuilder::is_edge_of_patch(const Spoke& spoke) const {
  const std::pair<std::uint32_t, std::uint32_t> line = std::minmax(spoke.vertex, spoke.other);
  return std::ranges::binary_search(patch_lines_, line);
}

/// True if the boundaries of all regions that come along one arm leave along the other, and each region is half a disc
/// at the vertex, on its side of the line: then none of them needs the vertex as a corner. What else is there, of the
/// same regions too, touches the straight edge in a point.
bool OutcomeBuilder::continue_each_other(std::span<const Spoke> one, std::span<const Spoke> other,
                                         std::span<const Spoke> all) const {
  if (one.size() != other.size()) return false;
  return std::ranges::all_of(one, [&](const Spoke& spoke) {
    const auto continues = [&](const Spoke& s) {
      return s.region == spoke.region && s.is_outgoing != spoke.is_outgoing;
    };
    return std::ranges::count_if(other, continues) == 1 && is_half_disc(spoke, other[0].other, all);
  });
}

/// `opposite` is the other end of the second arm. True if no other boundary edge of the spoke's region ends at
/// the vertex on the side of the line where the region lies along the spoke.
bool OutcomeBuilder::is_half_disc(const Spoke& spoke, std::uint32_t opposite, std::span<const Spoke> all) const {
  const VertexPool& points = skeleton_.vertices();
  const Projection projection = skeleton_.facets().planes()[std::get<0>(spoke.region)].projection;
  return std::ranges::none_of(all, [&](const Spoke& s) {
    if (s.region != spoke.region || s.other == spoke.other || s.other == opposite) return false;
    const int turn = orient2d(projection, points[spoke.vertex], points[spoke.other], points[s.other]);
    return (turn > 0) == spoke.is_outgoing;
  });
}

/// Those of the edge's region at the vertex.
std::span<const OutcomeBuilder::Passage> OutcomeBuilder::passages(const KeptEdge& edge, std::uint32_t vertex) const {
  const std::tuple place(vertex, edge.region());
  const auto first = std::ranges::lower_bound(passages_, place, {}, &Passage::place);
  const auto last = std::ranges::upper_bound(first, passages_.end(), place, {}, &Passage::place);
  return {first, last};
}

/// True if the edge is not the first of a straight run.
bool OutcomeBuilder::comes_from_afar(const KeptEdge& edge) const {
  return std::ranges::any_of(passages(edge, edge.from), [&](const Passage& p) { return p.after == edge.to; });
}

/// The vertex to which the straight edge goes on; kNone if it ends.
std::uint32_t OutcomeBuilder::beyond(const KeptEdge& edge) const {
  for (const Passage& passage : passages(edge, edge.to))
    if (passage.before == edge.from) return passage.after;
  return kNone;
}

/// Replaces runs of edges through passages by one edge each.
void OutcomeBuilder::straighten() {
  std::vector<KeptEdge> straight;
  for (const KeptEdge& edge : edges_) {
    if (comes_from_afar(edge)) continue;
    KeptEdge last = edge;
    for (std::uint32_t next = beyond(last); next != kNone; next = beyond(last))
      last.from = std::exchange(last.to, next);
    straight.push_back({edge.plane, edge.is_flipped, edge.from, last.to});
  }
  edges_ = std::move(straight);
  std::ranges::sort(edges_);
}

void OutcomeBuilder::triangulate_regions() {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < edges_.size(); ++i)
    if (i == 0 || edges_[i].region() != edges_[i - 1].region()) starts.push_back(i);
  regions_.resize(starts.size());
  in_halves(starts.size(), kRegionsWorthAThread, [&](std::size_t i) {
    const std::size_t end = i + 1 == starts.size() ? edges_.size() : starts[i + 1];
    regions_[i] = region_of(std::span(edges_).subspan(starts[i], end - starts[i]));
  });
}

OutcomeBuilder::Region OutcomeBuilder::region_of(std::span<const KeptEdge> boundary) const {
  const VertexPool& vertices = skeleton_.vertices();
  std::vector<DirectedEdge> edges;
  edges.reserve(boundary.size());
  for (const KeptEdge& edge : boundary) edges.emplace_back(edge.from, edge.to);
  const auto& [plane, is_flipped] = boundary.front().region();
  Region region{plane, is_flipped, false, false, {}};
  region.triangles.reserve(edges.size());
  region.is_bounded = triangulate(vertices, skeleton_.facets().planes()[plane].projection, edges, region.triangles);
  region.has_exact_corner =
      !std::ranges::all_of(edges, [&](const DirectedEdge& edge) { return vertices[edge.first].is_double(); });
  return region;
}

Status OutcomeBuilder::check_regions() const {
  for (const Region& region : regions_) {
    if (region.is_bounded) continue;
    const Vec3 where = skeleton_.facets().planes()[region.plane].triangle[0].approx;
    return Error{ErrorCode::internal,
                 "building the result of a set operation: the edges in the plane of a triangle near ({} {} {}) do not "
                 "bound a face all round",
                 where.x, where.y, where.z};
  }
  return {};
}

Result<TriangleMesh> OutcomeBuilder::run() {
  const auto find_regions = [&] {
    collect_edges();
    find_passages();
    straighten();
    triangulate_regions();
    mesh_.take_surroundings();
  };
  const auto take_faces = [&] { mesh_.take_faces(); };
  in_parallel(skeleton_.operands().face_count() >= kWorthAThread, find_regions, take_faces);
  RETURN_IF_ERROR(check_regions());
  for (const Region& region : regions_)
    mesh_.add_region(region.triangles, region.plane, region.is_flipped, region.has_exact_corner);
  return mesh_.finish();
}

}  // namespace

Result<TriangleMesh> build_outcome(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches,
                                   const Selection& selection) {
  return OutcomeBuilder(skeleton, pieces, patches, selection).run();
}

}  // namespace algebra3d::arrangement
