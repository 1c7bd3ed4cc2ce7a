#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "queries/streams/datum.h"

namespace queries {

/// A value as the content of a mesh file.
struct CellFile {
  std::string_view type;  ///< media type
  std::string name;       ///< for the client's file
  std::string bytes;
  std::vector<std::string> diagnostics;  ///< how far coordinates were rounded
};

/// The form that a client names: stl, stl-ascii, obj or off.
std::optional<algebra3d::MeshFileForm> file_form(std::string_view name);

/// The file of a solid, surface or mesh, written as the export operators do. Errors: invalid_value for other types,
/// undefined values and solids that cannot be rounded; those of the store; interrupted.
Result<CellFile> file_of(const Value& value, const std::string& name, const algebra3d::MeshFileForm& form,
                         algebra3d::Context& context);

}  // namespace queries
