#pragma once

#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/conversions/mesh_file.h"
#include "algebra3d/values/types/bytes.h"
#include "base/context.h"

namespace algebra3d {

/// The name in messages for the content of a file that has none.
inline const std::string kBytesName = "the bytes";

/// Imports the content of a mesh file of the given format or, if that is null, of the detected one. Errors: those of
/// import_solid.
inline Result<ImportedSolid> solid_of_bytes(const Context& context, const Bytes& bytes,
                                            const mesh_formats::MeshFormat* format, const RepairOptions& options) {
  return import_solid(read_mesh(bytes.content, kBytesName, format, context.cancel), options, context.monitor());
}

}  // namespace algebra3d
