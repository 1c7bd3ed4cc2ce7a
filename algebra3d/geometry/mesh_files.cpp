#include "algebra3d/geometry/mesh_files.h"

#include <utility>

#include "algebra3d/geometry/operator_call.h"
#include "algebra3d/operators/export_solid.h"
#include "algebra3d/operators/import_solid.h"

namespace algebra3d {

Result<ReadSolid> read_solid(const std::filesystem::path& file, const std::string& options, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const RepairOptions parsed, parse_repair_options(options));
  ASSIGN_OR_RETURN(ImportedSolid imported, import_solid(file, std::nullopt, parsed, monitor));
  ReadSolid result;
  if (imported.solid) result.solid = Solid(std::make_shared<const Volume3d>(*std::move(imported.solid)));
  result.status = std::move(imported.status);
  result.remarks = std::move(imported.remarks);
  result.area_dropped = imported.measures.area_dropped;
  result.area_added = imported.measures.area_added;
  result.dropped_distance = imported.measures.dropped_distance;
  result.added_distance = imported.measures.added_distance;
  return result;
}

Result<Surface> read_surface(const std::filesystem::path& file, const Monitor& monitor) {
  ASSIGN_OR_RETURN(ImportedSurface imported, import_surface(file, monitor));
  if (!imported.surface) return Error{ErrorCode::file_format, imported.reason};
  return Surface(std::make_shared<const Surface3d>(*std::move(imported.surface)));
}

Status write_solid(const Solid& solid, const std::filesystem::path& file, const Monitor& monitor) {
  const auto format = stl::format_of_name(file.string());
  if (!format)
    return Error{ErrorCode::wrong_usage, "{}: expected a name that ends in .stl, .obj or .off", file.string()};
  const MeshFileForm form{*format, *format == stl::MeshFormat::stl ? stl::Format::binary : stl::Format::ascii};
  detail::Surroundings surroundings(monitor);
  ASSIGN_OR_RETURN(const bool is_written, export_solid(surroundings.context, "write_solid", solid.value(),
                                                       file.stem().string(), file.string(), form));
  if (!is_written) return surroundings.reason(file.string() + ": the solid cannot be written");
  return {};
}

}  // namespace algebra3d
