// Attributes after a step. Numbers of vertices are computed by the step itself, as if they were coordinates, so they
// have the same weights, and an attribute that equals the coordinates stays equal.
#include "algebra3d/kernel/subdivision/detail/attributes.h"

#include <array>
#include <limits>
#include <utility>

#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// The values of vertices after the step.
Result<AttributeValues> by_step(const MeshAttribute& attribute, const StepInput& input,
                                const SchemeDescription& scheme) {
  const PolygonMesh values(input.mesh, PointArray(as_points(*attribute.values)));
  A3D_ASSIGN(const PolygonMesh after, scheme.step({values, input.number, input.variant, input.sharpness, input.monitor,
                                                   input.what + ", attribute " + attribute.name}));
  return from_points(attribute.values->kind(), after.points().approx());
}

/// The sharpness of halves of edges, and of vertices that were there before; others have none.
AttributeValues sharpness_values(const MeshAttribute& attribute, const Provenance& provenance) {
  const AttributeValues& values = *attribute.values;
  const ElementSources& sources = provenance.sources;
  ValueSources kept = attribute.element == MeshElement::edge ? sources.edges : sources.vertices;
  for (auto& source : kept)
    if (source >= values.size()) source = kNone;
  AttributeValues result = values.selected(kept);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (result.is_defined(i)) result.set(i, std::array{sharpness_after_step(result.numbers(i).front())});
  return result;
}

}  // namespace

bool follows_points(const MeshAttribute& attribute) {
  return attribute.element == MeshElement::vertex && attribute.values->kind() != AttributeKind::text;
}

std::vector<Vec3> as_points(const AttributeValues& values) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::size_t width = width_of(values.kind());
  std::vector<Vec3> points(values.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    if (!values.is_defined(i)) {
      points[i] = {kNaN, kNaN, kNaN};
      continue;
    }
    const auto numbers = values.numbers(i);
    points[i] = {numbers[0], width > 1 ? numbers[1] : 0, width > 2 ? numbers[2] : 0};
  }
  return points;
}

AttributeValues from_points(AttributeKind kind, const std::vector<Vec3>& points) {
  AttributeValues values(kind, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    const std::array numbers{points[i].x, points[i].y, points[i].z};
    values.set(i, std::span(numbers).first(width_of(kind)));
  }
  return values;
}

Result<MeshAttributes> attributes_after_step(const MeshAttributes& given, const StepInput& input,
                                             const PolygonMesh& after, const SchemeDescription& scheme) {
  if (given.is_empty()) return given;
  const Provenance provenance = scheme.provenance(input, after, given);
  MeshAttributes by_provenance, result;
  std::vector<std::pair<const MeshAttribute*, AttributeValues>> computed;
  for (const MeshAttribute& attribute : given.all()) {
    if (scheme.honours_creases && is_sharpness(attribute)) {
      computed.emplace_back(&attribute, sharpness_values(attribute, provenance));
    } else if (follows_points(attribute)) {
      A3D_ASSIGN(AttributeValues values, by_step(attribute, input, scheme));
      computed.emplace_back(&attribute, std::move(values));
    } else if (attribute.element == MeshElement::halfedge && attribute.values->kind() != AttributeKind::text &&
               scheme.corner_values != nullptr) {
      const std::vector<Vec3> values = scheme.corner_values(input, after, as_points(*attribute.values));
      computed.emplace_back(&attribute, from_points(attribute.values->kind(), values));
    } else {
      by_provenance = by_provenance.with(attribute.element, attribute.name, *attribute.values);
    }
  }
  result = taken_over(by_provenance, provenance.sources, provenance.blends);
  for (const auto& [attribute, values] : computed) result = result.with(attribute->element, attribute->name, values);
  return result;
}

}  // namespace algebra3d::subdivision
