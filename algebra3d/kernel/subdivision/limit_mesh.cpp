#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/attributes.h"
#include "algebra3d/kernel/subdivision/detail/blocks.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "algebra3d/kernel/subdivision/detail/input.h"
#include "algebra3d/kernel/subdivision/detail/mesh_view.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/scheme_description.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using subdivision::SchemeDescription;

/// The facts of a mesh that its limits depend on, besides its points.
struct LimitRules {
  const SchemeDescription& scheme;
  std::size_t variant;
  MeshAttributes creases;  ///< those that give the sharpness
  std::size_t steps;       ///< to be made first
};

/// The limits of the vertices of a mesh. In the steps that are made first they keep their numbers.
Result<std::vector<Vec3>> limits_of(const PolygonMesh& mesh, const LimitRules& rules, const Monitor& monitor) {
  std::optional<PolygonMesh> refined;
  MeshAttributes creases = rules.creases;
  std::optional<subdivision::Sharpness> sharpness;
  for (std::size_t step = 0;; ++step) {
    const PolygonMesh& before = refined ? *refined : mesh;
    if (!creases.is_empty()) {
      A3D_ASSIGN(sharpness, subdivision::sharpness_of(before, creases));
    }
    const subdivision::Sharpness* of_step = sharpness ? &*sharpness : nullptr;
    if (step == rules.steps) return rules.scheme.limits({before, mesh.vertex_count(), rules.variant, of_step, monitor});
    const subdivision::StepInput input{before, step, rules.variant, of_step, monitor, "subdividing for limits"};
    A3D_ASSIGN(PolygonMesh after, rules.scheme.step(input));
    A3D_ASSIGN(creases, subdivision::attributes_after_step(creases, input, after, rules.scheme));
    refined = std::move(after);
  }
}

/// The mesh with its vertices moved, except isolated ones.
Result<PolygonMesh> moved_vertices(const PolygonMesh& mesh, const std::vector<Vec3>& limits, const Monitor& monitor) {
  using subdivision::block_count;
  using subdivision::for_each_element;
  const subdivision::MeshView<0> view(mesh);
  const Stage stage(monitor, "finding limits", block_count(mesh.vertex_count()) + block_count(mesh.halfedge_count()));
  subdivision::RefinedMesh moved(mesh.vertex_count(), 0);
  moved.corners = mesh.origins();
  moved.opposites.resize(mesh.halfedge_count());
  for_each_element<HalfedgeId>(mesh.halfedge_count(), stage,
                               [&](HalfedgeId h) { moved.set_opposite(h, view.opposite(h)); });
  for_each_element<VertexId>(mesh.vertex_count(), stage, [&](VertexId v) {
    const HalfedgeId leaving = view.outgoing(v);
    moved.set_vertex(v, leaving.is_valid() ? limits[v.index()] : view.point(v), leaving);
  });
  return std::move(moved).finish(mesh.layout(), monitor);
}

Result<LimitRules> limit_rules(const PolygonMesh& mesh, const MeshAttributes& attributes,
                               const SchemeDescription& scheme, std::size_t variant) {
  LimitRules rules{scheme, variant, {}, scheme.steps_before_limits};
  if (!scheme.honours_creases) return rules;
  A3D_ASSIGN(const auto sharpness, subdivision::sharpness_of(mesh, attributes));
  if (!sharpness) return rules;
  for (const MeshAttribute& attribute : attributes.all())
    if (subdivision::is_sharpness(attribute))
      rules.creases = rules.creases.with(attribute.element, attribute.name, *attribute.values);
  rules.steps = std::max(rules.steps, subdivision::steps_to_settle(*sharpness));
  return rules;
}

/// Numbers of vertices at the limit; isolated vertices keep theirs.
Result<AttributeValues> limit_values(const PolygonMesh& mesh, const AttributeValues& values, const LimitRules& rules,
                                     const Monitor& monitor) {
  std::vector<Vec3> points = subdivision::as_points(values);
  A3D_ASSIGN(std::vector<Vec3> limits, limits_of(PolygonMesh(mesh, PointArray(points)), rules, monitor));
  for (const VertexId v : vertices(mesh))
    if (mesh.is_isolated(v)) limits[v.index()] = points[v.index()];
  return subdivision::from_points(values.kind(), limits);
}

}  // namespace

Result<SubdividedMesh> limit_mesh(const PolygonMesh& mesh, const MeshAttributes& attributes,
                                  const SubdivisionScheme& scheme, const SubdivisionOptions& options,
                                  const Monitor& monitor) {
  const SchemeDescription& description = scheme.description();
  assert(description.limits != nullptr);
  A3D_ASSIGN(const LimitRules rules, limit_rules(mesh, attributes, description, options.variant));
  A3D_TRY(subdivision::check_input(mesh, description, std::max<std::size_t>(1, rules.steps), options.variant));
  A3D_ASSIGN(const std::vector<Vec3> limits, limits_of(mesh, rules, monitor));
  A3D_ASSIGN(PolygonMesh moved, moved_vertices(mesh, limits, monitor));
  MeshAttributes result = attributes;
  for (const MeshAttribute& attribute : attributes.all()) {
    if (!subdivision::follows_points(attribute)) continue;
    if (description.honours_creases && subdivision::is_sharpness(attribute)) continue;
    A3D_ASSIGN(const AttributeValues values, limit_values(mesh, *attribute.values, rules, monitor));
    result = result.with(attribute.element, attribute.name, values);
  }
  return SubdividedMesh{std::move(moved), std::move(result)};
}

Result<PolygonMesh> limit_mesh(const PolygonMesh& mesh, const SubdivisionScheme& scheme,
                               const SubdivisionOptions& options, const Monitor& monitor) {
  A3D_ASSIGN(SubdividedMesh result, limit_mesh(mesh, {}, scheme, options, monitor));
  return std::move(result.mesh);
}

}  // namespace algebra3d
