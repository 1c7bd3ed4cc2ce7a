#include "algebra3d/kernel/subdivision/detail/butterfly_rules.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"

namespace algebra3d::subdivision {

Result<PolygonMesh> butterfly_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what) {
  const TriangleView view(mesh);
  return split_triangles(
      mesh, monitor, what, [&](std::uint32_t h, std::uint32_t) { return butterfly_edge_point(view, h); },
      [&](std::uint32_t v) { return view.point(v); });
}

}  // namespace algebra3d::subdivision
