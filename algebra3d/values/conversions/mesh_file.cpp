#include "algebra3d/values/conversions/mesh_file.h"

#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "algebra3d/kernel/soup/weld.h"
#include "base/file_content.h"
#include "base/mesh_content.h"
#include "base/propagate.h"
#include "mesh_formats/foreign_file.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/unwritten_file.h"

namespace algebra3d {
namespace {

using mesh_formats::MeshContent;
using mesh_formats::MeshFormat;
using mesh_formats::MeshFormats;

/// Whether attributes are read too.
enum class Extras { none, attributes };

Result<MeshFacets> read_as(const MeshFormat& format, std::string_view bytes, const std::string& name,
                           const std::atomic<bool>* cancel, Extras extras) {
  const bool has_attributes = extras == Extras::attributes && format.read_with_attributes != nullptr;
  const auto read_bytes = has_attributes ? format.read_with_attributes : format.read;
  A3D_ASSIGN(MeshContent read, read_bytes(bytes, name, cancel));
  return MeshFacets{std::move(read.facets), std::move(read.remarks), &format,
                    read.encoding,          read.wrong_count,        std::move(read.unread)};
}

Result<MeshFacets> read_facets(std::string_view bytes, const std::string& name, const MeshFormat* format,
                               const std::atomic<bool>* cancel, const MeshFormats& formats, Extras extras) {
  if (format == nullptr) {
    A3D_ASSIGN(const MeshFormat* const detected, formats.detect(bytes, name));
    return read_as(*detected, bytes, name, cancel, extras);
  }
  const MeshFormat* const known = formats.of_content(bytes);
  if (known == nullptr) A3D_TRY(mesh_formats::refuse_foreign(bytes, name, formats.names("or")));
  const MeshFormat& found = known != nullptr ? *known : *format;
  auto read = read_as(found, bytes, name, cancel, extras);
  if (found.name == format->name) return read;
  const std::string other = fmt::format("the content is {}, not {}", found.name, format->name);
  if (!read) {
    Error error = std::move(read).error();
    error.message += " (" + other + ")";
    return error;
  }
  read->remarks.insert(read->remarks.begin(), other + ", and is read as that");
  return read;
}

Result<FileContent> content_of(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const InputFile input, InputFile::open(path));
  A3D_TRY(mesh_formats::refuse_unwritten(input));
  return FileContent::read(input, cancel);
}

}  // namespace

Result<MeshFacets> read_mesh_facets(const std::filesystem::path& path, const MeshFormat* format,
                                    const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const FileContent file, content_of(path, cancel));
  return read_mesh_facets(file.bytes(), path.string(), format, cancel);
}

Result<MeshFacets> read_mesh_facets(std::string_view bytes, const std::string& name, const MeshFormat* format,
                                    const std::atomic<bool>* cancel) {
  return read_facets(bytes, name, format, cancel, mesh_formats::known_mesh_formats(), Extras::attributes);
}

Result<MeshFile> read_mesh_file(const std::filesystem::path& path, const MeshFormat* format,
                                const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const FileContent file, content_of(path, cancel));
  return read_mesh(file.bytes(), path.string(), format, cancel);
}

Result<MeshFile> read_mesh(std::string_view bytes, const std::string& name, const MeshFormat* format,
                           const std::atomic<bool>* cancel, const MeshFormats& formats) {
  A3D_ASSIGN(MeshFacets read, read_facets(bytes, name, format, cancel, formats, Extras::none));
  MeshFile result;
  result.remarks = std::move(read.remarks);
  result.format = read.format;
  result.encoding = read.encoding;
  result.wrong_count = read.wrong_count;
  result.unread = std::move(read.unread);
  if (const auto* const polygons = std::get_if<PolygonSoup>(&read.facets)) result.bent = bent_polygons(*polygons);
  if (result.bent.count > 0) result.remarks.push_back(result.bent.text());
  result.soup = triangles_of(std::move(read.facets));
  return result;
}

TriangleSoup triangles_of(mesh_formats::Facets facets) {
  if (auto* const triangles = std::get_if<TriangleSoup>(&facets)) return std::move(*triangles);
  return triangles_of(std::get<PolygonSoup>(facets));
}

Result<PolygonSoup> polygons_of(mesh_formats::Facets facets, const std::string& name) {
  if (auto* const given = std::get_if<PolygonSoup>(&facets)) return std::move(*given);
  const TriangleSoup& soup = std::get<TriangleSoup>(facets);
  if (soup.triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; at most {} can be joined", soup.triangles.size(),
                 TriangleMesh::kMaxFaces}
        .about(name);
  const WeldedTriangles welded = weld(soup.triangles);
  PolygonSoup polygons;
  polygons.points = welded.points.approx();
  polygons.name = soup.name;
  for (const IndexTriangle& triangle : welded.triangles) polygons.add_face(triangle);
  return polygons;
}

}  // namespace algebra3d
