#pragma once

#include <cstddef>

#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "base/soup_attributes.h"

namespace algebra3d {

/// The attributes of a mesh file as those of a mesh, with the names of mesh_attributes.h: texture coordinates and
/// normals of half-edges; groups, objects and materials of faces. Undefined where the file says nothing.
MeshAttributes attributes_of_file(const SoupAttributes& given);

struct FileAttributes {
  SoupAttributes attributes;
  std::size_t left_out = 0;  ///< number of attributes that a file cannot hold
};

/// The other way round. Equal texture coordinates and normals are written once.
FileAttributes attributes_for_file(const MeshAttributes& attributes);

}  // namespace algebra3d
