#include "algebra3d/geometry/mesh_files.h"

#include <utility>

#include "algebra3d/library/detail/surroundings.h"
#include "algebra3d/library/shape_access.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {

using detail::ShapeAccess;

Result<ReadSolid> read_solid(const std::filesystem::path& file, const std::string& options, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<ReadSolid> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(const RepairOptions parsed, parse_repair_options(options));
    A3D_ASSIGN(ImportedSolid imported, import_solid(file, nullptr, parsed, monitor));
    ReadSolid result;
    if (imported.solid) result.solid = ShapeAccess::outer(*std::move(imported.solid));
    result.status = imported.text();
    result.remarks = std::move(imported.remarks);
    result.area_dropped = imported.measures.area_dropped;
    result.area_added = imported.measures.area_added;
    result.dropped_distance = imported.measures.dropped_distance;
    result.added_distance = imported.measures.added_distance;
    return result;
  });
}

Result<Surface> read_surface(const std::filesystem::path& file, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Surface> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(ImportedSurface imported, import_surface(file, monitor));
    if (imported.refusal) return *std::move(imported.refusal);
    return ShapeAccess::outer(*std::move(imported.surface));
  });
}

Status write_solid(const Solid& solid, const std::filesystem::path& file, const Monitor& monitor) {
  return without_exceptions([&]() -> Status {
    const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
    const mesh_formats::MeshFormat* const format = formats.of_name(file.string());
    if (format == nullptr)
      return Error{ErrorCode::wrong_usage, "{}: expected a name that ends in {}", file.string(), formats.endings("or")};
    const MeshFileForm form{format, format->forms.front().encoding};
    detail::Surroundings surroundings(monitor);
    A3D_ASSIGN(ExportedSolid exported, export_solid(surroundings.context, "write_solid", ShapeAccess::content(solid),
                                                    file.stem().string(), file.string(), form));
    if (exported.refusal) return *std::move(exported.refusal);
    return {};
  });
}

}  // namespace algebra3d
