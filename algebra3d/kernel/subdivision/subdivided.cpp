#include "algebra3d/kernel/subdivision/subdivided.h"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/subdivision/detail/attributes.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "algebra3d/kernel/subdivision/detail/input.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using subdivision::SchemeDescription;
using subdivision::Sharpness;

Result<std::optional<Sharpness>> sharpness_for(const SchemeDescription& scheme, const PolygonMesh& mesh,
                                               const MeshAttributes& attributes) {
  if (!scheme.honours_creases || attributes.is_empty()) return std::optional<Sharpness>();
  return subdivision::sharpness_of(mesh, attributes);
}

}  // namespace

Result<SubdividedMesh> subdivided(const PolygonMesh& mesh, const MeshAttributes& attributes,
                                  const SubdivisionScheme& scheme, std::size_t steps, const SubdivisionOptions& options,
                                  const Monitor& monitor) {
  if (steps == 0 || mesh.is_empty()) return SubdividedMesh{mesh, attributes};
  const SchemeDescription& description = scheme.description();
  assert(options.variant == 0 || options.variant < description.variants.size());
  A3D_TRY(subdivision::check_input(mesh, description, steps, options.variant));
  // Steps read rounded coordinates, so a mesh of others is taken as it is.
  std::optional<PolygonMesh> current;
  MeshAttributes current_attributes = attributes;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::string what = fmt::format("subdividing, step {} of {}", i + 1, steps);
    const PolygonMesh& before = current ? *current : mesh;
    A3D_ASSIGN(const std::optional<Sharpness> sharpness, sharpness_for(description, before, current_attributes));
    const subdivision::StepInput input{before, i, options.variant, sharpness ? &*sharpness : nullptr, monitor, what};
    A3D_ASSIGN(PolygonMesh after, description.step(input));
    A3D_ASSIGN(current_attributes, subdivision::attributes_after_step(current_attributes, input, after, description));
    current = std::move(after);
  }
  return SubdividedMesh{*std::move(current), std::move(current_attributes)};
}

Result<PolygonMesh> subdivided(const PolygonMesh& mesh, const SubdivisionScheme& scheme, std::size_t steps,
                               const SubdivisionOptions& options, const Monitor& monitor) {
  A3D_ASSIGN(SubdividedMesh result, subdivided(mesh, {}, scheme, steps, options, monitor));
  return std::move(result.mesh);
}

}  // namespace algebra3d
