#pragma once

#include <string>

#include "algebra3d/base/context.h"
#include "algebra3d/types/spatial.h"
#include "mesh_files/mesh_format.h"
#include "mesh_files/mesh_formats.h"

namespace algebra3d {

/// A format and encoding of a mesh file.
struct MeshFileForm {
  const mesh_files::MeshFormat* format = nullptr;                ///< not null
  mesh_files::Encoding encoding = mesh_files::Encoding::binary;  ///< one that the format has
};

/// Writes the solid to a mesh file as exportSTL, exportOBJ and exportOFF do: rounded to the precision of the format,
/// atomically. `command` begins the diagnostics; `name` is the name of the solid in the file. False, with a diagnostic,
/// if the solid cannot be rounded or the file cannot be written. Errors: interrupted, out_of_memory.
Result<bool> export_solid(Context& context, const std::string& command, const Volume3d& solid, const std::string& name,
                          const std::string& file, const MeshFileForm& form);

}  // namespace algebra3d
