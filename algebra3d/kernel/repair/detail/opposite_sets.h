#pragma once

#include <map>
#include <optional>
#include <vector>

#include "algebra3d/kernel/repair/detail/duplicate_sets.h"
#include "base/disjoint_ids.h"

namespace algebra3d {

/// Decides for sets of duplicates in which both orientations are equally frequent whether one triangle of the set
/// stays, and in which orientation. Sets with a common edge at which there are no other triangles are decided together,
/// as a group. A triangle of each stays if, along most of the boundary of the group, by length, the number of triangles
/// that are in no set is odd: a hole would remain without it. None stays where that number is even, as between two
/// boxes that were glued together. If a component of the mesh consists of such sets alone, one of each stays.
class OppositeSets {
 public:
  /// `is_dropped`: per face, whether it has been dropped. All arguments must outlive this.
  OppositeSets(const TriangleMesh& mesh, const DuplicateSets& sets, const IdVector<FaceId, bool>& is_dropped);

  /// Per set: the triangle that stays, oriented like its neighbours; invalid if none is needed. Call once.
  IdVector<DuplicateSetId, FaceId> kept();

 private:
  struct Neighbour {
    DuplicateSetId set;
    bool same_direction;  // of the first triangles of both sets, along their common edge
  };
  /// The other triangles at an edge of a set.
  struct EdgeSurroundings {
    std::vector<HalfedgeId> single;               // of triangles outside of all sets
    std::map<DuplicateSetId, HalfedgeId> others;  // other sets, each by its first triangle
  };

  EdgeSurroundings surroundings(DuplicateSetId set, HalfedgeId edge) const;
  void look_at(DuplicateSetId set, HalfedgeId edge);
  IdVector<DuplicateSetId, bool> are_needed();
  void spread_orientation(DuplicateSetId from);
  FaceId choose(DuplicateSetId set) const;

  const TriangleMesh& mesh_;
  const DuplicateSets& sets_;
  const IdVector<FaceId, bool>& is_dropped_;
  IdVector<FaceId, DuplicateSetId> set_of_;
  DisjointIds<DuplicateSetId> groups_;
  IdVector<DuplicateSetId, double> votes_;  // length of edges that need the set, less that of others
  IdVector<DuplicateSetId, std::vector<Neighbour>> neighbours_;
  IdVector<DuplicateSetId, std::optional<bool>>
      is_flipped_;  // whether its first triangle is oriented wrongly, if known
};

}  // namespace algebra3d
