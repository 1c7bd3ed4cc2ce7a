#include "algebra3d/kernel/arrangement/detail/subdivision.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/candidates.h"
#include "algebra3d/kernel/arrangement/detail/facet_contacts.h"
#include "algebra3d/kernel/arrangement/detail/incident_facets.h"
#include "algebra3d/kernel/arrangement/detail/overlay.h"
#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Cost: linear in the segments and nodes.
UncutEdges find_uncut_edges(const Operands& operands, const SegmentComplex& complex, const SubEdges& sub_edges,
                            const Patches& patches) {
  UncutEdges result;
  std::vector<SpaceEdge> space_edges;
  std::vector<InputHalfedgeId> along;
  const auto is_of_patch = [&](InputHalfedgeId h) { return !patches.of_face[Operands::face(h)].is_none(); };
  for (const SegmentId s : complex.segments.ids()) {
    const Segment& segment = complex.segments[s];
    if (segment.edge.is_none()) continue;
    operands.halfedges_along(segment.edge, along);
    if (!std::ranges::any_of(along, is_of_patch)) continue;
    const auto nodes = sub_edges.segments.nodes(s);
    const std::size_t first = result.nodes.size();
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    result.edges.push_back({segment.edge, Slice::from(first, result.nodes)});
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      space_edges.push_back(SpaceEdge::of(nodes[i], nodes[i + 1]));
      result.edge_at.push_back(static_cast<std::uint32_t>(result.edges.size() - 1));
    }
  }
  result.space_edges = SpaceEdgeSet(space_edges, complex.nodes.size());
  return result;
}

/// Makes the segment complex, and divides its segments where they cut one another.
Result<SubEdges> find_sub_edges(Subdivision& subdivision, PairContacts contacts, Boundaries boundaries,
                                const ArrangementOptions& options, const Monitor& monitor) {
  const Operands& operands = subdivision.operands;
  const Facets& facets = subdivision.facets;
  SegmentComplex& complex = subdivision.complex;
  A3D_ASSIGN(complex, find_facet_contacts(operands, facets, contacts));
  contacts = {{}, PlanesOfFaces(operands)};  // freed
  A3D_TRY(check_stage("the facet contacts",
                      [&] { return audit(subdivision.operands, subdivision.facets, subdivision.complex); }));
  A3D_ASSIGN(complex, overlay(operands, facets, std::move(complex), monitor, options.max_cuts));
  A3D_TRY(
      check_stage("the overlay", [&] { return audit(subdivision.operands, subdivision.facets, subdivision.complex); }));
  SubEdges result = divide(facets, complex);
  if (boundaries == Boundaries::possible) {
    A3D_ASSIGN(result, with_all_incident_facets(operands, facets, complex, std::move(result), monitor));
  }
  A3D_TRY(check_stage("the sub-edges", [&] { return audit(subdivision.facets, subdivision.complex, result); }));
  return result;
}

}  // namespace

SpaceEdgeSet::SpaceEdgeSet(std::span<const SpaceEdge> edges, std::size_t node_count) {
  if (edges.empty()) return;
  begins_.resize(node_count + 1);
  ends_.resize(edges.size());
  // Counted, added up, and filled from behind, so that each begin ends where it has to be.
  for (const SpaceEdge& edge : edges) ++begins_[edge.u.index()];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  for (std::uint32_t i = 0; i < edges.size(); ++i) ends_[--begins_[edges[i].u.index()]] = {edges[i].v, i};
}

Result<Subdivision> subdivide(std::span<const Operand> list, Boundaries boundaries, const ArrangementOptions& options,
                              const Monitor& monitor) {
  Subdivision result{Operands(list), {}, {}, {}, {}, {}};
  const Operands& operands = result.operands;
  A3D_TRY(check_stage("the operands", [&] { return audit(operands); }));
  A3D_ASSIGN(Candidates candidates, find_candidates(operands, monitor, options.max_pairs));
  A3D_TRY(check_stage("the candidates", [&] { return audit(operands, candidates); }));
  A3D_ASSIGN(PairContacts contacts, find_pair_contacts(operands, candidates, monitor));
  candidates = {};  // freed
  A3D_TRY(check_stage("the contacts", [&] { return audit(operands, contacts); }));
  result.facets = make_facets(operands, contacts);
  A3D_TRY(check_stage("the facets", [&] { return audit(operands, result.facets); }));

  Result<SubEdges> sub_edges = SubEdges();
  parallel_invoke(
      operands.face_count() >= kFacesWorthATask,
      [&] { sub_edges = find_sub_edges(result, std::move(contacts), boundaries, options, monitor); },
      [&] { result.patches = find_patches(operands, result.facets); });
  A3D_ASSIGN(result.sub_edges, std::move(sub_edges));
  A3D_TRY(check_stage("the patches", [&] { return audit(operands, result.facets, result.patches); }));
  result.uncut_edges = find_uncut_edges(operands, result.complex, result.sub_edges, result.patches);
  result.sub_edges.segments = {};
  result.complex.free_segments();
  return result;
}

}  // namespace algebra3d::arrangement
