#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/indices.h"

namespace algebra3d::subdivision {

struct Sharpness;  // creases.h

/// The input of a step.
struct StepInput {
  const PolygonMesh& mesh;     ///< check_input accepts it; of its coordinates the doubles are read
  std::size_t number;          ///< of the step, from 0
  std::size_t variant;         ///< of the scheme's variants
  const Sharpness* sharpness;  ///< null: all edges and vertices are smooth
  const Monitor& monitor;
  const std::string& what;  ///< the name of the step for people
};

/// The input for limits of vertices.
struct LimitInput {
  const PolygonMesh& mesh;  ///< after the steps that the scheme makes first
  std::size_t count;        ///< limits are wanted for that many vertices, the first
  std::size_t variant;
  const Sharpness* sharpness;  ///< null, or 0 or infinite everywhere
  const Monitor& monitor;
};

struct MeshSize {
  std::uint64_t halfedges, boundary_halfedges;
  bool is_exact = true;  ///< false: no more than that
};

/// Per element of the mesh after a step the value that it has, or kNone.
using ValueSources = std::vector<std::uint32_t>;

/// Where the elements of the mesh after a step have their values from; blends are numbered after the values of the mesh
/// before. Vertices: for texts only, since numbers follow the points.
struct Provenance {
  ElementSources sources;
  ElementBlends blends;
};

/// A scheme, as one file describes it.
struct SchemeDescription {
  std::string_view name;
  bool takes_triangles_only = false;
  /// Refuses interior vertices with two edges, where two edges of the result would join the same vertices.
  bool needs_three_edges = false;
  /// Refuses faces that meet themselves in an edge, for the same reason.
  bool needs_distinct_sides = false;
  /// Steps read the sharpness of edges and vertices.
  bool honours_creases = false;
  /// The property in which the variants differ, such as "weights", and their names, the first being the default.
  std::string_view variants_are = {};
  std::span<const std::string_view> variants = {};

  /// The size of the result of a step. Whether it depends on the boundary of the mesh.
  MeshSize (*after_step)(const MeshSize&, std::size_t variant);
  bool grows_at_boundary = false;
  /// One step. Error: interrupted.
  Result<PolygonMesh> (*step)(const StepInput& input);

  /// The provenance of those kinds of elements that have attributes in `given`.
  Provenance (*provenance)(const StepInput& input, const PolygonMesh& after, const MeshAttributes& given);
  /// The numbers at the corners of the mesh after the step from those at the corners before, by the weights of the
  /// scheme. Null: by the provenance.
  std::vector<Vec3> (*corner_values)(const StepInput& input, const PolygonMesh& after,
                                     const std::vector<Vec3>& values) = nullptr;

  /// The limits of vertices that are not isolated; isolated ones have any values. Null: not known. Errors:
  /// invalid_value for a vertex without a limit; interrupted. Steps to be made first.
  Result<std::vector<Vec3>> (*limits)(const LimitInput& input) = nullptr;
  std::size_t steps_before_limits = 0;
};

extern const SchemeDescription kCatmullClark, kDooSabin, kLoop, kButterfly, kModifiedButterfly, kSqrt3;

/// Four half-edges for one; a half of each boundary edge.
inline MeshSize four_times(const MeshSize& size, std::size_t /*variant*/) {
  return {4 * size.halfedges, 2 * size.boundary_halfedges};
}

}  // namespace algebra3d::subdivision
