#include "algebra3d/kernel/subdivision/detail/butterfly_rules.h"

namespace algebra3d::subdivision {
namespace {

Result<PolygonMesh> butterfly_step(const StepInput& input) {
  const TriangleView view(input.mesh);
  return split_triangles(
      input, [&](HalfedgeId h, EdgeNumber) { return butterfly_edge_point(view, h); },
      [&](VertexId v) { return view.point(v); });
}

}  // namespace

constinit const SchemeDescription kButterfly = {.name = "butterfly",
                                                .takes_triangles_only = true,
                                                .needs_three_edges = true,
                                                .after_step = four_times,
                                                .step = butterfly_step,
                                                .provenance = triangle_split_provenance};

}  // namespace algebra3d::subdivision
