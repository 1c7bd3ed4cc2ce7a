#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/ring_masks.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

enum class DooSabinRules : std::uint8_t {
  mean,  ///< a new corner is the mean of the corner, the middles of the edges beside it and that of the face
  doo,   ///< the weights of [doo1978], see doo_sabin_corners
  open   ///< these weights, and no faces at the boundary
};
constexpr std::array<std::string_view, 3> kDooSabinRuleNames{"mean", "doo", "open"};

DooSabinRules rules_of(std::size_t variant) {
  return static_cast<DooSabinRules>(variant);
}

/// The new corners of a face; the rules agree where it has four.
void new_corners(DooSabinRules rules, const std::vector<Vec3>& ring, std::vector<Vec3>& result) {
  if (rules != DooSabinRules::mean) {
    doo_sabin_corners(ring, result);
    return;
  }
  const std::size_t n = ring.size();
  Vec3 sum;
  for (const Vec3& p : ring) sum = sum + p;
  const auto count = static_cast<double>(n);
  const Vec3 quarter = 0.25 * Vec3{sum.x / count, sum.y / count, sum.z / count};
  result.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 beside = ring[i == 0 ? n - 1 : i - 1] + ring[i + 1 == n ? 0 : i + 1];
    result[i] = (0.5 * ring[i] + 0.125 * beside) + quarter;
  }
}

/// The new vertex on a boundary edge at the end `near`: Chaikin's rule, so that the boundary is a quadratic B-spline.
Vec3 boundary_point(const Vec3& near, const Vec3& far) {
  return 0.75 * near + 0.25 * far;
}

/// A step of Doo-Sabin. Vertex h of the result belongs to half-edge h, that is, to the corner that it leaves. Then come
/// two vertices for each boundary edge, at its origin and at its target. The result has a face per face, with the same
/// half-edges; then one per edge, between the corners at both its ends in both faces, or at the boundary between those
/// in its face and the vertices on the edge; then one per vertex, between its corners, and at the boundary with the
/// vertices on both boundary edges. With the rules `open` there is nothing for boundary edges and vertices.
template <typename View>
class DooSabin {
 public:
  DooSabin(const View& view, const StepInput& input)
      : view_(view),
        monitor_(input.monitor),
        rules_(rules_of(input.variant)),
        stage_(input.monitor, input.what,
               4 * block_count(view.halfedge_count()) + block_count(view.face_count()) +
                   2 * block_count(view.vertex_count())),
        edges_(view, is_open() ? Edges::interior : Edges::all, stage_),
        boundary_(view, Edges::boundary, stage_),
        first_of_vertices_(view.halfedge_count() + 4 * edges_.count()) {
    count_vertex_faces();
  }

  Result<PolygonMesh> step() {
    A3D_TRY(monitor_.check());
    const Place end = vertex_faces_.back();
    const std::size_t on_boundary = is_open() ? 0 : std::size_t{2} * boundary_.count();
    RefinedMesh refined(view_.halfedge_count() + on_boundary, end.halfedge);
    starts_.resize(end.face + 1);
    starts_.back() = HalfedgeId(end.halfedge).index();
    edge_numbers_.resize(view_.halfedge_count());
    write_faces(refined);
    if (!is_open()) write_boundary_vertices(refined);
    write_edge_faces(refined);
    A3D_TRY(monitor_.check());
    write_vertex_faces(refined);
    A3D_TRY(monitor_.check());
    return std::move(refined).finish(PolygonLayout(std::move(starts_)), monitor_);
  }

 private:
  /// A face of the result and its first half-edge.
  struct Place {
    std::size_t face = 0, halfedge = 0;
  };

  bool is_open() const { return rules_ == DooSabinRules::open; }
  bool has_face(VertexId v) const {
    return view_.outgoing(v).is_valid() && !(is_open() && view_.is_boundary_vertex(v));
  }
  /// The new vertex of the corner that h leaves, and those on a boundary edge.
  static VertexId corner(HalfedgeId h) { return VertexId(h.index()); }
  VertexId at_origin(HalfedgeId h) const { return boundary_vertices_[h.index()]; }
  VertexId at_target(HalfedgeId h) const { return VertexId(at_origin(h).index() + 1); }
  /// The sides of the face of edge e: 0 in the face of its first half-edge h, 1 across at the origin of h, 2 on the
  /// other side, 3 across at the target.
  HalfedgeId edge_side(EdgeNumber e, unsigned place) const {
    return HalfedgeId(view_.halfedge_count() + std::size_t{4} * e.index() + place);
  }
  /// That across at the origin of h, which need not be the first half-edge of its edge; and at its target.
  HalfedgeId across_origin(HalfedgeId h) const {
    return edge_side(edge_numbers_[h.index()], view_.is_first_of_edge(h) ? 1 : 3);
  }
  HalfedgeId across_target(HalfedgeId h) const {
    return edge_side(edge_numbers_[h.index()], view_.is_first_of_edge(h) ? 3 : 1);
  }

  /// Where the faces of each block of vertices begin.
  void count_vertex_faces() {
    vertex_faces_.resize(block_count(view_.vertex_count()) + 1);
    for_each_block<VertexId>(view_.vertex_count(), stage_, [&](std::size_t block, IdRange<VertexId> vertices) {
      Place size;
      for (const VertexId v : vertices) {
        if (!has_face(v)) continue;
        ++size.face;
        view_.for_each_outgoing(view_.outgoing(v), [&](HalfedgeId) { ++size.halfedge; });
        if (view_.is_boundary_vertex(v)) size.halfedge += 2;
      }
      vertex_faces_[block + 1] = size;
    });
    vertex_faces_.front() = {view_.face_count() + edges_.count(), first_of_vertices_};
    for (std::size_t block = 1; block < vertex_faces_.size(); ++block) {
      vertex_faces_[block].face += vertex_faces_[block - 1].face;
      vertex_faces_[block].halfedge += vertex_faces_[block - 1].halfedge;
    }
  }

  void write_faces(RefinedMesh& refined) {
    for_each_block<FaceId>(view_.face_count(), stage_, [&](std::size_t, IdRange<FaceId> faces) {
      std::vector<Vec3> ring, corners;
      for (const FaceId f : faces) {
        starts_[f.index()] = view_.first(f).index();
        ring.clear();
        for (const HalfedgeId h : view_.halfedges_of(f)) ring.push_back(view_.origin_point(h));
        new_corners(rules_, ring, corners);
        std::size_t place = 0;
        for (const HalfedgeId h : view_.halfedges_of(f)) {
          refined.set_vertex(corner(h), corners[place++], h);
          refined.set_corner(h, corner(h));
          if (view_.is_boundary(h)) refined.set_opposite(h, HalfedgeId::none());
        }
      }
    });
  }

  void write_boundary_vertices(RefinedMesh& refined) {
    boundary_vertices_.resize(view_.halfedge_count());
    boundary_.for_each(stage_, [&](HalfedgeId h, EdgeNumber b) {
      boundary_vertices_[h.index()] = VertexId(view_.halfedge_count() + std::size_t{2} * b.index());
      refined.points[at_origin(h).index()] = boundary_point(view_.origin_point(h), view_.target_point(h));
      refined.points[at_target(h).index()] = boundary_point(view_.target_point(h), view_.origin_point(h));
    });
  }

  /// The face of an edge runs against the faces beside it: in the face of h from its target to its origin, then across
  /// to the other side, back there, and across again. Half-edges that run across are linked to the faces of vertices.
  void write_edge_faces(RefinedMesh& refined) {
    edges_.for_each(stage_, [&](HalfedgeId h, EdgeNumber e) {
      const HalfedgeId o = view_.opposite(h);
      starts_[view_.face_count() + e.index()] = edge_side(e, 0).index();
      edge_numbers_[h.index()] = e;
      refined.set_corner(edge_side(e, 0), corner(view_.next(h)));
      refined.set_corner(edge_side(e, 1), corner(h));
      refined.link(edge_side(e, 0), h);
      if (o.is_none()) {
        refined.set_corner(edge_side(e, 2), at_origin(h));
        refined.set_corner(edge_side(e, 3), at_target(h));
        refined.set_opposite(edge_side(e, 2), HalfedgeId::none());
        refined.outgoing[at_origin(h).index()] = edge_side(e, 2);
        return;
      }
      edge_numbers_[o.index()] = e;
      refined.set_corner(edge_side(e, 2), corner(view_.next(o)));
      refined.set_corner(edge_side(e, 3), corner(o));
      refined.link(edge_side(e, 2), o);
      if (!is_open()) return;
      end_at_boundary(h, edge_side(e, 1), refined);
      end_at_boundary(o, edge_side(e, 3), refined);
    });
  }

  /// If the origin of h is at the boundary, then so is `across`, the side of the edge's face there.
  void end_at_boundary(HalfedgeId h, HalfedgeId across, RefinedMesh& refined) const {
    if (!view_.is_boundary_vertex(view_.origin(h))) return;
    refined.set_opposite(across, HalfedgeId::none());
    refined.outgoing[corner(h).index()] = across;
  }

  void write_vertex_faces(RefinedMesh& refined) {
    for_each_block<VertexId>(view_.vertex_count(), stage_, [&](std::size_t block, IdRange<VertexId> vertices) {
      Place place = vertex_faces_[block];
      for (const VertexId v : vertices) {
        if (!has_face(v)) continue;
        starts_[place.face++] = HalfedgeId(place.halfedge).index();
        const HalfedgeId first = view_.outgoing(v);
        // A side from corner h to the next one counter-clockwise, across the edge before h.
        const HalfedgeId last = view_.for_each_outgoing(first, [&](HalfedgeId h) {
          const HalfedgeId side(place.halfedge++);
          refined.set_corner(side, corner(h));
          refined.link(side, across_target(view_.prev(h)));
        });
        if (!view_.is_boundary(first)) continue;
        write_boundary_sides(view_.prev(last), first, place, refined);
      }
    });
  }

  /// The sides of a boundary vertex's face along the boundary, from half-edge `before` to `after`, and from there to
  /// its first corner.
  void write_boundary_sides(HalfedgeId before, HalfedgeId after, Place& place, RefinedMesh& refined) const {
    const HalfedgeId along(place.halfedge++), back(place.halfedge++);
    refined.set_corner(along, at_target(before));
    refined.set_opposite(along, HalfedgeId::none());
    refined.outgoing[at_target(before).index()] = along;
    refined.set_corner(back, at_origin(after));
    refined.link(back, across_origin(after));
  }

  View view_;
  Monitor monitor_;
  DooSabinRules rules_;
  Stage stage_;
  EdgeEnumeration<View> edges_, boundary_;
  std::size_t first_of_vertices_;
  std::vector<Place> vertex_faces_;          // per block of vertices, and the end
  LargeVector<std::uint32_t> starts_;        // per face of the result, and the end
  LargeVector<EdgeNumber> edge_numbers_;     // per half-edge whose edge has a face
  LargeVector<VertexId> boundary_vertices_;  // per boundary half-edge its vertex at the origin
};

/// As many corners as half-edges, twice; four half-edges per edge; and two more per vertex of the boundary.
MeshSize dual_size(const MeshSize& size, std::size_t variant) {
  if (rules_of(variant) == DooSabinRules::open) return {4 * size.halfedges, 0, false};
  return {4 * (size.halfedges + size.boundary_halfedges), 2 * size.boundary_halfedges};
}

Result<PolygonMesh> doo_sabin_step(const StepInput& input) {
  return with_view(input.mesh, [&](const auto& view) { return DooSabin(view, input).step(); });
}

/// Per new vertex the half-edge at whose corner it is. Those on a boundary edge have that edge's half-edge and the
/// next.
std::vector<HalfedgeId> corners_of_vertices(const PolygonMesh& mesh, const PolygonMesh& after) {
  std::vector<HalfedgeId> corners;
  for (const HalfedgeId h : halfedges(mesh)) corners.push_back(h);
  if (after.vertex_count() == corners.size()) return corners;
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    if (mesh.is_boundary(h)) corners.insert(corners.end(), {h, mesh.next(h)});
  }
  return corners;
}

/// Texts of vertices and corners are those that all corners of the face have, or both ends of the boundary edge.
void add_ring_sources(const PolygonMesh& mesh, const PolygonMesh& after, bool of_corners, ValueBlends& blends,
                      ValueSources& sources) {
  const auto value = [&](HalfedgeId h) { return of_corners ? h.index() : mesh.origin(h).index(); };
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    const auto mean = of_corners ? mean_of_corners(mesh, f, blends) : mean_of_vertices(mesh, f, blends);
    sources.insert(sources.end(), mesh.degree(f), mean);
  }
  if (after.vertex_count() == mesh.halfedge_count()) return;
  for (const HalfedgeId h : halfedges(mesh))
    if (mesh.is_boundary(h)) sources.insert(sources.end(), 2, blends.add_between(value(h), value(mesh.next(h)), 0.5));
}

/// The sources of the result. Its first faces have those of the mesh as sources; the faces for edges and vertices have
/// all faces around. Edges have no source.
Provenance doo_sabin_provenance(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given) {
  const PolygonMesh& mesh = input.mesh;
  Provenance provenance{{}, ElementBlends(mesh)};
  auto& [sources, blends] = provenance;
  if (given.has(MeshElement::vertex)) add_ring_sources(mesh, after, false, blends.vertices, sources.vertices);
  if (given.has(MeshElement::halfedge)) {
    ValueSources at_vertices;
    add_ring_sources(mesh, after, true, blends.halfedges, at_vertices);
    for (const auto vertex : after.origins()) sources.halfedges.push_back(at_vertices[vertex]);
  }
  if (given.has(MeshElement::edge)) sources.edges.assign(element_count(after, MeshElement::edge), kNone);
  if (!given.has(MeshElement::face)) return provenance;
  const std::vector<HalfedgeId> corners = corners_of_vertices(mesh, after);
  std::vector<ValueBlends::Term> terms;
  for (const FaceId f : faces(after)) {
    poll_interruption_at(f.index());
    if (f.index() < mesh.face_count()) {
      sources.faces.push_back(f.index());
      continue;
    }
    // Each face around counts once for each of its corners; vertices on the boundary are not corners.
    terms.clear();
    for (const VertexId v : vertices_of(after, f))
      if (v.index() < mesh.halfedge_count()) terms.push_back({mesh.face(corners[v.index()]).index(), 1});
    sources.faces.push_back(blends.faces.add(terms));
  }
  return provenance;
}

/// Each new vertex belongs to one face, whose corners give the value at all its corners.
std::vector<Vec3> doo_sabin_corner_values(const StepInput& input, const PolygonMesh& after,
                                          const std::vector<Vec3>& values) {
  const PolygonMesh& mesh = input.mesh;
  std::vector<Vec3> at_vertices, ring, corners;
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    ring.clear();
    for (const HalfedgeId h : halfedges_of(mesh, f)) ring.push_back(values[h.index()]);
    new_corners(rules_of(input.variant), ring, corners);
    at_vertices.insert(at_vertices.end(), corners.begin(), corners.end());
  }
  if (rules_of(input.variant) != DooSabinRules::open)
    for (const HalfedgeId h : halfedges(mesh)) {
      if (!mesh.is_boundary(h)) continue;
      const Vec3 &origin = values[h.index()], &target = values[mesh.next(h).index()];
      at_vertices.push_back(boundary_point(origin, target));
      at_vertices.push_back(boundary_point(target, origin));
    }
  std::vector<Vec3> result;
  result.reserve(after.halfedge_count());
  for (const auto vertex : after.origins()) result.push_back(at_vertices[vertex]);
  return result;
}

/// A step makes a face of a vertex. The corners of a face go to its centre, since each step adds up to one over the new
/// and over the old corners: so the limit of a vertex is the mean of its new corners. The limit of a boundary vertex is
/// on the curve, in the middle between the new vertices at both sides.
Result<std::vector<Vec3>> doo_sabin_limits(const LimitInput& input) {
  const bool is_open = rules_of(input.variant) == DooSabinRules::open;
  const PolygonMesh& mesh = input.mesh;
  return with_view(mesh, [&](const auto& view) -> Result<std::vector<Vec3>> {
    if (is_open)
      for (const VertexId v : vertices(mesh))
        if (!mesh.is_isolated(v) && view.is_boundary_vertex(v))
          return Error{ErrorCode::invalid_value,
                       "vertex {} is on the boundary, where the rule open makes no faces, so it has no limit",
                       v.index()};
    const Stage stage(input.monitor, "finding limits", block_count(view.face_count()));
    std::vector<Vec3> corners(view.halfedge_count());
    for_each_block<FaceId>(view.face_count(), stage, [&](std::size_t, IdRange<FaceId> block) {
      std::vector<Vec3> ring, made;
      for (const FaceId f : block) {
        ring.clear();
        for (const HalfedgeId h : view.halfedges_of(f)) ring.push_back(view.origin_point(h));
        new_corners(rules_of(input.variant), ring, made);
        std::ranges::copy(made, corners.begin() + view.first(f).index());
      }
    });
    A3D_TRY(input.monitor.check());
    return limits_of_vertices(input, view, [&](VertexId v) {
      const HalfedgeId start = view.outgoing(v);
      if (view.is_boundary(start))
        return 0.75 * view.point(v) + 0.125 * (view.target_point(start) + view.point(view.boundary_predecessor(v)));
      Vec3 sum;
      double n = 0;
      view.for_each_outgoing(start, [&](HalfedgeId h) {
        sum = sum + corners[h.index()];
        n += 1;
      });
      return Vec3{sum.x / n, sum.y / n, sum.z / n};
    });
  });
}

}  // namespace

constinit const SchemeDescription kDooSabin = {.name = "doo-sabin",
                                               .needs_three_edges = true,
                                               .variants_are = "rules",
                                               .variants = kDooSabinRuleNames,
                                               .after_step = dual_size,
                                               .grows_at_boundary = true,
                                               .step = doo_sabin_step,
                                               .provenance = doo_sabin_provenance,
                                               .corner_values = doo_sabin_corner_values,
                                               .limits = doo_sabin_limits};

}  // namespace algebra3d::subdivision
