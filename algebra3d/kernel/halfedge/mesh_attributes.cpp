#include "algebra3d/kernel/halfedge/mesh_attributes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <unordered_map>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "base/indices.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// Undefined comes first.
std::strong_ordering compare_numbers(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(b) <=> std::isnan(a);
  return a < b ? std::strong_ordering::less : a > b ? std::strong_ordering::greater : std::strong_ordering::equal;
}

void mix(std::size_t& hash, std::size_t value) {
  hash ^= value + 0x9E3779B97F4A7C15U + (hash << 6U) + (hash >> 2U);
}

bool is_before(const MeshAttribute& attribute, MeshElement element, std::string_view name) {
  return attribute.element != element ? attribute.element < element : std::string_view(attribute.name) < name;
}

}  // namespace

std::string_view name_of(MeshElement element) {
  constexpr std::array<std::string_view, 4> kNames{"vertex", "edge", "halfedge", "face"};
  return kNames[static_cast<std::size_t>(element)];
}

std::optional<MeshElement> mesh_element_named(std::string_view name) {
  for (const MeshElement element : kMeshElements)
    if (name_of(element) == name) return element;
  return std::nullopt;
}

std::size_t element_count(const PolygonMesh& mesh, MeshElement element) {
  switch (element) {
    case MeshElement::vertex:
      return mesh.vertex_count();
    case MeshElement::edge:
      return edge_count(mesh);
    case MeshElement::halfedge:
      return mesh.halfedge_count();
    case MeshElement::face:
      return mesh.face_count();
  }
  return 0;
}

std::string_view name_of(AttributeKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"real", "pair", "vector", "text"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::size_t width_of(AttributeKind kind) {
  constexpr std::array<std::size_t, 4> kWidths{1, 2, 3, 0};
  return kWidths[static_cast<std::size_t>(kind)];
}

AttributeValues::AttributeValues(AttributeKind kind, std::size_t count)
    : kind_(kind),
      width_(width_of(kind)),
      numbers_(count * width_, kUndefined),
      numbers_of_texts_(kind == AttributeKind::text ? count : 0, kNone) {}

bool AttributeValues::is_defined(std::size_t i) const {
  if (kind_ == AttributeKind::text) return numbers_of_texts_[i] != kNone;
  return !std::isnan(numbers_[i * width_]);
}

bool AttributeValues::are_equal(std::size_t i, std::size_t j) const {
  if (kind_ == AttributeKind::text) return numbers_of_texts_[i] == numbers_of_texts_[j];
  if (!is_defined(i) || !is_defined(j)) return is_defined(i) == is_defined(j);
  return std::ranges::equal(numbers(i), numbers(j));
}

void AttributeValues::set(std::size_t i, std::span<const double> numbers) {
  assert(kind_ != AttributeKind::text && numbers.size() == width_);
  if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) return clear(i);
  for (std::size_t k = 0; k < width_; ++k) numbers_[i * width_ + k] = numbers[k] + 0.0;
}

std::uint32_t AttributeValues::add_text(std::string text) {
  texts_.push_back(std::move(text));
  return static_cast<std::uint32_t>(texts_.size() - 1);
}

void AttributeValues::set_text(std::size_t i, std::uint32_t text) {
  assert(kind_ == AttributeKind::text && text < texts_.size());
  numbers_of_texts_[i] = text;
}

void AttributeValues::clear(std::size_t i) {
  if (kind_ == AttributeKind::text) numbers_of_texts_[i] = kNone;
  for (std::size_t k = 0; k < width_; ++k) numbers_[i * width_ + k] = kUndefined;
}

AttributeValues AttributeValues::selected(std::span<const std::uint32_t> sources) const {
  AttributeValues result(kind_, sources.size());
  result.texts_ = texts_;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i] == kNone) continue;
    if (kind_ == AttributeKind::text) result.numbers_of_texts_[i] = numbers_of_texts_[sources[i]];
    for (std::size_t k = 0; k < width_; ++k) result.numbers_[i * width_ + k] = numbers_[sources[i] * width_ + k];
  }
  return result;
}

AttributeValues AttributeValues::canonical() const {
  if (kind_ != AttributeKind::text) return *this;
  AttributeValues result(kind_, size());
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!is_defined(i)) continue;
    const auto [place, is_new] = numbers.try_emplace(text(i), static_cast<std::uint32_t>(result.texts_.size()));
    if (is_new) result.texts_.push_back(text(i));
    result.numbers_of_texts_[i] = place->second;
  }
  return result;
}

std::strong_ordering operator<=>(const AttributeValues& a, const AttributeValues& b) {
  if (const auto order = a.kind_ <=> b.kind_; std::is_neq(order)) return order;
  if (const auto order = a.size() <=> b.size(); std::is_neq(order)) return order;
  for (std::size_t i = 0; i < a.numbers_.size(); ++i)
    if (const auto order = compare_numbers(a.numbers_[i], b.numbers_[i]); std::is_neq(order)) return order;
  if (const auto order = a.texts_ <=> b.texts_; std::is_neq(order)) return order;
  for (std::size_t i = 0; i < a.numbers_of_texts_.size(); ++i)
    // Undefined, which has the greatest number, comes first.
    if (const auto order = a.numbers_of_texts_[i] + 1 <=> b.numbers_of_texts_[i] + 1; std::is_neq(order)) return order;
  return std::strong_ordering::equal;
}

std::size_t AttributeValues::hash() const {
  std::size_t result = size();
  for (const double number : numbers_) mix(result, std::isnan(number) ? 0 : std::hash<double>()(number));
  for (const std::string& text : texts_) mix(result, std::hash<std::string>()(text));
  for (const std::uint32_t number : numbers_of_texts_) mix(result, number);
  return result;
}

std::size_t AttributeValues::heap_bytes() const {
  std::size_t bytes = numbers_.capacity() * sizeof(double) + numbers_of_texts_.capacity() * sizeof(std::uint32_t);
  for (const std::string& text : texts_) bytes += sizeof(std::string) + text.capacity();
  return bytes;
}

std::span<const MeshAttribute> MeshAttributes::all() const {
  return list_ == nullptr ? std::span<const MeshAttribute>() : std::span<const MeshAttribute>(*list_);
}

bool MeshAttributes::has(MeshElement element) const {
  return std::ranges::any_of(all(), [&](const MeshAttribute& attribute) { return attribute.element == element; });
}

const MeshAttribute* MeshAttributes::find(MeshElement element, std::string_view name) const {
  for (const MeshAttribute& attribute : all())
    if (attribute.element == element && attribute.name == name) return &attribute;
  return nullptr;
}

MeshAttributes MeshAttributes::with(MeshElement element, std::string name, const AttributeValues& values) const {
  const MeshAttributes others = without(element, name);
  std::vector<MeshAttribute> list(others.all().begin(), others.all().end());
  const auto place =
      std::ranges::find_if_not(list, [&](const MeshAttribute& other) { return is_before(other, element, name); });
  list.insert(place, {element, std::move(name), std::make_shared<const AttributeValues>(values.canonical())});
  MeshAttributes result;
  result.list_ = std::make_shared<const std::vector<MeshAttribute>>(std::move(list));
  return result;
}

MeshAttributes MeshAttributes::without(MeshElement element, std::string_view name) const {
  if (find(element, name) == nullptr) return *this;
  std::vector<MeshAttribute> list;
  for (const MeshAttribute& attribute : all())
    if (attribute.element != element || attribute.name != name) list.push_back(attribute);
  MeshAttributes result;
  if (!list.empty()) result.list_ = std::make_shared<const std::vector<MeshAttribute>>(std::move(list));
  return result;
}

bool MeshAttributes::fits(const PolygonMesh& mesh) const {
  return std::ranges::all_of(all(), [&](const MeshAttribute& attribute) {
    return attribute.values->size() == element_count(mesh, attribute.element);
  });
}

std::strong_ordering operator<=>(const MeshAttributes& a, const MeshAttributes& b) {
  if (a.list_ == b.list_) return std::strong_ordering::equal;
  if (const auto order = a.all().size() <=> b.all().size(); std::is_neq(order)) return order;
  for (std::size_t i = 0; i < a.all().size(); ++i) {
    const MeshAttribute &p = a.all()[i], &q = b.all()[i];
    if (const auto order = p.element <=> q.element; std::is_neq(order)) return order;
    if (const auto order = p.name <=> q.name; std::is_neq(order)) return order;
    if (const auto order = *p.values <=> *q.values; std::is_neq(order)) return order;
  }
  return std::strong_ordering::equal;
}

std::size_t MeshAttributes::hash() const {
  std::size_t result = 0;
  for (const MeshAttribute& attribute : all()) {
    mix(result, static_cast<std::size_t>(attribute.element));
    mix(result, std::hash<std::string>()(attribute.name));
    mix(result, attribute.values->hash());
  }
  return result;
}

std::size_t MeshAttributes::heap_bytes() const {
  std::size_t bytes = 0;
  for (const MeshAttribute& attribute : all())
    bytes +=
        sizeof(MeshAttribute) + sizeof(AttributeValues) + attribute.name.capacity() + attribute.values->heap_bytes();
  return bytes;
}

MeshAttributes taken_over(const MeshAttributes& attributes, const ElementSources& sources) {
  const std::array<const std::vector<std::uint32_t>*, 4> of_element{&sources.vertices, &sources.edges,
                                                                    &sources.halfedges, &sources.faces};
  MeshAttributes result;
  for (const MeshAttribute& attribute : attributes.all())
    result = result.with(attribute.element, attribute.name,
                         attribute.values->selected(*of_element[static_cast<std::size_t>(attribute.element)]));
  return result;
}

std::vector<std::uint32_t> edge_numbers(const PolygonMesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.halfedge_count());
  std::uint32_t count = 0;
  for (const HalfedgeId h : edges(mesh)) {
    poll_interruption_at(h.index());
    if (mesh.is_nonmanifold(h))
      for (const HalfedgeId along : mesh.edge_halfedges(h)) numbers[along.index()] = count;
    if (const HalfedgeId opposite = mesh.opposite(h); opposite.is_valid()) numbers[opposite.index()] = count;
    numbers[h.index()] = count++;
  }
  return numbers;
}

std::vector<std::uint32_t> edge_sources(const PolygonMesh& mesh, const PolygonMesh& source,
                                        std::span<const std::uint32_t> halfedges_along) {
  const std::vector<std::uint32_t> numbers = edge_numbers(mesh), source_numbers = edge_numbers(source);
  std::vector<std::uint32_t> sources(edge_count(mesh), kNone);
  for (std::size_t h = 0; h < halfedges_along.size(); ++h)
    if (halfedges_along[h] != kNone) sources[numbers[h]] = source_numbers[halfedges_along[h]];
  return sources;
}

}  // namespace algebra3d
