#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d {

/// The kinds of elements of a mesh. A half-edge keeps what belongs to the corner that it leaves.
enum class MeshElement : std::uint8_t { vertex, edge, halfedge, face };
inline constexpr std::array kMeshElements{MeshElement::vertex, MeshElement::edge, MeshElement::halfedge,
                                          MeshElement::face};
std::string_view name_of(MeshElement element);
/// "vertex", "edge", "halfedge" or "face"; nothing for other names.
std::optional<MeshElement> mesh_element_named(std::string_view name);
std::size_t element_count(const PolygonMesh& mesh, MeshElement element);

enum class AttributeKind : std::uint8_t { real, pair, vector, text };
inline constexpr std::array kAttributeKinds{AttributeKind::real, AttributeKind::pair, AttributeKind::vector,
                                            AttributeKind::text};
std::string_view name_of(AttributeKind kind);
/// How many numbers a value has; 0 for texts.
std::size_t width_of(AttributeKind kind);

/// One value per element: numbers or a text, or undefined. Numbers are finite, zeros are positive.
class AttributeValues {
 public:
  /// All undefined.
  AttributeValues(AttributeKind kind, std::size_t count);

  AttributeKind kind() const { return kind_; }
  std::size_t size() const {
    return kind_ == AttributeKind::text ? numbers_of_texts_.size() : numbers_.size() / width_;
  }
  bool is_defined(std::size_t i) const;
  /// Whether two values of canonical ones are the same, or both undefined.
  bool are_equal(std::size_t i, std::size_t j) const;
  /// The numbers of a defined value that is not a text.
  std::span<const double> numbers(std::size_t i) const { return std::span(numbers_).subspan(i * width_, width_); }
  /// The text of a defined value.
  const std::string& text(std::size_t i) const { return texts_[numbers_of_texts_[i]]; }

  /// The texts of a text attribute, and per element the number of its text, kNone for undefined.
  const std::vector<std::string>& texts() const { return texts_; }
  const std::vector<std::uint32_t>& numbers_of_texts() const { return numbers_of_texts_; }

  /// As many numbers as the kind has; if one is not finite, the value is undefined.
  void set(std::size_t i, std::span<const double> numbers);
  /// For `set_text`: the number of a text, which may be there already.
  std::uint32_t add_text(std::string text);
  void set_text(std::size_t i, std::uint32_t text);
  void clear(std::size_t i);

  /// The values of other elements: element i has the value of element sources[i], or is undefined for kNone.
  AttributeValues selected(std::span<const std::uint32_t> sources) const;
  /// The values with each text stored once, in order of first use, so that equal values are stored alike.
  AttributeValues canonical() const;

  /// A total order of canonical values; undefined comes first.
  friend std::strong_ordering operator<=>(const AttributeValues& a, const AttributeValues& b);
  friend bool operator==(const AttributeValues& a, const AttributeValues& b) { return std::is_eq(a <=> b); }
  std::size_t hash() const;
  std::size_t heap_bytes() const;

 private:
  AttributeKind kind_;
  std::size_t width_;
  std::vector<double> numbers_;  // NaN: undefined
  std::vector<std::string> texts_;
  std::vector<std::uint32_t> numbers_of_texts_;  // kNone: undefined
};

// Names of attributes that mesh files have: texture coordinates and normals of half-edges, that is, of corners, or of
// vertices; groups, objects and materials of faces; colours of vertices and faces, as red, green and blue from 0 to 1,
// with their opacities. Vectors of any elements with the name of normals turn with the mesh. And those that subdivision
// reads: the sharpness of edges and of vertices (subdivision/subdivided.h).
inline constexpr const char* kTextureAttribute = "TextureCoordinate";
inline constexpr const char* kNormalAttribute = "Normal";
inline constexpr const char* kColourAttribute = "Colour";
inline constexpr const char* kOpacityAttribute = "Opacity";
inline constexpr const char* kGroupAttribute = "Group";
inline constexpr const char* kObjectAttribute = "Object";
inline constexpr const char* kMaterialAttribute = "Material";
inline constexpr const char* kCreaseAttribute = "Crease";
inline constexpr const char* kCornerAttribute = "Corner";

struct MeshAttribute {
  MeshElement element;
  std::string name;
  std::shared_ptr<const AttributeValues> values;  ///< canonical, never null
};

/// Named attributes of the elements of a mesh, sorted by element and name; a name is unique for its kind of element.
/// Takes no memory if there are none. Immutable, cheap to copy.
class MeshAttributes {
 public:
  bool is_empty() const { return list_ == nullptr; }
  std::span<const MeshAttribute> all() const;
  /// Whether there are some of elements of this kind.
  bool has(MeshElement element) const;
  /// Null if there is none.
  const MeshAttribute* find(MeshElement element, std::string_view name) const;
  /// With an attribute added or replaced. The values need not be canonical.
  MeshAttributes with(MeshElement element, std::string name, const AttributeValues& values) const;
  MeshAttributes without(MeshElement element, std::string_view name) const;

  /// True if each attribute has a value for each element of the mesh.
  bool fits(const PolygonMesh& mesh) const;

  friend std::strong_ordering operator<=>(const MeshAttributes& a, const MeshAttributes& b);
  friend bool operator==(const MeshAttributes& a, const MeshAttributes& b) { return std::is_eq(a <=> b); }
  std::size_t hash() const;
  std::size_t heap_bytes() const;

 private:
  std::shared_ptr<const std::vector<MeshAttribute>> list_;  // null or not empty
};

/// Which element of another mesh each element was, for attributes that are taken over; kNone: a new element.
struct ElementSources {
  std::vector<std::uint32_t> vertices, edges, halfedges, faces;
};

/// The attributes of the elements that are the sources.
MeshAttributes taken_over(const MeshAttributes& attributes, const ElementSources& sources);

/// Per half-edge the number of its edge: edges are numbered in order of their first half-edges. Cost: linear.
std::vector<std::uint32_t> edge_numbers(const PolygonMesh& mesh);

/// Per edge of `mesh` the number of the edge of `source` that it was, by the half-edges that have run along it: per
/// half-edge of `mesh` one of `source`, or kNone. Cost: linear.
std::vector<std::uint32_t> edge_sources(const PolygonMesh& mesh, const PolygonMesh& source,
                                        std::span<const std::uint32_t> halfedges_along);

}  // namespace algebra3d
