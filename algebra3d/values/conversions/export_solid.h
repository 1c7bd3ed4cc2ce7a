#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/values/conversions/mesh_destination.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"

namespace algebra3d {

/// A format and encoding of a mesh file.
struct MeshFileForm {
  const mesh_formats::MeshFormat* format = nullptr;                  ///< not null
  mesh_formats::Encoding encoding = mesh_formats::Encoding::binary;  ///< one that the format has
};

/// The result of exporting a solid: why the file was not written, if it was not.
struct ExportedSolid {
  std::optional<Error> refusal;
};

/// Writes the solid as a mesh file as exportSTL, exportOBJ and exportOFF do: rounded to the precision of the format.
/// `command` begins the diagnostics; `name` is the name of the solid in the file. A refusal is also a
/// diagnostic: invalid_value if the solid cannot be rounded, else the errors of MeshFormat::write. Errors: interrupted,
/// limit_exceeded, out_of_memory.
Result<ExportedSolid> export_solid(Context& context, const std::string& command, const Volume3d& solid,
                                   const std::string& name, const MeshDestination& to, const MeshFileForm& form);
/// As above, to the file that `file` means. Errors: also those of MeshDestination::file.
Result<ExportedSolid> export_solid(Context& context, const std::string& command, const Volume3d& solid,
                                   const std::string& name, const std::string& file, const MeshFileForm& form);

}  // namespace algebra3d
