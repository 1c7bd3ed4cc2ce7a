#include "algebra3d/kernel/subdivision/detail/creases.h"

#include <cmath>
#include <string>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// The values of an attribute, 0 where they are undefined; empty without the attribute, or if all are 0.
Result<std::vector<double>> sharpness_values(const MeshAttributes& attributes, MeshElement element, const char* name) {
  const MeshAttribute* attribute = attributes.find(element, name);
  if (attribute == nullptr) return std::vector<double>();
  const AttributeValues& values = *attribute->values;
  if (values.kind() != AttributeKind::real)
    return Error{ErrorCode::invalid_value,
                 "the {} attribute {} is the sharpness of creases, expected kind real, got {}", name_of(element), name,
                 name_of(values.kind())};
  std::vector<double> result(values.size(), 0);
  bool is_sharp = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    poll_interruption_at(i);
    if (!values.is_defined(i)) continue;
    result[i] = values.numbers(i).front();
    if (result[i] < 0)
      return Error{
          ErrorCode::invalid_value, "{} {} has {} {}, expected 0 or more", name_of(element), i, name, result[i]};
    is_sharp = is_sharp || result[i] > 0;
  }
  if (!is_sharp) result.clear();
  return result;
}

}  // namespace

bool is_sharpness(const MeshAttribute& attribute) {
  return (attribute.element == MeshElement::edge && attribute.name == kCreaseAttribute) ||
         (attribute.element == MeshElement::vertex && attribute.name == kCornerAttribute);
}

Result<std::optional<Sharpness>> sharpness_of(const PolygonMesh& mesh, const MeshAttributes& attributes) {
  A3D_ASSIGN(const std::vector<double> of_edges, sharpness_values(attributes, MeshElement::edge, kCreaseAttribute));
  A3D_ASSIGN(std::vector<double> of_vertices, sharpness_values(attributes, MeshElement::vertex, kCornerAttribute));
  if (of_edges.empty() && of_vertices.empty()) return std::optional<Sharpness>();
  Sharpness result{std::vector<double>(mesh.halfedge_count(), 0), std::move(of_vertices)};
  result.vertices.resize(mesh.vertex_count(), 0);
  std::size_t edge = 0;
  if (!of_edges.empty())
    for (const HalfedgeId h : edges(mesh)) {
      poll_interruption_at(h.index());
      const double sharpness = of_edges[edge++];
      result.edges[h.index()] = sharpness;
      if (const HalfedgeId o = mesh.opposite(h); o.is_valid()) result.edges[o.index()] = sharpness;
    }
  return std::optional(std::move(result));
}

std::size_t steps_to_settle(const Sharpness& sharpness) {
  double largest = 0;
  for (const auto* values : {&sharpness.edges, &sharpness.vertices})
    for (const double value : *values)
      if (value < kInfinitelySharp) largest = std::max(largest, value);
  return static_cast<std::size_t>(std::ceil(largest));
}

std::vector<double> dart_weights(std::size_t count, double diagonal, double constant) {
  // Elimination from x(2) to x(n): x(i) = factor(i) x(i + 1) + known(i).
  std::vector<double> weights(count, 0), factors(count, 0);
  double factor = 0, known = 0;
  for (std::size_t i = 1; i < count; ++i) {
    poll_interruption_at(i);
    known = (known + constant) / (diagonal - factor);
    factor = 1 / (diagonal - factor);
    factors[i] = factor;
    weights[i] = known;
  }
  for (std::size_t i = count - 1; i-- > 1;) weights[i] += factors[i] * weights[i + 1];
  weights[0] = (constant + weights[1] + weights[count - 1]) / (diagonal - 1);
  return weights;
}

}  // namespace algebra3d::subdivision
