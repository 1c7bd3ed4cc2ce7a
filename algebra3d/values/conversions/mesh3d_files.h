#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/types/mesh3d.h"
#include "base/context.h"

namespace algebra3d {

/// The result of importing a mesh file as a mesh3d: the mesh or the error that says why there is none, and remarks.
struct ImportedMesh {
  std::optional<Mesh3d> mesh;
  std::optional<Error> refusal;
  std::vector<std::string> remarks;  ///< of the reader, and where the mesh is not manifold; one sentence each
};

/// Reads a mesh file with its vertices and polygons in their order; equal corners of STL triangles become one vertex.
/// The attributes of an OBJ file become attributes of the mesh with the names of mesh_attributes.h.
/// The format is detected (MeshFormats::detect). Errors: interrupted, out_of_memory.
Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const Monitor& monitor = {});
/// As above, for the bytes of a file of the given format or, if that is null, of the detected one; `name` is for
/// messages.
Result<ImportedMesh> import_mesh(std::string_view bytes, const std::string& name,
                                 const mesh_formats::MeshFormat* format, const Monitor& monitor = {});

/// Writes the vertices and faces in their order; in a format of triangles, the triangles of the faces: who
/// wants those of `triangulated` passes a mesh of triangles. A diagnostic counts the vertices that are rounded: to
/// doubles, or to floats in a form that holds these. An OBJ file has the attributes with the names and kinds that
/// reading gives; a diagnostic counts the others. A refusal is also a diagnostic. Errors: interrupted, out_of_memory.
Result<ExportedSolid> export_mesh(Context& context, const std::string& command, const Mesh3d& mesh,
                                  const std::string& name, const MeshDestination& to, const MeshFileForm& form);
/// As above, to the file that `file` means. Errors: also those of MeshDestination::file.
Result<ExportedSolid> export_mesh(Context& context, const std::string& command, const Mesh3d& mesh,
                                  const std::string& name, const std::string& file, const MeshFileForm& form);

}  // namespace algebra3d
