#include "algebra3d/kernel/repair/detail/triangle_orientation.h"

#include "algebra3d/kernel/repair/detail/oriented_patches.h"
#include "algebra3d/kernel/repair/detail/patch_balance.h"
#include "algebra3d/kernel/repair/detail/patch_links.h"

namespace algebra3d {

void orient_triangles(IndexedSoup& soup, RepairReport& report) {
  OrientedPatches patches(soup);
  flip_linked_patches(soup, patches);
  balance_patches(patches);
  for (const FaceId triangle : soup.triangles.ids()) {
    if (!patches.is_flipped()[triangle]) continue;
    soup.flip(triangle);
    report.add(RepairStep::flipped_triangles, soup.middle(triangle));
  }
}

}  // namespace algebra3d
