#include "algebra3d/kernel/repair/detail/duplicate_triangles.h"

#include <algorithm>

#include "algebra3d/kernel/repair/detail/duplicate_sets.h"
#include "algebra3d/kernel/repair/detail/opposite_sets.h"

namespace algebra3d {
namespace {

using Flags = IdVector<FaceId, bool>;

void flag_all_but(FaceId kept, const DuplicateSet& set, Flags& is_dropped) {
  for (const FaceId triangle : set.triangles) is_dropped[triangle] = triangle != kept;
}

/// Of each set in which one orientation prevails, all are flagged but the first that has it.
void flag_unbalanced(const TriangleMesh& mesh, const DuplicateSets& sets, Flags& is_dropped) {
  for (const DuplicateSet& set : sets) {
    if (set.is_balanced()) continue;
    const auto prevails = [&](FaceId f) { return is_even(mesh.triangle(f)) == (set.balance > 0); };
    flag_all_but(*std::ranges::find_if(set.triangles, prevails), set, is_dropped);
  }
}

/// Flags all triangles of the balanced sets but those that the surface needs. Gives the first triangle of each set of
/// which none stays.
Flags flag_balanced(const TriangleMesh& mesh, const DuplicateSets& sets, Flags& is_dropped) {
  DuplicateSets balanced;
  for (const DuplicateSet& set : sets)
    if (set.is_balanced()) balanced.push_back(set);
  const IdVector<DuplicateSetId, FaceId> kept = OppositeSets(mesh, balanced, is_dropped).kept();
  Flags is_last(is_dropped.size());
  for (const DuplicateSetId set : balanced.ids()) {
    flag_all_but(kept[set], balanced[set], is_dropped);
    if (!kept[set].is_valid()) is_last[balanced[set].triangles.front()] = true;
  }
  return is_last;
}

RepairStep step_of(bool is_last) {
  return is_last ? RepairStep::opposite_triangles : RepairStep::duplicate_triangles;
}

}  // namespace

bool has_duplicate_triangles(const TriangleMesh& mesh) {
  return !duplicate_sets(mesh).empty();
}

void drop_opposite_triangles(IndexedSoup& soup, RepairReport& report) {
  const auto mesh = soup.mesh();
  Flags is_dropped(soup.triangles.size());
  for (const DuplicateSet& set : duplicate_sets(*mesh)) {
    if (!set.is_balanced()) continue;
    for (const FaceId triangle : set.triangles) {
      is_dropped[triangle] = true;
      report.add(step_of(triangle == set.triangles.front()), soup.middle(triangle));
    }
  }
  soup.drop(is_dropped);
}

void drop_duplicate_triangles(IndexedSoup& soup, RepairReport& report) {
  const auto mesh = soup.mesh();
  const DuplicateSets sets = duplicate_sets(*mesh);
  if (sets.empty()) return;
  Flags is_dropped(soup.triangles.size());
  flag_unbalanced(*mesh, sets, is_dropped);
  const Flags is_last = flag_balanced(*mesh, sets, is_dropped);
  for (const FaceId triangle : is_dropped.ids())
    if (is_dropped[triangle]) report.add(step_of(is_last[triangle]), soup.middle(triangle));
  soup.drop(is_dropped);
}

}  // namespace algebra3d
