#include "algebra3d/mesh/files.h"

#include <algorithm>
#include <utility>

#include "algebra3d/meshes/mesh_access.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"

namespace algebra3d::mesh {
namespace {

using detail::MeshAccess;

Result<MeshFileForm> form_of(const std::filesystem::path& file, std::string_view form) {
  const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
  const mesh_formats::MeshFormat* const format = formats.of_name(file.string());
  if (format == nullptr)
    return Error{ErrorCode::wrong_usage, "{}: expected a name that ends in {}", file.string(), formats.endings("or")};
  if (form.empty()) return MeshFileForm{format, format->forms.front().encoding};
  const auto found =
      std::ranges::find_if(format->forms, [&](const auto& known) { return format->word_of(known) == form; });
  if (found == format->forms.end())
    return Error{ErrorCode::wrong_usage,
                 "{}: expected a form of {} files, got '{}'; the forms of all formats are {}",
                 file.string(),
                 format->name,
                 form,
                 formats.form_words("and")};
  return MeshFileForm{format, found->encoding};
}

}  // namespace

Result<ReadMesh> read_mesh(const std::filesystem::path& file, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<ReadMesh> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(ImportedMesh read, import_mesh(file, monitor));
    if (read.refusal) return *std::move(read.refusal);
    return ReadMesh{MeshAccess::outer(read.mesh->mesh(), read.mesh->attributes()), std::move(read.remarks)};
  });
}

template <AnyMesh M>
Result<std::vector<std::string>> write_mesh(const M& mesh, const std::filesystem::path& file, std::string_view form,
                                            const Monitor& monitor) {
  return without_exceptions([&]() -> Result<std::vector<std::string>> {
    A3D_ASSIGN(const MeshFileForm file_form, form_of(file, form));
    const InterruptionScope interruption(monitor.cancel());
    Diagnostics diagnostics;
    Context context{.diagnostics = diagnostics, .cancel = monitor.cancel(), .folder = {}, .report = monitor.report()};
    A3D_ASSIGN(ExportedSolid written,
               export_mesh(context, "write_mesh", Mesh3d(detail::polygons_of(mesh), MeshAccess::attributes(mesh)),
                           file.stem().string(), file.string(), file_form));
    if (written.refusal) return *std::move(written.refusal);
    return diagnostics.summary();
  });
}

template Result<std::vector<std::string>> write_mesh(const TriangleMesh&, const std::filesystem::path&,
                                                     std::string_view, const Monitor&);
template Result<std::vector<std::string>> write_mesh(const PolygonMesh&, const std::filesystem::path&, std::string_view,
                                                     const Monitor&);

}  // namespace algebra3d::mesh
