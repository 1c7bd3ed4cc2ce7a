#include "algebra3d/values/conversions/mesh_destination.h"

#include "base/propagate.h"

namespace algebra3d {

Result<MeshDestination> MeshDestination::file(const Context& context, const std::string& file) {
  A3D_ASSIGN(OutputPath path, context.resolve_output(file));
  return MeshDestination(std::move(path), file);
}

Status MeshDestination::write(const mesh_formats::MeshFormat& format, const mesh_formats::Facets& facets,
                              std::string_view solid_name, mesh_formats::Encoding encoding) const {
  if (const auto* const path = std::get_if<OutputPath>(&target_))
    return format.write_file(*path, facets, solid_name, encoding);
  return format.write(*std::get<ByteSink*>(target_), facets, solid_name, encoding);
}

}  // namespace algebra3d
