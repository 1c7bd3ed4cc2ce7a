#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/mesh_file.h"

namespace queries {

/// The mesh file to be written, by the command line.
struct MeshOutput {
  std::string file;
  bool is_ascii = false;     ///< the option was given
  bool is_binary = false;    ///< the option was given
  bool may_replace = false;  ///< overwrite an existing file
};

/// The format of the file by the ending of its name, and its encoding: the first that the format has unless the other
/// was asked for. Errors: wrong_usage (another ending, an encoding that the format does not have, an existing file that
/// may not be replaced).
algebra3d::Result<algebra3d::MeshFileForm> form_of(const MeshOutput& output);

/// The form as text: "STL, binary".
std::string form_text(const algebra3d::MeshFileForm& form);

/// Information about a written file, for people.
struct WrittenMesh {
  std::size_t point_count = 0;  ///< 0 for formats without a list of points
  std::size_t face_count = 0;
  double rounding = 0;  ///< the largest change of a coordinate
};

/// Converts the bytes of a mesh file to another file, facet by facet, without repair. If the format has polygons, they
/// stay polygons, and equal corners of triangles become one point. `remarks` receives the remarks of the reader.
/// Errors: those of MeshFormat::read and write.
algebra3d::Result<WrittenMesh> convert_mesh(std::string_view bytes, const std::string& name,
                                            const algebra3d::MeshFileForm& form, const std::filesystem::path& file,
                                            std::vector<std::string>& remarks, const std::atomic<bool>* cancel);

}  // namespace queries
