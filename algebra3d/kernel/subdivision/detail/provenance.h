#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/subdivision/detail/blocks.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {

// Parts of the provenance of attributes that several schemes have in common. Cost: linear.

/// The vertices of the mesh, then the middles of the edges.
ValueSources vertices_and_middles(const PolygonMesh& mesh, ValueBlends& blends);
/// Per half-edge the middle of its corner and the next one.
ValueSources corner_middles(const PolygonMesh& mesh, ValueBlends& blends);
/// The mean of the vertices of a face, or of its corners.
std::uint32_t mean_of_vertices(const PolygonMesh& mesh, FaceId f, ValueBlends& blends);
std::uint32_t mean_of_corners(const PolygonMesh& mesh, FaceId f, ValueBlends& blends);

/// Calls limit(v) for the wanted vertices that are not isolated, in parallel.
template <typename View, typename Limit>
Result<std::vector<Vec3>> limits_of_vertices(const LimitInput& input, const View& view, const Limit& limit) {
  const Stage stage(input.monitor, "finding limits", block_count(input.count));
  std::vector<Vec3> limits(input.count);
  for_each_element<VertexId>(input.count, stage, [&](VertexId v) {
    if (view.outgoing(v).is_valid()) limits[v.index()] = limit(v);
  });
  A3D_TRY(input.monitor.check());
  return limits;
}

}  // namespace algebra3d::subdivision
