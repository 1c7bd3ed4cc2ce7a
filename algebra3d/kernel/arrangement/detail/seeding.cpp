#include "algebra3d/kernel/arrangement/detail/seeding.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/cell_above.h"
#include "algebra3d/kernel/arrangement/detail/faces_above.h"
#include "algebra3d/kernel/arrangement/detail/point_location.h"
#include "algebra3d/kernel/arrangement/detail/radial_order.h"
#include "base/propagate.h"

namespace algebra3d::arrangement {
namespace {

/// The exact centre of a face.
ExactPoint centroid(const Operands& operands, InputFaceId face) {
  const TriangleRef corners = operands.corners(face);
  return ExactPoint(Rational(1, 3) * (corners[0].rational() + corners[1].rational() + corners[2].rational()));
}

/// If no more operands than this may surround a patch, they are looked at one by one.
constexpr std::size_t kMany = 8;

/// Links sets with patches that more than eight operands may surround to the next patch or the cell above them: an
/// upward ray from the highest face of each set hits a patch of another set, to which this one is linked, or leads to
/// the unbounded cell, whose windings are 0. So each set looks at one other, and none needs more than the way to it,
/// however many are around it. Sets whose rays hit faces that are in no patch are left to be seeded. For operands of
/// which each is closed alone. Gives the windings of those sets of which a ray leads to the unbounded cell, directly or
/// by way of the sets that are linked now. Exact. Errors: interrupted.
class UpwardLinker {
 public:
  UpwardLinker(const Subdivision& subdivision, LinkedWindings& linked, PointLocation& location)
      : operands_(subdivision.operands),
        patches_(subdivision.patches),
        linked_(linked),
        location_(location),
        face_tree_(operands_),
        faces_above_(operands_, face_tree_) {}

  Result<SetWindings> run(const Monitor& monitor);

 private:
  /// Windings of a cell: those of a front winding and how much they exceed it.
  struct CellWindings {
    FrontWindingId front;
    WindingVector excess;
  };
  /// Where a ray upwards has ended.
  struct RayEnd {
    CellWindings below;                 ///< the cell above the last face of the own set
    std::optional<CellWindings> above;  ///< the same cell, as another set knows it; nothing: the unbounded cell
  };
  /// A face by the height of its middle, rounded.
  struct Highest {
    double height;
    InputFaceId face;

    void raise_to(const Highest& other) {
      if (face.is_none() || height < other.height) *this = other;
    }
  };

  FrontWindingId set_of(PatchId patch) { return linked_.sets.find(linked_.ids.of(patch)).set; }
  CellWindings cell_beside(PatchId patch, bool is_in_front) const;
  std::vector<InputFaceId> highest_faces();
  IdVector<PatchId, Highest> highest_faces_of_patches() const;
  std::optional<RayEnd> shoot_up(InputFaceId start);

  const Operands& operands_;
  const Patches& patches_;
  LinkedWindings& linked_;
  PointLocation& location_;
  FaceTree face_tree_;
  FacesAbove faces_above_;
};

UpwardLinker::CellWindings UpwardLinker::cell_beside(PatchId patch, bool is_in_front) const {
  const std::size_t group = operands_.group(patches_[patch].operand);
  return {linked_.ids.of(patch), WindingVector::of_group(group, is_in_front ? 0 : 1)};
}

IdVector<PatchId, UpwardLinker::Highest> UpwardLinker::highest_faces_of_patches() const {
  IdVector<PatchId, Highest> highest(patches_.patches.size());
  for (const InputFaceId face : operands_.faces()) {
    const PatchId patch = patches_.of_face[face];
    if (patch.is_none()) continue;
    const TriangleRef corners = operands_.corners(face);
    highest[patch].raise_to({corners[0].approx.z / 3 + corners[1].approx.z / 3 + corners[2].approx.z / 3, face});
  }
  return highest;
}

/// The highest face (by its middle) of the patches of each set, ascending: from there the way up is shortest.
std::vector<InputFaceId> UpwardLinker::highest_faces() {
  const IdVector<PatchId, Highest> of_patches = highest_faces_of_patches();
  std::map<FrontWindingId, Highest> of_sets;
  for (const PatchId patch : of_patches.ids()) of_sets[set_of(patch)].raise_to(of_patches[patch]);
  std::vector<InputFaceId> result;
  result.reserve(of_sets.size());
  for (const auto& [set, highest] : of_sets) result.push_back(highest.face);
  std::ranges::sort(result);
  return result;
}

/// Nothing if the ray hits a face that is in no patch, or two faces at one height.
std::optional<UpwardLinker::RayEnd> UpwardLinker::shoot_up(InputFaceId start) {
  const PatchId patch = patches_.of_face[start];
  const FrontWindingId own_set = set_of(patch);
  RayEnd end{cell_beside(patch, is_cell_above_in_front(operands_.corners(start))), {}};
  bool are_all_patches = true;
  const bool is_ordered = faces_above_.for_each(centroid(operands_, start), [&](InputFaceId face, int sign) {
    const PatchId hit = patches_.of_face[face];
    are_all_patches = !hit.is_none();
    if (!are_all_patches) return false;
    const bool is_own = set_of(hit) == own_set;
    if (is_own)
      end.below = cell_beside(hit, sign > 0);
    else
      end.above = cell_beside(hit, sign < 0);
    return is_own;
  });
  if (!is_ordered || !are_all_patches) return std::nullopt;
  return end;
}

/// Sets that are linked are one set from then on. Each set takes one step, which links it to another or ends in the
/// unbounded cell; so of the sets that became one, one has ended there.
Result<SetWindings> UpwardLinker::run(const Monitor& monitor) {
  SetWindings known;
  if (operands_.count() <= kMany) return known;
  std::vector<CellWindings> unbounded;
  for (const InputFaceId face : highest_faces()) {
    if (!location_.has_more_near(operands_.point(Operands::halfedge(face, 0)), kMany)) continue;
    A3D_TRY(monitor.check());
    const std::optional<RayEnd> end = shoot_up(face);
    if (!end) continue;
    if (end->above)
      linked_.sets.unite(end->below.front, end->above->front, end->below.excess - end->above->excess);
    else
      unbounded.push_back(end->below);
  }
  for (const auto& [front, excess] : unbounded) {
    const auto [set, difference] = linked_.sets.find(front);
    known.try_emplace(set, -excess - difference);
  }
  return known;
}

/// Front windings at single places, for operands of which each is closed alone: an operand that has a face there is
/// known from that face (in front of it is outside), every other one from an upward ray. Exact.
class SeedFromFaces {
 public:
  SeedFromFaces(const Subdivision& subdivision, const WindingJumps& jumps, PointLocation& location)
      : subdivision_(subdivision), jumps_(jumps), location_(location) {}

  /// The front winding at the half-plane of the seed. Cost: an upward ray for each operand near to the edge that has no
  /// face there.
  WindingVector at_place(const SeedPlace& seed);
  /// The front winding of the patch. Cost: an upward ray for each other operand near to it.
  WindingVector at_patch(PatchId patch);

 private:
  std::vector<SubEdgeSide> half_planes_after(const SeedPlace& seed) const;
  std::vector<OperandId> add_operands_with_faces(std::span<const SubEdgeSide> around, WindingVector& windings) const;
  void add_others(const PointRef& point, const std::vector<OperandId>& known, WindingVector& windings);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  PointLocation& location_;
};

/// All half-planes in radial order, that of the seed last.
std::vector<SubEdgeSide> SeedFromFaces::half_planes_after(const SeedPlace& seed) const {
  std::vector<SubEdgeSide> around;
  covered_half_planes(subdivision_.sub_edges, seed.sub_edges, around);
  std::swap(around.front(), *std::ranges::find(around, seed.half_plane));
  sort_around_space_edge(subdivision_, around);
  std::rotate(around.begin(), around.begin() + 1, around.end());
  return around;
}

/// Adds the operands with a face at the line that hold the cell before the first half-plane: the first face of an
/// operand that is met from there says on which side of it this is. Gives the operands with faces, ascending.
std::vector<OperandId> SeedFromFaces::add_operands_with_faces(std::span<const SubEdgeSide> around,
                                                              WindingVector& windings) const {
  std::vector<OperandId> known;
  for (const SubEdgeSide h : around)
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(h.sub_edge())) {
      const auto& [operand, plane, orientation, faces] = subdivision_.facets[incident.facet()];
      if (!includes(incident.sides(), h.side()) || std::ranges::find(known, operand) != known.end()) continue;
      known.push_back(operand);
      // A left half-plane is met from behind.
      const bool is_inside = (h.side() == Side::left) == (orientation > 0);
      if (is_inside) ++windings[subdivision_.operands.group(operand)];
    }
  std::ranges::sort(known);
  return known;
}

/// Adds the operands other than `known` (ascending) that hold the point.
void SeedFromFaces::add_others(const PointRef& point, const std::vector<OperandId>& known, WindingVector& windings) {
  for (const OperandId operand : location_.near(point))
    if (!std::ranges::binary_search(known, operand))
      windings[subdivision_.operands.group(operand)] += location_.winding_number(operand, point);
}

WindingVector SeedFromFaces::at_place(const SeedPlace& seed) {
  WindingVector windings;
  const std::vector<OperandId> known = add_operands_with_faces(half_planes_after(seed), windings);
  const auto [u, v] = subdivision_.sub_edges[seed.sub_edges.front()].ends;
  if (known.size() != subdivision_.operands.count())
    add_others(subdivision_.complex.nodes.middle(u, v), known, windings);
  return windings - excess_after(jumps_, seed.half_plane);
}

WindingVector SeedFromFaces::at_patch(PatchId patch) {
  const auto& [operand, first_face] = subdivision_.patches[patch];
  WindingVector windings;
  add_others(subdivision_.operands.point(Operands::halfedge(first_face, 0)), {operand}, windings);
  return windings;
}

/// Front windings at single places, for operands that are closed only together: no face says on which side of its
/// operand the inside is, so all windings come from the cell above a point (faces_above.h). The cell above an edge lies
/// beside one half-plane there; from this to the half-plane that is asked for the difference is known from `linked`, in
/// which linking has united both. Exact. Cost of each: an upward ray through all operands.
class SeedFromAbove {
 public:
  SeedFromAbove(const Subdivision& subdivision, const WindingJumps& jumps, PointLocation& location,
                LinkedWindings& linked)
      : subdivision_(subdivision), jumps_(jumps), location_(location), linked_(linked) {}

  /// The front winding at the half-plane of the seed.
  WindingVector at_place(const SeedPlace& seed);
  /// The front winding of the patch.
  WindingVector at_patch(PatchId patch);

 private:
  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  PointLocation& location_;
  LinkedWindings& linked_;
};

WindingVector SeedFromAbove::at_place(const SeedPlace& seed) {
  std::vector<SubEdgeSide> around;
  half_planes_with_jumps(jumps_, seed.sub_edges, around);
  sort_around_space_edge(subdivision_, around);
  const SubEdgeSide below = half_plane_before_cell_above(subdivision_, around);
  const auto [u, v] = subdivision_.sub_edges[below.sub_edge()].ends;
  const WindingVector front =
      location_.windings_above(subdivision_.complex.nodes.middle(u, v)) - excess_after(jumps_, below);
  const auto from = linked_.sets.find(linked_.ids.of(below)), to = linked_.sets.find(linked_.ids.of(seed.half_plane));
  return front - from.difference + to.difference;
}

WindingVector SeedFromAbove::at_patch(PatchId patch) {
  const auto& [operand, first_face] = subdivision_.patches[patch];
  const WindingVector above = location_.windings_above(centroid(subdivision_.operands, first_face));
  if (is_cell_above_in_front(subdivision_.operands.corners(first_face))) return above;
  return above - WindingVector::of_group(subdivision_.operands.group(operand), 1);
}

/// Takes the windings of each set that is not known yet from `source`, at a place of the set.
template <typename Source>
Status seed_each_set(Source source, LinkedWindings& linked, const Patches& patches, const Monitor& monitor,
                     SetWindings& known) {
  const auto seed = [&](FrontWindingId front, const auto& find) -> Status {
    const auto [set, difference] = linked.sets.find(front);
    const auto [entry, is_new] = known.try_emplace(set);
    if (!is_new) return {};
    A3D_TRY(monitor.check());
    entry->second = find() - difference;
    return {};
  };
  for (const SeedPlace& place : linked.seeds)
    A3D_TRY(seed(linked.ids.of(place.half_plane), [&] { return source.at_place(place); }));
  for (const PatchId patch : patches.ids()) A3D_TRY(seed(linked.ids.of(patch), [&] { return source.at_patch(patch); }));
  return {};
}

}  // namespace

Result<SetWindings> seed_windings(const Subdivision& subdivision, const WindingJumps& jumps, LinkedWindings& linked,
                                  Closure closure, const Monitor& monitor) {
  PointLocation location(subdivision.operands);
  SetWindings known;
  if (closure == Closure::each) {
    A3D_ASSIGN(known, UpwardLinker(subdivision, linked, location).run(monitor));
  }
  // Places where many operands meet need the fewest rays.
  std::ranges::stable_sort(linked.seeds, std::greater(), &SeedPlace::operand_count);
  const Patches& patches = subdivision.patches;
  const Status status =
      closure == Closure::each
          ? seed_each_set(SeedFromFaces(subdivision, jumps, location), linked, patches, monitor, known)
          : seed_each_set(SeedFromAbove(subdivision, jumps, location, linked), linked, patches, monitor, known);
  A3D_TRY(status);
  return known;
}

}  // namespace algebra3d::arrangement
