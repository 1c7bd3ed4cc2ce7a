#include "algebra3d/kernel/repair/detail/opposite_sets.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"

namespace algebra3d {

OppositeSets::OppositeSets(const TriangleMesh& mesh, const DuplicateSets& sets,
                           const IdVector<FaceId, bool>& is_dropped)
    : mesh_(mesh),
      sets_(sets),
      is_dropped_(is_dropped),
      set_of_(mesh.face_count()),
      groups_(sets.size()),
      votes_(sets.size()),
      neighbours_(sets.size()),
      is_flipped_(sets.size()) {
  for (const DuplicateSetId set : sets.ids())
    for (const FaceId triangle : sets[set].triangles) set_of_[triangle] = set;
  for (const DuplicateSetId set : sets.ids())
    for (const HalfedgeId edge : halfedges_of(mesh, sets[set].triangles[0])) look_at(set, edge);
}

OppositeSets::EdgeSurroundings OppositeSets::surroundings(DuplicateSetId set, HalfedgeId edge) const {
  EdgeSurroundings result;
  if (!mesh_.is_nonmanifold(edge)) return result;
  for (const HalfedgeId h : mesh_.edge_halfedges(edge)) {
    const FaceId triangle = TriangleMesh::face(h);
    const DuplicateSetId other = set_of_[triangle];
    if (other.is_none() && !is_dropped_[triangle]) result.single.push_back(h);
    const bool is_first_of_other = !other.is_none() && other != set && sets_[other].triangles[0] == triangle;
    if (is_first_of_other) result.others.emplace(other, h);
  }
  return result;
}

/// Links the set to another one across the edge, or counts the edge's vote.
void OppositeSets::look_at(DuplicateSetId set, HalfedgeId edge) {
  const auto [single, others] = surroundings(set, edge);
  const auto runs_along = [&](HalfedgeId h) { return mesh_.origin(h) == mesh_.origin(edge); };
  if (single.empty() && others.size() == 1) {
    const auto& [other, h] = *others.begin();
    groups_.unite(set, other);
    neighbours_[set].push_back({other, runs_along(h)});
  }
  if (single.empty() || !others.empty()) return;
  const double length_of_edge = length(mesh_.point(mesh_.target(edge)).approx - mesh_.point(mesh_.origin(edge)).approx);
  votes_[set] += single.size() % 2 == 1 ? length_of_edge : -length_of_edge;
  if (single.size() == 1 && !is_flipped_[set]) is_flipped_[set] = runs_along(single[0]);
}

IdVector<DuplicateSetId, bool> OppositeSets::are_needed() {
  IdVector<DuplicateSetId, double> group_votes(sets_.size());
  for (const DuplicateSetId set : sets_.ids()) group_votes[groups_.find(set)] += votes_[set];
  const FaceComponents components = connected_components(mesh_);
  std::vector<bool> is_all_double(components.count, true);
  for (const FaceId face : set_of_.ids())
    if (set_of_[face].is_none()) is_all_double[components.of_face[face.index()]] = false;
  IdVector<DuplicateSetId, bool> result(sets_.size());
  for (const DuplicateSetId set : sets_.ids())
    result[set] =
        group_votes[groups_.find(set)] > 0 || is_all_double[components.of_face[sets_[set].triangles[0].index()]];
  return result;
}

/// Orients all sets of the group whose orientation is not known, by that of one.
void OppositeSets::spread_orientation(DuplicateSetId from) {
  std::vector<DuplicateSetId> reached{from};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const Neighbour& neighbour : neighbours_[reached[i]]) {
      if (is_flipped_[neighbour.set]) continue;
      is_flipped_[neighbour.set] = *is_flipped_[reached[i]] != neighbour.same_direction;
      reached.push_back(neighbour.set);
    }
}

FaceId OppositeSets::choose(DuplicateSetId set) const {
  const auto& triangles = sets_[set].triangles;
  const auto is_even_face = [&](FaceId face) { return is_even(mesh_.triangle(face)); };
  const bool even = is_even_face(triangles[0]) != *is_flipped_[set];
  return *std::ranges::find_if(triangles, [&](FaceId face) { return is_even_face(face) == even; });
}

IdVector<DuplicateSetId, FaceId> OppositeSets::kept() {
  for (const DuplicateSetId set : sets_.ids())
    if (is_flipped_[set]) spread_orientation(set);
  const IdVector<DuplicateSetId, bool> needed = are_needed();
  IdVector<DuplicateSetId, FaceId> result(sets_.size());
  for (const DuplicateSetId set : sets_.ids()) {
    if (!needed[set]) continue;
    if (!is_flipped_[set]) {
      is_flipped_[set] = false;
      spread_orientation(set);
    }
    result[set] = choose(set);
  }
  return result;
}

}  // namespace algebra3d
