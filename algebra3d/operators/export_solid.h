#pragma once

#include <string>

#include "algebra3d/base/context.h"
#include "algebra3d/types/spatial.h"
#include "stl/mesh_format.h"
#include "stl/stl_format.h"

namespace algebra3d {

/// A mesh file that a solid can be written to. OBJ files are ASCII always.
struct MeshFileForm {
  stl::MeshFormat format = stl::MeshFormat::stl;
  stl::Format encoding = stl::Format::binary;
};

/// Writes the solid to the file as exportSTL, exportOBJ and exportOFF do: rounded to what the form can hold, whole or
/// not at all. `command` begins the diagnostics; `name` is that of the solid in the file. False, with a diagnostic, if
/// the solid cannot be rounded or the file not be written. Errors: interrupted, out_of_memory.
Result<bool> export_solid(Context& context, const std::string& command, const Volume3d& solid, const std::string& name,
                          const std::string& file, const MeshFileForm& form);

}  // namespace algebra3d
