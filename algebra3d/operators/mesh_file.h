#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/triangle_soup.h"
#include "stl/mesh_format.h"
#include "stl/stl_format.h"

namespace algebra3d {

/// The triangles of a mesh file; polygons of more corners are triangulated (repair/polygon_triangles.h).
struct MeshFile {
  TriangleSoup soup;
  std::vector<std::string> remarks;  ///< what was tolerated or left out, one sentence each
  stl::MeshFormat format = stl::MeshFormat::stl;
  bool is_binary = false;
  std::optional<stl::WrongCount> wrong_count;  ///< of a binary STL file
};

/// Reads a mesh file of the format or, if none is given, of the one that its content and name say (stl/mesh_format.h).
/// A content that is without doubt of another format than the given one is read as what it is, with a remark, or the
/// error says so. Errors: those of FileContent, refuse_unwritten, refuse_foreign and the readers of stl/, which name
/// the file.
Result<MeshFile> read_mesh_file(const std::filesystem::path& path, std::optional<stl::MeshFormat> format,
                                const std::atomic<bool>* cancel = nullptr);

/// The same of the bytes of a file; `name` is used in messages, and to find the format where the content leaves doubts.
Result<MeshFile> read_mesh(std::string_view bytes, const std::string& name, std::optional<stl::MeshFormat> format,
                           const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
