#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/export_solid.h"
#include "algebra3d/operators/mesh_file.h"

namespace queries {

/// A mesh file to be written, as the command line says.
struct MeshOutput {
  std::string file;
  bool is_ascii = false;     ///< asked for
  bool is_binary = false;    ///< asked for
  bool may_replace = false;  ///< a file that is there
};

/// The form of the file by the ending of its name: .stl is binary, .off is ASCII unless the other was asked for, .obj
/// is ASCII. Errors: wrong_usage (another ending, a binary OBJ file, a file that is there and may not be replaced).
algebra3d::Result<algebra3d::MeshFileForm> form_of(const MeshOutput& output);

/// "STL, binary"
std::string form_text(const algebra3d::MeshFileForm& form);

/// What was written, for people.
struct WrittenMesh {
  std::size_t point_count = 0;  ///< 0 for STL, which has no list of points
  std::size_t face_count = 0;
  double rounding = 0;  ///< the largest change of a coordinate
};

/// Writes what the bytes of a mesh file hold to another one, facet by facet, without repair. Polygons stay polygons
/// between OBJ and OFF; equal corners of STL files become one point. `remarks` takes those of the reader.
/// Errors: those of the readers and writers of stl/.
algebra3d::Result<WrittenMesh> convert_mesh(std::string_view bytes, const std::string& name,
                                            const algebra3d::MeshFileForm& form, const std::filesystem::path& file,
                                            std::vector<std::string>& remarks, const std::atomic<bool>* cancel);

}  // namespace queries
