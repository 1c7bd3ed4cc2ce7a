#include "queries/shell/detail/mesh_output.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>
#include <variant>

#include "base/mesh_content.h"
#include "base/polygon_soup.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::MeshFileForm;
using algebra3d::PolygonSoup;
using algebra3d::Result;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;
using mesh_formats::Encoding;
using mesh_formats::Facets;
using mesh_formats::MeshFormat;
using mesh_formats::MeshFormats;

namespace {

double float_rounding(const Vec3& point, double so_far) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    so_far = std::max(so_far, std::abs(static_cast<double>(static_cast<float>(point[axis])) - point[axis]));
  return so_far;
}

/// The points or, of triangles, the corners.
template <typename Visit>
void for_each_point(const Facets& facets, const Visit& visit) {
  if (const auto* const polygons = std::get_if<PolygonSoup>(&facets)) {
    std::ranges::for_each(polygons->points, visit);
    return;
  }
  for (const auto& triangle : std::get<TriangleSoup>(facets).triangles) std::ranges::for_each(triangle, visit);
}

WrittenMesh counts_of(const Facets& facets) {
  if (const auto* const polygons = std::get_if<PolygonSoup>(&facets))
    return {polygons->points.size(), polygons->face_count(), 0};
  return {0, std::get<TriangleSoup>(facets).triangles.size(), 0};
}

std::string name_in(const Facets& facets) {
  return std::visit([](const auto& soup) { return soup.name; }, facets);
}

}  // namespace

Result<MeshFileForm> form_of(const MeshOutput& output) {
  const MeshFormats& formats = mesh_formats::known_mesh_formats();
  const MeshFormat* const format = formats.of_name(output.file);
  if (format == nullptr)
    return Error{ErrorCode::wrong_usage, "{}: the ending says which format to write; expected {}", output.file,
                 formats.endings("or")};
  Encoding encoding = format->forms.front().encoding;
  if (output.is_binary) encoding = Encoding::binary;
  if (output.is_ascii) encoding = Encoding::ascii;
  if (format->form(encoding) == nullptr)
    return Error{ErrorCode::wrong_usage, "{}: there are no {} {} files", output.file,
                 encoding == Encoding::binary ? "binary" : "ASCII", format->name};
  std::error_code error;
  if (!output.may_replace && std::filesystem::exists(std::filesystem::symlink_status(output.file, error)))
    return Error{ErrorCode::wrong_usage, "{}: exists already; --force replaces it", output.file};
  return MeshFileForm{format, encoding};
}

std::string form_text(const MeshFileForm& form) {
  std::string name(form.format->name);
  if (form.format->forms.size() == 1) return name;
  return name + (form.encoding == Encoding::binary ? ", binary" : ", ASCII");
}

Result<WrittenMesh> convert_mesh(std::string_view bytes, const std::string& name, const MeshFileForm& form,
                                 const std::filesystem::path& file, std::vector<std::string>& remarks,
                                 const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const MeshFormat* const given, mesh_formats::known_mesh_formats().detect(bytes, name));
  A3D_ASSIGN(mesh_formats::MeshContent content, given->read(bytes, name, cancel));
  remarks = std::move(content.remarks);
  const MeshFormat& format = *form.format;
  const std::string solid_name = name_in(content.facets);
  Facets facets;
  if (format.stores_triangles) {
    facets = triangles_of(std::move(content.facets));
  } else {
    A3D_ASSIGN(facets, polygons_of(std::move(content.facets), name));
  }
  A3D_TRY(format.write_file(file, facets, solid_name, form.encoding));
  WrittenMesh written = counts_of(facets);
  if (format.form(form.encoding)->coordinates == mesh_formats::CoordinateRange::floats)
    for_each_point(facets, [&](const Vec3& point) { written.rounding = float_rounding(point, written.rounding); });
  return written;
}

}  // namespace queries
