#include "queries/shell/mesh_output.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

#include "algebra3d/base/polygon_soup.h"
#include "algebra3d/repair/polygon_triangles.h"
#include "algebra3d/repair/weld.h"
#include "stl/obj_reader.h"
#include "stl/obj_writer.h"
#include "stl/off_reader.h"
#include "stl/off_writer.h"
#include "stl/stl_reader.h"
#include "stl/stl_writer.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::MeshFileForm;
using algebra3d::PolygonSoup;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;
using stl::MeshFormat;

namespace {

Result<MeshFormat> format_by_ending(const std::string& file) {
  if (const auto format = stl::format_of_name(file)) return *format;
  return Error{ErrorCode::wrong_usage, "{}: the ending says which format to write; expected .stl, .obj or .off", file};
}

/// A mesh file as it is: polygons, or the triangles of an STL file.
struct MeshContent {
  TriangleSoup triangles;
  PolygonSoup polygons;
  bool has_polygons = false;
};

Result<MeshContent> content_of(std::string_view bytes, const std::string& name, std::vector<std::string>& remarks,
                               const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(const MeshFormat format, stl::detect_mesh_format(bytes, name));
  MeshContent content;
  if (format == MeshFormat::stl) {
    ASSIGN_OR_RETURN(stl::ReadStl read, stl::read_stl(bytes, name, cancel));
    remarks = std::move(read.remarks);
    content.triangles = std::move(read.soup);
    return content;
  }
  auto read = format == MeshFormat::obj ? stl::read_obj(bytes, name, cancel) : stl::read_off(bytes, name, cancel);
  if (!read) return std::move(read).error();
  remarks = std::move(read->remarks);
  content.polygons = std::move(read->soup);
  content.has_polygons = true;
  return content;
}

Result<PolygonSoup> polygons_of(const TriangleSoup& soup, const std::string& name) {
  if (soup.triangles.size() > algebra3d::TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{}: {} triangles; at most {} can be joined", name, soup.triangles.size(),
                 algebra3d::TriangleMesh::kMaxFaces};
  const algebra3d::WeldedTriangles welded = algebra3d::weld(soup.triangles);
  PolygonSoup polygons;
  polygons.points = welded.points.approx();
  polygons.name = soup.name;
  for (const auto& triangle : welded.triangles) polygons.add_face(triangle);
  return polygons;
}

double float_rounding(const Vec3& point, double so_far) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    so_far = std::max(so_far, std::abs(static_cast<double>(static_cast<float>(point[axis])) - point[axis]));
  return so_far;
}

Result<WrittenMesh> write_triangles(const MeshContent& content, const MeshFileForm& form,
                                    const std::filesystem::path& file) {
  const TriangleSoup soup = content.has_polygons ? triangles_of(content.polygons) : content.triangles;
  const std::string& name = content.has_polygons ? content.polygons.name : soup.name;
  RETURN_IF_ERROR(stl::write_stl_file(file, soup, name, form.encoding));
  WrittenMesh written{0, soup.triangles.size(), 0};
  for (const auto& triangle : soup.triangles)
    for (const Vec3& corner : triangle) written.rounding = float_rounding(corner, written.rounding);
  return written;
}

Result<WrittenMesh> write_polygons(const PolygonSoup& soup, const MeshFileForm& form,
                                   const std::filesystem::path& file) {
  WrittenMesh written{soup.points.size(), soup.face_count(), 0};
  if (form.format == MeshFormat::obj) {
    RETURN_IF_ERROR(stl::write_obj_file(file, soup, soup.name));
    return written;
  }
  RETURN_IF_ERROR(stl::write_off_file(file, soup, form.encoding));
  if (form.encoding == stl::Format::binary)
    for (const Vec3& point : soup.points) written.rounding = float_rounding(point, written.rounding);
  return written;
}

}  // namespace

Result<MeshFileForm> form_of(const MeshOutput& output) {
  ASSIGN_OR_RETURN(const MeshFormat format, format_by_ending(output.file));
  if (format == MeshFormat::obj && output.is_binary)
    return Error{ErrorCode::wrong_usage, "{}: there are no binary OBJ files", output.file};
  std::error_code error;
  if (!output.may_replace && std::filesystem::exists(std::filesystem::symlink_status(output.file, error)))
    return Error{ErrorCode::wrong_usage, "{}: exists already; --force replaces it", output.file};
  const bool is_binary = output.is_binary || (format == MeshFormat::stl && !output.is_ascii);
  return MeshFileForm{format, is_binary ? stl::Format::binary : stl::Format::ascii};
}

std::string form_text(const MeshFileForm& form) {
  std::string name(name_of(form.format));
  if (form.format == MeshFormat::obj) return name;
  return name + (form.encoding == stl::Format::binary ? ", binary" : ", ASCII");
}

Result<WrittenMesh> convert_mesh(std::string_view bytes, const std::string& name, const MeshFileForm& form,
                                 const std::filesystem::path& file, std::vector<std::string>& remarks,
                                 const std::atomic<bool>* cancel) {
  ASSIGN_OR_RETURN(const MeshContent content, content_of(bytes, name, remarks, cancel));
  if (form.format == MeshFormat::stl) return write_triangles(content, form, file);
  if (content.has_polygons) return write_polygons(content.polygons, form, file);
  ASSIGN_OR_RETURN(const PolygonSoup polygons, polygons_of(content.triangles, name));
  return write_polygons(polygons, form, file);
}

}  // namespace queries
