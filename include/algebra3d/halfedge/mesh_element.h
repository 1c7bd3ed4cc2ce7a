#pragma once

#include <array>
#include <cstdint>

namespace algebra3d {

/// The kinds of elements of a mesh. A half-edge keeps what belongs to the corner that it leaves.
enum class MeshElement : std::uint8_t { vertex, edge, halfedge, face };
inline constexpr std::array kMeshElements{MeshElement::vertex, MeshElement::edge, MeshElement::halfedge,
                                          MeshElement::face};

/// The kinds of values of attributes: one number, two, three, or a text.
enum class AttributeKind : std::uint8_t { real, pair, vector, text };
inline constexpr std::array kAttributeKinds{AttributeKind::real, AttributeKind::pair, AttributeKind::vector,
                                            AttributeKind::text};

// Names of attributes that mesh files have: texture coordinates and normals of half-edges, that is, of corners, or of
// vertices; groups, objects, materials and the files of these of faces; colours of vertices and faces, as red, green
// and blue from 0 to 1, with their opacities. Vectors of any elements with the name of normals turn with the mesh. And
// those that subdivision reads: the sharpness of edges and of vertices (subdivision/subdivided.h).
inline constexpr const char* kTextureAttribute = "TextureCoordinate";
inline constexpr const char* kNormalAttribute = "Normal";
inline constexpr const char* kColourAttribute = "Colour";
inline constexpr const char* kOpacityAttribute = "Opacity";
inline constexpr const char* kGroupAttribute = "Group";
inline constexpr const char* kObjectAttribute = "Object";
inline constexpr const char* kMaterialAttribute = "Material";
inline constexpr const char* kMaterialLibraryAttribute = "MaterialLibrary";
inline constexpr const char* kCreaseAttribute = "Crease";
inline constexpr const char* kCornerAttribute = "Corner";

}  // namespace algebra3d
