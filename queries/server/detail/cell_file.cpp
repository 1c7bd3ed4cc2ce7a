#include "queries/server/detail/cell_file.h"

#include <algorithm>
#include <cctype>

#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/diagnostics.h"
#include "base/file_content.h"
#include "base/propagate.h"
#include "base/temporary_folder.h"
#include "base/text.h"

namespace queries {
namespace {

using algebra3d::Context;
using algebra3d::ExportedSolid;
using algebra3d::Mesh3d;
using algebra3d::MeshFileForm;
using algebra3d::Surface3d;
using algebra3d::TemporaryFolder;
using algebra3d::TypeOf;
using algebra3d::Volume3d;

constexpr const char* kCommand = "export";

// Characters that are safe in a header and in every file system.
std::string file_name(const std::string& name, const MeshFileForm& form) {
  std::string result;
  for (const char c : name)
    result += std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 0x80 ? c : '_';
  return result + std::string(form.format->endings.front());
}

Result<ExportedSolid> write_mesh(const Mesh3d& mesh, const std::string& name, const std::string& file,
                                 const MeshFileForm& form, Context& context) {
  if (!form.format->stores_triangles) return algebra3d::export_mesh(context, kCommand, mesh, name, file, form);
  A3D_ASSIGN(const Mesh3d triangles, algebra3d::triangulated(mesh, context.monitor()));
  return algebra3d::export_mesh(context, kCommand, triangles, name, file, form);
}

Result<ExportedSolid> write(const Value& value, const std::string& name, const std::string& file,
                            const MeshFileForm& form, Context& context) {
  const algebra3d::Type* const type = &value.type();
  if (type == &TypeOf<Volume3d>::type())
    return algebra3d::export_solid(context, kCommand, value.get<Volume3d>(), name, file, form);
  if (type == &TypeOf<Mesh3d>::type()) return write_mesh(value.get<Mesh3d>(), name, file, form, context);
  if (type == &TypeOf<Surface3d>::type()) {
    A3D_ASSIGN(algebra3d::PolygonMesh mesh,
               algebra3d::polygon_mesh_of(value.get<Surface3d>().mesh(), algebra3d::Merging::none, context.monitor()));
    return write_mesh(Mesh3d(std::move(mesh)), name, file, form, context);
  }
  return Error{ErrorCode::invalid_value, "a {} has no mesh file; expected a volume3d, surface3d or mesh3d",
               type->name()};
}

// The error without the path of the temporary folder.
Error with_own_name(Error error, const std::filesystem::path& folder) {
  error.message = algebra3d::with_replaced(std::move(error.message), folder.string() + "/", "");
  return error;
}

}  // namespace

std::optional<MeshFileForm> file_form(std::string_view name) {
  const bool is_ascii = name == "stl-ascii";
  std::string upper(is_ascii ? "stl" : name);
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const mesh_formats::MeshFormat* const format = mesh_formats::known_mesh_formats().named(upper);
  if (format == nullptr) return std::nullopt;
  return MeshFileForm{format, is_ascii ? mesh_formats::Encoding::ascii : format->forms.front().encoding};
}

Result<CellFile> file_of(const Value& value, const std::string& name, const MeshFileForm& form, Context& context) {
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "the value is undefined"};
  A3D_ASSIGN(const TemporaryFolder folder, TemporaryFolder::make());
  A3D_ASSIGN(const Value loaded, value.loaded());
  CellFile result{.type = "application/octet-stream", .name = file_name(name, form), .bytes = {}, .diagnostics = {}};
  // The file is ours: names of clients do not lead to it.
  Context own{.diagnostics = context.diagnostics,
              .cancel = context.cancel,
              .folder = folder.path(),
              .memory = context.memory,
              .report = context.report};
  A3D_ASSIGN(const ExportedSolid written, write(loaded, name, result.name, form, own));
  if (written.refusal) return with_own_name(*written.refusal, folder.path());
  A3D_ASSIGN(const auto content, algebra3d::FileContent::read(folder.path() / result.name, context.cancel));
  result.bytes = content.bytes();
  result.diagnostics = context.diagnostics.summary();
  return result;
}

}  // namespace queries
