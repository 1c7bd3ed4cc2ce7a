#include "algebra3d/kernel/halfedge/attribute_transfer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/indices.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

using Term = ValueBlends::Term;

/// Sets value `i` to the mean of others. Equal values have themselves as their mean, without rounding.
void set_mean(AttributeValues& values, std::size_t i, std::span<const Term> terms) {
  const std::uint32_t first = terms.front().value;
  for (const Term& term : terms)
    if (!values.is_defined(term.value)) return;
  const bool are_equal = std::ranges::all_of(terms, [&](const Term& t) { return values.are_equal(t.value, first); });
  if (values.kind() == AttributeKind::text) {
    if (are_equal) values.set_text(i, values.numbers_of_texts()[first]);
    return;
  }
  std::array<double, 3> mean{};
  double weight = 0;
  for (const Term& term : terms) weight += term.weight;
  for (std::size_t k = 0; k < width_of(values.kind()); ++k) {
    for (const Term& term : terms) mean[k] += term.weight * values.numbers(term.value)[k];
    mean[k] = are_equal ? values.numbers(first)[k] : mean[k] / weight;
  }
  values.set(i, std::span(mean).first(width_of(values.kind())));
}

/// Per face its chart: the lowest face that is connected with it across edges on both sides of which the values agree.
std::vector<std::uint32_t> charts_of(const PolygonMesh& mesh, const AttributeValues& values) {
  const auto continues = [&](HalfedgeId h, HalfedgeId opposite) {
    return values.are_equal(h.index(), mesh.next(opposite).index()) &&
           values.are_equal(mesh.next(h).index(), opposite.index());
  };
  std::vector<std::uint32_t> charts(mesh.face_count(), kNone);
  std::vector<FaceId> open;
  for (const FaceId start : faces(mesh)) {
    poll_interruption_at(start.index());
    if (charts[start.index()] != kNone) continue;
    charts[start.index()] = start.index();
    open.push_back(start);
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (const HalfedgeId h : halfedges_of(mesh, f)) {
        const HalfedgeId opposite = mesh.opposite(h);
        if (!opposite.is_valid() || charts[mesh.face(opposite).index()] != kNone || !continues(h, opposite)) continue;
        charts[mesh.face(opposite).index()] = start.index();
        open.push_back(mesh.face(opposite));
      }
    }
  }
  return charts;
}

/// A corner of the result that was at another vertex of the source.
struct MovedCorner {
  std::size_t corner;
  VertexId vertex;  ///< of the source, where it is now
};

std::vector<MovedCorner> moved_corners(const PolygonMesh& source, const PolygonMesh& result,
                                       const ElementSources& sources) {
  std::vector<MovedCorner> moved;
  for (const HalfedgeId h : halfedges(result)) {
    const std::uint32_t corner = sources.halfedges[h.index()];
    const std::uint32_t vertex = sources.vertices[result.origin(h).index()];
    if (corner >= source.halfedge_count() || vertex >= source.vertex_count()) continue;  // new ones and blends
    if (source.origin(HalfedgeId(corner)) != VertexId(vertex)) moved.push_back({h.index(), VertexId(vertex)});
  }
  return moved;
}

/// Gives moved corners the corners of their vertices in the same chart.
void settle_corners(const PolygonMesh& source, const AttributeValues& values, std::span<const MovedCorner> moved,
                    std::vector<std::uint32_t>& corners) {
  const std::vector<std::uint32_t> charts = charts_of(source, values);
  const auto chart = [&](HalfedgeId h) { return charts[source.face(h).index()]; };
  for (const MovedCorner& place : moved) {
    std::uint32_t best = kNone;
    for (const HalfedgeId h : outgoing_halfedges(source, place.vertex))
      if (chart(h) == chart(HalfedgeId(corners[place.corner]))) best = std::min(best, h.index());
    if (best != kNone) corners[place.corner] = best;
  }
}

const std::vector<std::uint32_t>& of_element(const ElementSources& sources, MeshElement element) {
  const std::array<const std::vector<std::uint32_t>*, 4> all{&sources.vertices, &sources.edges, &sources.halfedges,
                                                             &sources.faces};
  return *all[static_cast<std::size_t>(element)];
}

const ValueBlends& of_element(const ElementBlends& blends, MeshElement element) {
  const std::array<const ValueBlends*, 4> all{&blends.vertices, &blends.edges, &blends.halfedges, &blends.faces};
  return *all[static_cast<std::size_t>(element)];
}

AttributeValues values_of(const AttributeValues& values, std::span<const std::uint32_t> sources,
                          const ValueBlends& blends) {
  return blends.size() == 0 ? values.selected(sources) : blends.appended_to(values).selected(sources);
}

}  // namespace

std::uint32_t ValueBlends::add(std::span<const Term> terms) {
  assert(!terms.empty());
  if (std::ranges::any_of(terms, [](const Term& term) { return term.value == kNone; })) return kNone;
  terms_.insert(terms_.end(), terms.begin(), terms.end());
  starts_.push_back(terms_.size());
  return static_cast<std::uint32_t>(value_count_ + size() - 1);
}

std::uint32_t ValueBlends::add_between(std::uint32_t first, std::uint32_t second, double share) {
  if (share <= 0 || first == second) return first;
  if (share >= 1) return second;
  return add(std::array{Term{first, 1 - share}, Term{second, share}});
}

AttributeValues ValueBlends::appended_to(const AttributeValues& values) const {
  assert(values.size() == value_count_);
  std::vector<std::uint32_t> sources(value_count_ + size(), kNone);
  std::iota(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(value_count_), 0U);
  AttributeValues result = values.selected(sources);
  for (std::size_t i = 0; i < size(); ++i)
    set_mean(result, value_count_ + i, std::span(terms_).subspan(starts_[i], starts_[i + 1] - starts_[i]));
  return result;
}

ElementBlends::ElementBlends(const PolygonMesh& mesh)
    : vertices(mesh.vertex_count()),
      edges(element_count(mesh, MeshElement::edge)),
      halfedges(mesh.halfedge_count()),
      faces(mesh.face_count()) {}

MeshAttributes taken_over(const MeshAttributes& attributes, const ElementSources& sources,
                          const ElementBlends& blends) {
  MeshAttributes result;
  for (const MeshAttribute& attribute : attributes.all())
    result = result.with(
        attribute.element, attribute.name,
        values_of(*attribute.values, of_element(sources, attribute.element), of_element(blends, attribute.element)));
  return result;
}

MeshAttributes taken_over_merged(const MeshAttributes& attributes, const PolygonMesh& source, const PolygonMesh& result,
                                 ElementSources sources, const ElementBlends& blends) {
  const std::vector<std::uint32_t> own_corners = sources.halfedges;
  std::vector<MovedCorner> moved;
  if (attributes.has(MeshElement::halfedge)) moved = moved_corners(source, result, sources);
  MeshAttributes all;
  for (const MeshAttribute& attribute : attributes.all()) {
    if (attribute.element == MeshElement::halfedge && !moved.empty()) {
      sources.halfedges = own_corners;
      settle_corners(source, *attribute.values, moved, sources.halfedges);
    }
    all = all.with(
        attribute.element, attribute.name,
        values_of(*attribute.values, of_element(sources, attribute.element), of_element(blends, attribute.element)));
  }
  return all;
}

}  // namespace algebra3d
