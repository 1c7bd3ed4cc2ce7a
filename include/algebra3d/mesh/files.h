#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/mesh/mesh.h"

namespace algebra3d::mesh {

/// A mesh of a file, and what is remarkable about it.
struct ReadMesh {
  PolygonMesh mesh;
  /// Irregularities of the file that were tolerated, and non-manifold places, one sentence each.
  std::vector<std::string> remarks;
};

/// Reads a mesh file (STL, OBJ or OFF, detected from content and name) with its vertices and faces in their order;
/// equal corners of STL triangles become one vertex. Texture coordinates, normals, colours, groups, objects and
/// materials become attributes (algebra3d/halfedge/mesh_element.h has the names). Nothing is repaired. Errors:
/// file_missing and io_error if the file cannot be read, file_format for its content, with the place; limit_exceeded;
/// interrupted.
Result<ReadMesh> read_mesh(const std::filesystem::path& file, const Monitor& monitor = {});

/// Writes a mesh in the format of the name's ending (.stl, .obj, .off), with the attributes that the format has,
/// of the elements of which reading gives them, such as `Normal` of half-edges in OBJ; atomically. `form`: one of the
/// forms of that format, "stl", "stl-ascii", "obj", "off" or "off-binary"; empty for the usual one. Returns remarks:
/// attributes that the format cannot hold, rounded vertices. Errors: wrong_usage for another ending or form;
/// file_missing (no such folder), disk_full and io_error with the system's reason; invalid_value and limit_exceeded for
/// what the format cannot hold; interrupted.
template <AnyMesh M>
Result<std::vector<std::string>> write_mesh(const M& mesh, const std::filesystem::path& file,
                                            std::string_view form = {}, const Monitor& monitor = {});

}  // namespace algebra3d::mesh
