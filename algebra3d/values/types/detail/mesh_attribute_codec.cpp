#include "algebra3d/values/types/detail/mesh_attribute_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/utf8.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

NestedList value_to_nested(const AttributeValues& values, std::size_t i) {
  if (!values.is_defined(i)) return NestedList::symbol("undefined");
  if (values.kind() == AttributeKind::text) return NestedList::text(values.text(i));
  const std::span<const double> numbers = values.numbers(i);
  if (numbers.size() == 1) return NestedList(numbers[0]);
  NestedList::List list;
  for (const double number : numbers) list.emplace_back(number);
  return NestedList(std::move(list));
}

/// Reads value `i`. Errors: invalid_value; `what` begins the message.
Status read_value(const NestedList& list, const std::string& what, AttributeValues& values, std::size_t i) {
  if (list.is_undefined()) return {};
  if (values.kind() == AttributeKind::text) {
    if (!list.is_text() && !list.is_string())
      return Error{ErrorCode::invalid_value, "{}: expected a text, got {}", what, list.print_short()};
    values.set_text(i, values.add_text(list.is_text() ? list.as_text() : list.as_string()));
    return {};
  }
  const std::size_t width = width_of(values.kind());
  std::array<double, 3> numbers{};
  if (width > 1 && (!list.is_list() || list.elements().size() != width))
    return Error{ErrorCode::invalid_value, "{}: expected {} numbers, got {}", what, width, list.print_short()};
  for (std::size_t k = 0; k < width; ++k) {
    A3D_ASSIGN(numbers[k], double_from_nested(width == 1 ? list : list.elements()[k], what));
  }
  values.set(i, std::span(numbers).first(width));
  return {};
}

std::optional<AttributeKind> kind_of(const NestedList& list) {
  for (const AttributeKind kind : kAttributeKinds)
    if (list.is_symbol(name_of(kind))) return kind;
  return std::nullopt;
}

Result<MeshAttributes> with_nested(const NestedList& list, const PolygonMesh& mesh, const MeshAttributes& others) {
  const std::string what = fmt::format("mesh3d: attribute {}", others.all().size());
  const NestedList::List none;
  const NestedList::List& parts = list.is_list() ? list.elements() : none;
  const bool is_attribute = parts.size() == 4 && parts[0].is_symbol() && parts[1].is_string() && parts[3].is_list();
  const auto element = is_attribute ? mesh_element_named(parts[0].as_symbol()) : std::nullopt;
  const auto kind = is_attribute ? kind_of(parts[2]) : std::nullopt;
  if (!element || !kind)
    return Error{ErrorCode::invalid_value,
                 "{}: expected (element \"name\" kind (values)) with the element vertex, edge, halfedge or face and "
                 "the kind real, pair, vector or text, got {}",
                 what, list.print_short()};
  const std::string& name = parts[1].as_string();
  if (others.find(*element, name) != nullptr)
    return Error{ErrorCode::invalid_value, "{}: a second attribute \"{}\" of the same elements", what, name};
  const NestedList::List& given = parts[3].elements();
  AttributeValues values(*kind, element_count(mesh, *element));
  if (given.size() != values.size())
    return Error{ErrorCode::invalid_value,
                 "{}: expected {} values, one for each {}, got {}",
                 what,
                 values.size(),
                 name_of(*element),
                 given.size()};
  for (std::size_t i = 0; i < given.size(); ++i)
    A3D_TRY(read_value(given[i], fmt::format("{}: value {}", what, i), values, i));
  return others.with(*element, name, values);
}

void write_values(ByteWriter& writer, const AttributeValues& values) {
  if (values.kind() != AttributeKind::text) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      writer.u8(values.is_defined(i) ? 1 : 0);
      if (!values.is_defined(i)) continue;
      for (const double number : values.numbers(i)) writer.f64(number);
    }
    return;
  }
  // Texts in order of first use; an element has the number of its text from 1, or 0.
  std::vector<std::uint64_t> numbers;
  numbers.reserve(values.size());
  for (const std::uint32_t number : values.numbers_of_texts())
    numbers.push_back(number == kNone ? 0 : std::uint64_t{number} + 1);
  writer.varint(values.texts().size());
  for (const std::string& text : values.texts()) writer.text(text);
  writer.planes(numbers, 1);
}

void read_numbers(ByteReader& reader, AttributeValues& values) {
  const std::size_t width = width_of(values.kind());
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < values.size() && reader.ok(); ++i) {
    const std::uint8_t is_defined = reader.u8();
    reader.require(is_defined <= 1, "0 or 1 before a value");
    if (is_defined != 1) continue;
    for (std::size_t k = 0; k < width; ++k) numbers[k] = reader.f64();
    const auto value = std::span(numbers).first(width);
    reader.require(std::ranges::all_of(value, [](double x) { return std::isfinite(x); }), "finite numbers");
    values.set(i, value);
  }
}

void read_texts(ByteReader& reader, AttributeValues& values) {
  const std::size_t text_count = reader.count(1);
  for (std::size_t i = 0; i < text_count && reader.ok(); ++i) {
    const std::string_view text = reader.text();
    reader.require(first_no_text(text) == std::string_view::npos, "texts in UTF-8");
    values.add_text(std::string(text));
  }
  const std::vector<std::uint64_t> numbers = reader.planes(values.size(), 1, 4);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    reader.require(numbers[i] <= text_count, "numbers of texts");
    if (!reader.ok()) return;
    if (numbers[i] > 0) values.set_text(i, static_cast<std::uint32_t>(numbers[i] - 1));
  }
}

}  // namespace

NestedList attributes_to_nested(const MeshAttributes& attributes) {
  NestedList::List result;
  for (const MeshAttribute& attribute : attributes.all()) {
    NestedList::List values;
    values.reserve(attribute.values->size());
    for (std::size_t i = 0; i < attribute.values->size(); ++i) values.push_back(value_to_nested(*attribute.values, i));
    result.push_back(NestedList::list(
        NestedList::symbol(std::string(name_of(attribute.element))), NestedList(attribute.name),
        NestedList::symbol(std::string(name_of(attribute.values->kind()))), NestedList(std::move(values))));
  }
  return NestedList(std::move(result));
}

Result<MeshAttributes> attributes_from_nested(const NestedList& list, const PolygonMesh& mesh) {
  MeshAttributes attributes;
  for (const NestedList& attribute : list.elements()) {
    A3D_ASSIGN(attributes, with_nested(attribute, mesh, attributes));
  }
  return attributes;
}

void write_attributes(ByteWriter& writer, const MeshAttributes& attributes) {
  writer.varint(attributes.all().size());
  for (const MeshAttribute& attribute : attributes.all()) {
    writer.u8(static_cast<std::uint8_t>(attribute.element));
    writer.u8(static_cast<std::uint8_t>(attribute.values->kind()));
    writer.text(attribute.name);
    write_values(writer, *attribute.values);
  }
}

MeshAttributes read_attributes(ByteReader& reader, const PolygonMesh& mesh) {
  MeshAttributes attributes;
  const std::size_t count = reader.count(3);
  for (std::size_t n = 0; n < count && reader.ok(); ++n) {
    const std::uint8_t element = reader.u8(), kind = reader.u8();
    reader.require(element < kMeshElements.size() && kind < kAttributeKinds.size(), "a known kind of attributes");
    const std::string name(reader.text());
    reader.require(first_no_text(name) == std::string::npos, "names in UTF-8");
    if (!reader.ok()) return {};
    const std::size_t value_count = element_count(mesh, kMeshElements[element]);
    // Each value takes a byte at least, so that a wrong name cannot exhaust memory.
    reader.require(value_count <= reader.remaining(), "a value for each element");
    reader.require(attributes.find(kMeshElements[element], name) == nullptr, "another name");
    if (!reader.ok()) return {};
    AttributeValues values(kAttributeKinds[kind], value_count);
    if (kAttributeKinds[kind] == AttributeKind::text)
      read_texts(reader, values);
    else
      read_numbers(reader, values);
    attributes = attributes.with(kMeshElements[element], name, values);
  }
  return reader.ok() ? attributes : MeshAttributes();
}

}  // namespace algebra3d
