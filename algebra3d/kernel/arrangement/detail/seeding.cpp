#include "algebra3d/kernel/arrangement/detail/seeding.h"

#include <algorithm>
#include <functional>

#include "algebra3d/kernel/arrangement/detail/seed_from_above.h"
#include "algebra3d/kernel/arrangement/detail/seed_from_faces.h"
#include "base/propagate.h"

namespace algebra3d::arrangement {
namespace {

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
    A3D_ASSIGN(known, link_upwards(subdivision, linked, location, monitor));
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
