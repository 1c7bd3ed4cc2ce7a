#include "algebra3d/kernel/subdivision/subdivided.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/subdivision/detail/attributes.h"
#include "algebra3d/kernel/subdivision/detail/input.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<PolygonMesh> step(const PolygonMesh& mesh, SubdivisionScheme scheme, const SubdivisionOptions& options,
                         const Monitor& monitor, const std::string& what) {
  switch (scheme) {
    case SubdivisionScheme::catmull_clark:
      return subdivision::catmull_clark_step(mesh, monitor, what);
    case SubdivisionScheme::doo_sabin:
      return subdivision::doo_sabin_step(mesh, monitor, what);
    case SubdivisionScheme::loop:
      return subdivision::loop_step(mesh, options.loop_weights, monitor, what);
    case SubdivisionScheme::butterfly:
      return subdivision::butterfly_step(mesh, monitor, what);
    case SubdivisionScheme::modified_butterfly:
      return subdivision::modified_butterfly_step(mesh, monitor, what);
  }
  return Error{ErrorCode::internal, "unknown subdivision scheme"};
}

/// The error limit_exceeded if the result certainly needs more memory than is left. check_input has found its number of
/// half-edges to be possible.
Status check_memory(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps) {
  constexpr std::uint64_t kLeastBytes = 16;  // of a half-edge of the result: its arrays and its part of a vertex
  if (scheme == SubdivisionScheme::doo_sabin) return {};  // which has fewer where there is a boundary
  const std::uint64_t halfedges = std::uint64_t{mesh.halfedge_count()} << (2 * steps);
  return require_memory(
      halfedges * kLeastBytes,
      fmt::format("{} half-edges after {} steps, each of which makes four of one,", halfedges, steps));
}

}  // namespace

Result<SubdividedMesh> subdivided(const PolygonMesh& mesh, const MeshAttributes& attributes, SubdivisionScheme scheme,
                                  std::size_t steps, const SubdivisionOptions& options, const Monitor& monitor) {
  if (steps == 0 || mesh.is_empty()) return SubdividedMesh{mesh, attributes};
  A3D_TRY(subdivision::check_input(mesh, scheme, steps));
  A3D_TRY(check_memory(mesh, scheme, steps));
  // Steps read rounded coordinates, so a mesh of others is taken as it is.
  std::optional<PolygonMesh> current;
  MeshAttributes current_attributes = attributes;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::string what = fmt::format("subdividing, step {} of {}", i + 1, steps);
    const PolygonMesh& before = current ? *current : mesh;
    A3D_ASSIGN(PolygonMesh after, step(before, scheme, options, monitor, what));
    current_attributes = subdivision::attributes_after_step(current_attributes, before, after, scheme);
    current = std::move(after);
  }
  return SubdividedMesh{*std::move(current), std::move(current_attributes)};
}

Result<PolygonMesh> subdivided(const PolygonMesh& mesh, SubdivisionScheme scheme, std::size_t steps,
                               const SubdivisionOptions& options, const Monitor& monitor) {
  A3D_ASSIGN(SubdividedMesh result, subdivided(mesh, {}, scheme, steps, options, monitor));
  return std::move(result.mesh);
}

}  // namespace algebra3d
