#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/soup/polygon_triangulation.h"
#include "base/mesh_content.h"
#include "base/polygon_soup.h"
#include "base/triangle_soup.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"

namespace algebra3d {

/// The triangles of a mesh file; polygons of more corners are triangulated (soup/polygon_triangulation.h).
struct MeshFile {
  TriangleSoup soup;
  std::vector<std::string> remarks;  ///< irregularities that were tolerated or dropped, one sentence each
  const mesh_formats::MeshFormat* format = nullptr;  ///< never null
  mesh_formats::Encoding encoding = mesh_formats::Encoding::binary;
  std::optional<mesh_formats::WrongCount> wrong_count;
  std::vector<std::string> unread;  ///< as MeshContent::unread
  BentPolygons bent;                ///< also among the remarks
};

/// The facets of a mesh file as it stores them: triangles or polygons.
struct MeshFacets {
  mesh_formats::Facets facets;
  std::vector<std::string> remarks;                  ///< as in MeshFile
  const mesh_formats::MeshFormat* format = nullptr;  ///< never null
  mesh_formats::Encoding encoding = mesh_formats::Encoding::binary;
  std::optional<mesh_formats::WrongCount> wrong_count;
  std::vector<std::string> unread = {};  ///< as MeshContent::unread
};

/// Reads a mesh file of the given format or, if that is null, of the detected one (MeshFormats::detect). If the content
/// is clearly of another format, it is read as that, with a remark, or the error says so. Errors: those of FileContent,
/// refuse_unwritten, refuse_foreign and MeshFormat::read, with the file name.
Result<MeshFile> read_mesh_file(const std::filesystem::path& path, const mesh_formats::MeshFormat* format,
                                const std::atomic<bool>* cancel = nullptr);

/// Reads a mesh file with the facets as they are in the file, and with the attributes of polygons.
Result<MeshFacets> read_mesh_facets(const std::filesystem::path& path, const mesh_formats::MeshFormat* format,
                                    const std::atomic<bool>* cancel = nullptr);

/// As above, for the bytes of a file; `name` as for read_mesh.
Result<MeshFacets> read_mesh_facets(std::string_view bytes, const std::string& name,
                                    const mesh_formats::MeshFormat* format, const std::atomic<bool>* cancel = nullptr);

/// `read_mesh_file` for the bytes of a file; `name` is for messages, and to find the format if the content is
/// ambiguous.
Result<MeshFile> read_mesh(std::string_view bytes, const std::string& name, const mesh_formats::MeshFormat* format,
                           const std::atomic<bool>* cancel = nullptr,
                           const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats());

/// Converts facets to triangles; polygons are triangulated (soup/polygon_triangulation.h).
TriangleSoup triangles_of(mesh_formats::Facets facets);

/// Converts facets to polygons; equal corners of triangles become one point. Errors: limit_exceeded (more triangles
/// than a mesh may have), beginning with `name`.
Result<PolygonSoup> polygons_of(mesh_formats::Facets facets, const std::string& name);

}  // namespace algebra3d
