#include "algebra3d/kernel/arrangement/detail/linking.h"

#include <algorithm>
#include <span>

#include "algebra3d/kernel/arrangement/detail/radial_order.h"
#include "algebra3d/kernel/arrangement/detail/sub_facets.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Two front windings whose difference is known: `b` is `a` plus `difference`.
struct Relation {
  FrontWindingId a, b;
  WindingVector difference;
};

/// Relations of front windings that follow from some space edges.
struct Relations {
  std::vector<Relation> list;
  /// The first half-plane with a jump at each space edge that is on no uncut edge: places for seeds.
  std::vector<SubEdgeSide> places;
};

/// Finds the relations at some space edges: the geometry of linking, which is done in tasks.
class RelationFinder {
 public:
  RelationFinder(const Subdivision& subdivision, const WindingJumps& jumps, const FrontWindingIds& ids)
      : subdivision_(subdivision), jumps_(jumps), ids_(ids) {}

  void add(IdRange<SubEdgeId> edge);
  Relations take() { return std::move(found_); }

 private:
  void relate_at(const UncutEdge& uncut, IdRange<SubEdgeId> edge);
  FrontWindingId relate_patches_at(const UncutEdge& uncut);
  void relate_in_front_of_faces(SubEdgeId sub_edge, FrontWindingId patch);
  void relate_round(IdRange<SubEdgeId> edge);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  const FrontWindingIds& ids_;
  Relations found_;
  // Half-edges and half-planes of the edge at hand; members, so that their memory is used again.
  std::vector<InputHalfedgeId> along_;
  std::vector<SubEdgeSide> around_;
};

void RelationFinder::add(IdRange<SubEdgeId> edge) {
  if (const UncutEdge* uncut = subdivision_.uncut_edges.find(subdivision_.sub_edges.ends[edge.front()]))
    relate_at(*uncut, edge);
  else
    relate_round(edge);
}

/// No other operand is at an uncut edge, so the windings in front of all faces along each of its sub-edges are the
/// same. The space between the faces is not looked at, since not all of them are in sub-facets.
void RelationFinder::relate_at(const UncutEdge& uncut, IdRange<SubEdgeId> edge) {
  const FrontWindingId patch = relate_patches_at(uncut);
  for (const SubEdgeId s : edge) relate_in_front_of_faces(s, patch);
}

/// Gives the front winding of one of them.
FrontWindingId RelationFinder::relate_patches_at(const UncutEdge& uncut) {
  FrontWindingId first;
  subdivision_.operands.halfedges_along(uncut.edge, along_);
  for (const InputHalfedgeId h : along_) {
    const PatchId patch = subdivision_.patches.of_face[Operands::face(h)];
    if (patch.is_none()) continue;
    const FrontWindingId front = ids_.of(patch);
    if (first.is_none())
      first = front;
    else
      found_.list.push_back({first, front, {}});
  }
  return first;
}

void RelationFinder::relate_in_front_of_faces(SubEdgeId sub_edge, FrontWindingId patch) {
  for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(sub_edge))
    for (const Side side : kSides) {
      if (!includes(incident.sides(), side)) continue;
      // In front of the face is in front of the plane, unless the face looks to the back of its plane.
      const SubEdgeSide at(sub_edge, side);
      const WindingVector excess = subdivision_.facets[incident.facet()].orientation > 0 ? WindingVector() : jumps_[at];
      found_.list.push_back({patch, ids_.of(at), -excess});
    }
}

void RelationFinder::relate_round(IdRange<SubEdgeId> edge) {
  half_planes_with_jumps(jumps_, edge, around_);
  if (around_.empty()) return;
  found_.places.push_back(around_.front());
  sort_around_space_edge(subdivision_, around_);
  // The cell between the last one and the first one adds nothing new.
  for (std::size_t i = 0; i + 1 < around_.size(); ++i) {
    const SubEdgeSide h = around_[i], next = around_[i + 1];
    // Both give the windings of the cell between the two: their front winding and the excess.
    found_.list.push_back({ids_.of(h), ids_.of(next), excess_after(jumps_, h) - excess_before(jumps_, next)});
  }
}

class Linker {
 public:
  Linker(const Subdivision& subdivision, const WindingJumps& jumps) : subdivision_(subdivision), jumps_(jumps) {}

  Result<LinkedWindings> run();

 private:
  void link_at_space_edges();
  Relations relations_at(IdRange<SubEdgeId> first_sub_edges) const;
  void find_seeds();
  std::uint32_t count_operands(IdRange<SubEdgeId> edge);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  LinkedWindings result_{{}, WindingSets(0), {}};
  std::vector<SubEdgeSide> places_;          // for seeds, ascending
  std::vector<OperandId> operands_at_edge_;  // at the space edge at hand; a member, so that its memory is used again
};

/// The relations at the space edges that begin with a sub-edge of the range.
Relations Linker::relations_at(IdRange<SubEdgeId> first_sub_edges) const {
  RelationFinder finder(subdivision_, jumps_, result_.ids);
  subdivision_.sub_edges.for_each_space_edge(first_sub_edges, [&](IdRange<SubEdgeId> edge) { finder.add(edge); });
  return finder.take();
}

/// Block by block: the relations in parallel, which is most of the work, and then the sets.
void Linker::link_at_space_edges() {
  const std::size_t count = subdivision_.sub_edges.size();
  for (std::size_t first = 0; first < count; first += kSubEdgesPerBlock) {
    const auto found = parallel_collect(
        std::min(kSubEdgesPerBlock, count - first), kSubEdgesPerTask, [&](std::size_t begin, std::size_t end) {
          std::vector<Relations> relations;
          relations.push_back(relations_at({SubEdgeId(first + begin), SubEdgeId(first + end)}));
          return relations;
        });
    for (const auto& [list, places] : found) {
      for (const auto& [a, b, difference] : list) result_.sets.unite(a, b, difference);
      places_.insert(places_.end(), places.begin(), places.end());
    }
  }
}

std::uint32_t Linker::count_operands(IdRange<SubEdgeId> edge) {
  operands_at_edge_.clear();
  for (const SubEdgeId s : edge)
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(s))
      operands_at_edge_.push_back(subdivision_.facets[incident.facet()].operand);
  std::ranges::sort(operands_at_edge_);
  return static_cast<std::uint32_t>(std::unique(operands_at_edge_.begin(), operands_at_edge_.end()) -
                                    operands_at_edge_.begin());
}

void Linker::find_seeds() {
  std::vector<SeedPlace>& seeds = result_.seeds;
  IdVector<FrontWindingId, std::uint32_t> seed_of_set(result_.ids.count(), kNone);
  std::size_t best_count = 0;  // sets with a seed at which all operands are
  for (const SubEdgeSide half_plane : places_) {
    if (best_count == result_.sets.set_count()) break;
    std::uint32_t& known = seed_of_set[result_.sets.find(result_.ids.of(half_plane)).set];
    if (known != kNone && seeds[known].operand_count == subdivision_.operands.count()) continue;
    const IdRange<SubEdgeId> edge = subdivision_.sub_edges.beside(half_plane.sub_edge());
    const SeedPlace place{edge, half_plane, count_operands(edge)};
    if (known == kNone) {
      known = static_cast<std::uint32_t>(seeds.size());
      seeds.push_back(place);
    } else if (place.operand_count > seeds[known].operand_count) {
      seeds[known] = place;
    } else {
      continue;
    }
    best_count += place.operand_count == subdivision_.operands.count() ? 1 : 0;
  }
}

Result<LinkedWindings> Linker::run() {
  A3D_ASSIGN(result_.ids, number_front_windings(subdivision_));
  result_.sets = WindingSets(result_.ids.count());
  link_at_space_edges();
  find_seeds();
  return std::move(result_);
}

}  // namespace

Result<LinkedWindings> link_windings(const Subdivision& subdivision, const WindingJumps& jumps) {
  return Linker(subdivision, jumps).run();
}

}  // namespace algebra3d::arrangement
