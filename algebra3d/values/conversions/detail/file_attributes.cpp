#include "algebra3d/values/conversions/detail/file_attributes.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/values/types/utf8.h"
#include "base/indices.h"

namespace algebra3d {
namespace {

MeshAttributes with_names(MeshAttributes attributes, const char* name, const SoupAttributes::FaceNames& given) {
  if (given.of_face.empty()) return attributes;
  AttributeValues values(AttributeKind::text, given.of_face.size());
  for (const std::string& text : given.names) values.add_text(shown_as_text(text));
  for (std::size_t f = 0; f < given.of_face.size(); ++f)
    if (given.of_face[f] != kNone) values.set_text(f, given.of_face[f]);
  return attributes.with(MeshElement::face, name, values);
}

/// Per corner the numbers of `elements` that it has.
template <typename Element, typename Numbers>
AttributeValues corner_values(AttributeKind kind, const std::vector<std::uint32_t>& corners,
                              const std::vector<Element>& elements, Numbers numbers_of) {
  AttributeValues values(kind, corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i] != kNone) values.set(i, numbers_of(elements[corners[i]]));
  return values;
}

/// The attribute of a file that a mesh has, if it has the kind.
const AttributeValues* find_values(const MeshAttributes& attributes, MeshElement element, const char* name,
                                   AttributeKind kind) {
  const MeshAttribute* const found = attributes.find(element, name);
  return found != nullptr && found->values->kind() == kind ? found->values.get() : nullptr;
}

/// Numbers of the different values, which `table` then has.
std::vector<std::uint32_t> numbered(const AttributeValues& values, PointTable& table) {
  std::vector<std::uint32_t> numbers(values.size(), kNone);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values.is_defined(i)) continue;
    const std::span<const double> v = values.numbers(i);
    numbers[i] = table.intern(PointRef(Vec3{v[0], v[1], v.size() > 2 ? v[2] : 0}));
  }
  return numbers;
}

SoupAttributes::FaceNames names_of(const AttributeValues& values) {
  return {values.texts(), values.numbers_of_texts()};
}

}  // namespace

MeshAttributes attributes_of_file(const SoupAttributes& given) {
  MeshAttributes attributes;
  if (!given.corner_textures.empty())
    attributes = attributes.with(MeshElement::halfedge, kTextureAttribute,
                                 corner_values(AttributeKind::pair, given.corner_textures, given.textures,
                                               [](const SoupAttributes::TextureCoordinate& texture) {
                                                 return std::span<const double>(texture);
                                               }));
  std::array<double, 3> vector{};
  if (!given.corner_normals.empty())
    attributes = attributes.with(
        MeshElement::halfedge, kNormalAttribute,
        corner_values(AttributeKind::vector, given.corner_normals, given.normals, [&](const Vec3& normal) {
          vector = {normal.x, normal.y, normal.z};
          return std::span<const double>(vector);
        }));
  attributes = with_names(std::move(attributes), kGroupAttribute, given.groups);
  attributes = with_names(std::move(attributes), kObjectAttribute, given.objects);
  return with_names(std::move(attributes), kMaterialAttribute, given.materials);
}

FileAttributes attributes_for_file(const MeshAttributes& attributes) {
  FileAttributes result;
  std::size_t written = 0;
  if (const auto* const textures =
          find_values(attributes, MeshElement::halfedge, kTextureAttribute, AttributeKind::pair)) {
    PointTable table;
    result.attributes.corner_textures = numbered(*textures, table);
    for (const Vec3& texture : std::move(table).take_doubles())
      result.attributes.textures.push_back({texture.x, texture.y});
    ++written;
  }
  if (const auto* const normals =
          find_values(attributes, MeshElement::halfedge, kNormalAttribute, AttributeKind::vector)) {
    PointTable table;
    result.attributes.corner_normals = numbered(*normals, table);
    result.attributes.normals = std::move(table).take_doubles();
    ++written;
  }
  const std::array<std::pair<const char*, SoupAttributes::FaceNames*>, 3> names{
      {{kGroupAttribute, &result.attributes.groups},
       {kObjectAttribute, &result.attributes.objects},
       {kMaterialAttribute, &result.attributes.materials}}};
  for (const auto& [name, target] : names)
    if (const auto* const texts = find_values(attributes, MeshElement::face, name, AttributeKind::text)) {
      *target = names_of(*texts);
      ++written;
    }
  result.left_out = attributes.all().size() - written;
  return result;
}

}  // namespace algebra3d
