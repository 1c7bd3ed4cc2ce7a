#include "algebra3d/values/conversions/mesh3d_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/nonmanifold_text.h"
#include "algebra3d/values/conversions/detail/soup_mesh.h"
#include "algebra3d/values/conversions/mesh_file.h"
#include "algebra3d/values/types/utf8.h"
#include "base/diagnostics.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/mesh_content.h"
#include "base/propagate.h"
#include "base/soup_attributes.h"
#include "base/text.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

struct FileAttributes {
  SoupAttributes attributes;
  std::size_t left_out = 0;  ///< number of attributes that a file cannot hold
};

MeshAttributes with_names(MeshAttributes attributes, const char* name, const SoupAttributes::FaceNames& given) {
  if (given.of_face.empty()) return attributes;
  AttributeValues values(AttributeKind::text, given.of_face.size());
  for (const std::string& text : given.names) values.add_text(shown_as_text(text));
  for (std::size_t f = 0; f < given.of_face.size(); ++f)
    if (given.of_face[f] != kNone) values.set_text(f, given.of_face[f]);
  return attributes.with(MeshElement::face, name, values);
}

/// Per corner the numbers of `elements` that it has.
template <typename Element, typename Numbers>
AttributeValues corner_values(AttributeKind kind, const std::vector<std::uint32_t>& corners,
                              const std::vector<Element>& elements, Numbers numbers_of) {
  AttributeValues values(kind, corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i] != kNone) values.set(i, numbers_of(elements[corners[i]]));
  return values;
}

/// The attribute of a file that a mesh has, if it has the kind.
const AttributeValues* find_values(const MeshAttributes& attributes, MeshElement element, const char* name,
                                   AttributeKind kind) {
  const MeshAttribute* const found = attributes.find(element, name);
  return found != nullptr && found->values->kind() == kind ? found->values.get() : nullptr;
}

/// Numbers of the different values, which `table` then has.
std::vector<std::uint32_t> numbered(const AttributeValues& values, PointTable& table) {
  std::vector<std::uint32_t> numbers(values.size(), kNone);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values.is_defined(i)) continue;
    const std::span<const double> v = values.numbers(i);
    numbers[i] = table.intern(PointRef(Vec3{v[0], v[1], v.size() > 2 ? v[2] : 0}));
  }
  return numbers;
}

SoupAttributes::FaceNames names_of(const AttributeValues& values) {
  return {values.texts(), values.numbers_of_texts()};
}

/// The mesh's attributes with those of a list with an entry for each element, if it is not empty.
template <typename Element, typename Numbers>
MeshAttributes with_list(MeshAttributes attributes, MeshElement element, const char* name, AttributeKind kind,
                         const std::vector<Element>& list, Numbers numbers_of) {
  if (list.empty()) return attributes;
  AttributeValues values(kind, list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto numbers = numbers_of(list[i]);
    values.set(i, numbers);
  }
  return attributes.with(element, name, values);
}

std::array<double, 3> numbers_of_vector(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// Opacities only if the file has some.
MeshAttributes with_colours(MeshAttributes attributes, MeshElement element,
                            const std::vector<SoupAttributes::Colour>& colours) {
  using Colour = SoupAttributes::Colour;
  attributes = with_list(std::move(attributes), element, kColourAttribute, AttributeKind::vector, colours,
                         [](const Colour& colour) { return numbers_of_vector(colour.rgb); });
  if (std::ranges::none_of(colours, [](const Colour& colour) { return std::isfinite(colour.opacity); }))
    return attributes;
  return with_list(std::move(attributes), element, kOpacityAttribute, AttributeKind::real, colours,
                   [](const Colour& colour) { return std::array{colour.opacity}; });
}

/// The attributes of a mesh file as those of a mesh, with the names of mesh_attributes.h. Undefined where the file says
/// nothing.
MeshAttributes attributes_of_file(const SoupAttributes& given) {
  MeshAttributes attributes;
  if (!given.corner_textures.empty())
    attributes = attributes.with(MeshElement::halfedge, kTextureAttribute,
                                 corner_values(AttributeKind::pair, given.corner_textures, given.textures,
                                               [](const SoupAttributes::TextureCoordinate& texture) {
                                                 return std::span<const double>(texture);
                                               }));
  attributes =
      with_list(std::move(attributes), MeshElement::vertex, kTextureAttribute, AttributeKind::pair,
                given.point_textures, [](const SoupAttributes::TextureCoordinate& texture) { return texture; });
  attributes = with_list(std::move(attributes), MeshElement::vertex, kNormalAttribute, AttributeKind::vector,
                         given.point_normals, numbers_of_vector);
  attributes = with_colours(std::move(attributes), MeshElement::vertex, given.point_colours);
  attributes = with_colours(std::move(attributes), MeshElement::face, given.face_colours);
  std::array<double, 3> vector{};
  if (!given.corner_normals.empty())
    attributes = attributes.with(
        MeshElement::halfedge, kNormalAttribute,
        corner_values(AttributeKind::vector, given.corner_normals, given.normals, [&](const Vec3& normal) {
          vector = numbers_of_vector(normal);
          return std::span<const double>(vector);
        }));
  attributes = with_names(std::move(attributes), kGroupAttribute, given.groups);
  attributes = with_names(std::move(attributes), kObjectAttribute, given.objects);
  attributes = with_names(std::move(attributes), kMaterialAttribute, given.materials);
  return with_names(std::move(attributes), kMaterialLibraryAttribute, given.libraries);
}

/// The attributes of a mesh of one element, with their numbers put into a list of a file.
class PointLists {
 public:
  PointLists(const MeshAttributes& attributes, MeshElement element) : attributes_(attributes), element_(element) {}

  /// Calls put(entry, numbers) for each element with a value; the others keep `none`. Counts the attribute as written.
  template <typename Entry, typename Put>
  void fill(const char* name, AttributeKind kind, std::vector<Entry>& list, const Entry& none, Put put) {
    const AttributeValues* const values = find_values(attributes_, element_, name, kind);
    if (values == nullptr) return;
    ++written_;
    if (list.empty()) list.assign(values->size(), none);
    for (std::size_t i = 0; i < values->size(); ++i)
      if (values->is_defined(i)) put(list[i], values->numbers(i));
  }
  void fill_colours(std::vector<SoupAttributes::Colour>& colours) {
    using Colour = SoupAttributes::Colour;
    fill(kColourAttribute, AttributeKind::vector, colours, kNoColour, [](Colour& colour, std::span<const double> v) {
      colour.rgb = {v[0], v[1], v[2]};
    });
    if (colours.empty()) return;
    fill(kOpacityAttribute, AttributeKind::real, colours, kNoColour,
         [](Colour& colour, std::span<const double> v) { colour.opacity = v[0]; });
  }
  std::size_t written() const { return written_; }

  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  static constexpr SoupAttributes::Colour kNoColour{{kNoNumber, kNoNumber, kNoNumber}, kNoNumber};

 private:
  const MeshAttributes& attributes_;
  MeshElement element_;
  std::size_t written_ = 0;
};

/// For formats with attributes of points and colours of faces.
FileAttributes attributes_of_points(const MeshAttributes& attributes) {
  constexpr double kNoNumber = PointLists::kNoNumber;
  FileAttributes result;
  PointLists points(attributes, MeshElement::vertex), faces(attributes, MeshElement::face);
  points.fill(kNormalAttribute, AttributeKind::vector, result.attributes.point_normals,
              Vec3{kNoNumber, kNoNumber, kNoNumber}, [](Vec3& normal, std::span<const double> v) {
                normal = {v[0], v[1], v[2]};
              });
  points.fill(kTextureAttribute, AttributeKind::pair, result.attributes.point_textures,
              SoupAttributes::TextureCoordinate{kNoNumber, kNoNumber},
              [](SoupAttributes::TextureCoordinate& texture, std::span<const double> v) {
                texture = {v[0], v[1]};
              });
  points.fill_colours(result.attributes.point_colours);
  faces.fill_colours(result.attributes.face_colours);
  result.left_out = attributes.all().size() - points.written() - faces.written();
  return result;
}

/// For formats with attributes of corners. Equal texture coordinates and normals are written once.
FileAttributes attributes_of_corners(const MeshAttributes& attributes) {
  FileAttributes result;
  std::size_t written = 0;
  if (const auto* const textures =
          find_values(attributes, MeshElement::halfedge, kTextureAttribute, AttributeKind::pair)) {
    PointTable table;
    result.attributes.corner_textures = numbered(*textures, table);
    for (const Vec3& texture : std::move(table).take_doubles())
      result.attributes.textures.push_back({texture.x, texture.y});
    ++written;
  }
  if (const auto* const normals =
          find_values(attributes, MeshElement::halfedge, kNormalAttribute, AttributeKind::vector)) {
    PointTable table;
    result.attributes.corner_normals = numbered(*normals, table);
    result.attributes.normals = std::move(table).take_doubles();
    ++written;
  }
  const std::array<std::pair<const char*, SoupAttributes::FaceNames*>, 4> names{
      {{kGroupAttribute, &result.attributes.groups},
       {kObjectAttribute, &result.attributes.objects},
       {kMaterialAttribute, &result.attributes.materials},
       {kMaterialLibraryAttribute, &result.attributes.libraries}}};
  for (const auto& [name, target] : names)
    if (const auto* const texts = find_values(attributes, MeshElement::face, name, AttributeKind::text)) {
      *target = names_of(*texts);
      ++written;
    }
  result.left_out = attributes.all().size() - written;
  return result;
}

using mesh_formats::CoordinateRange;

Result<PolygonMesh> mesh_of(PolygonSoup soup, const std::string& name) {
  if (soup.corners.size() > PolygonMesh::kMaxHalfedges)
    return Error{ErrorCode::limit_exceeded, "{} corners of faces; a mesh may have {}", soup.corners.size(),
                 PolygonMesh::kMaxHalfedges}
        .about(name);
  return mesh_of_soup(std::move(soup));
}

Result<ImportedMesh> mesh3d_of(Result<MeshFacets> given, const std::string& name) {
  A3D_ASSIGN(MeshFacets read, std::move(given));
  ImportedMesh result;
  result.remarks = std::move(read.remarks);
  if (read.wrong_count) result.remarks.push_back(read.wrong_count->text());
  A3D_ASSIGN(PolygonSoup soup, polygons_of(std::move(read.facets), name));
  MeshAttributes attributes;
  if (soup.attributes != nullptr) attributes = attributes_of_file(*soup.attributes);
  soup.attributes.reset();
  A3D_ASSIGN(PolygonMesh mesh, mesh_of(std::move(soup), name));
  if (std::string text = nonmanifold_text(mesh); !text.empty()) result.remarks.push_back(std::move(text));
  result.mesh = Mesh3d(std::move(mesh), std::move(attributes));
  return result;
}

/// A fault of the file is an outcome; a fault of the statement stays an error.
Result<ImportedMesh> imported_or_refused(Result<ImportedMesh> read) {
  if (read.ok()) return read;
  if (read.error().code == ErrorCode::interrupted || read.error().code == ErrorCode::out_of_memory)
    return std::move(read).error();
  ImportedMesh result;
  result.refusal = std::move(read).error();
  return result;
}

PolygonSoup soup_of(const PolygonMesh& mesh) {
  PolygonSoup soup;
  soup.points = mesh.points().approx();
  soup.corners.assign(mesh.origins().begin(), mesh.origins().end());
  soup.face_starts.reserve(mesh.face_count() + 1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    soup.face_starts.push_back(soup.face_starts.back() + mesh.degree(FaceId(f)));
  }
  return soup;
}

mesh_formats::Facets facets_for(const mesh_formats::MeshFormat& format, PolygonSoup soup) {
  if (!format.stores_triangles) return soup;
  return triangles_of(std::move(soup));
}

std::size_t rounded_count(const PolygonMesh& mesh, CoordinateRange range) {
  if (range == CoordinateRange::doubles) return mesh.points().exact_count();
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    poll_interruption_at(v);
    const PointRef point = mesh.points()[v];
    const auto is_float = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
    const Vec3& p = point.approx;
    count += point.is_double() && is_float(p.x) && is_float(p.y) && is_float(p.z) ? 0 : 1;
  }
  return count;
}

/// Gives the soup the attributes that the format can hold; returns the number of the others.
std::size_t add_attributes(const MeshAttributes& attributes, const mesh_formats::MeshFormat& format,
                           PolygonSoup& soup) {
  using mesh_formats::AttributePlaces;
  if (attributes.is_empty() || format.attributes == AttributePlaces::none) return attributes.all().size();
  FileAttributes for_file = format.attributes == AttributePlaces::points ? attributes_of_points(attributes)
                                                                         : attributes_of_corners(attributes);
  soup.attributes = std::make_shared<const SoupAttributes>(std::move(for_file.attributes));
  return for_file.left_out;
}

/// The number of texts that a line of a file holds otherwise, or not at all.
std::size_t count_changed_texts(const SoupAttributes* attributes) {
  if (attributes == nullptr) return 0;
  std::size_t count = 0;
  for (const SoupAttributes::FaceNames* names : attributes->face_names())
    count += static_cast<std::size_t>(std::ranges::count_if(
        names->names, [](const std::string& name) { return name.empty() || one_line(name) != name; }));
  return count;
}

void report_rounding(Context& context, const std::string& command, const PolygonMesh& mesh, const std::string& file,
                     CoordinateRange range) {
  const std::size_t count = rounded_count(mesh, range);
  if (count == 0) return;
  context.diagnostics.report(fmt::format("{}: {} of {} vertices rounded to {}", command, count, mesh.vertex_count(),
                                         range == CoordinateRange::doubles ? "doubles" : "floats"),
                             file);
}

}  // namespace

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, const Monitor& monitor) {
  return imported_or_refused(mesh3d_of(read_mesh_facets(path, nullptr, monitor.cancel()), path.string()));
}

Result<ImportedMesh> import_mesh(std::string_view bytes, const std::string& name,
                                 const mesh_formats::MeshFormat* format, const Monitor& monitor) {
  return imported_or_refused(mesh3d_of(read_mesh_facets(bytes, name, format, monitor.cancel()), name));
}

Result<ExportedSolid> export_mesh(Context& context, const std::string& command, const Mesh3d& mesh,
                                  const std::string& name, const MeshDestination& to, const MeshFileForm& form) {
  A3D_TRY(context.check_cancelled());
  const std::string& file = to.name();
  PolygonSoup soup = soup_of(mesh.mesh());
  const std::size_t left_out = add_attributes(mesh.attributes(), *form.format, soup);
  const std::size_t changed_texts = count_changed_texts(soup.attributes.get());
  Status written = to.write(*form.format, facets_for(*form.format, std::move(soup)), name, form.encoding);
  if (!written) {
    if (written.error().code == ErrorCode::interrupted) return std::move(written).error();
    Error refusal = std::move(written).error().about(command);
    context.diagnostics.report(refusal.text(), {}, Diagnostics::About::unwritten);
    return ExportedSolid{std::move(refusal)};
  }
  if (left_out > 0)
    context.diagnostics.report(fmt::format("{}: {} not written", command, counted(left_out, "attribute")), file);
  if (changed_texts > 0)
    context.diagnostics.report(
        fmt::format("{}: {} changed: control characters become blanks, and outer blanks and empty texts are lost",
                    command, counted(changed_texts, "text")),
        file);
  report_rounding(context, command, mesh.mesh(), file, form.format->form(form.encoding)->coordinates);
  return ExportedSolid();
}

Result<ExportedSolid> export_mesh(Context& context, const std::string& command, const Mesh3d& mesh,
                                  const std::string& name, const std::string& file, const MeshFileForm& form) {
  A3D_ASSIGN(const MeshDestination to, MeshDestination::file(context, file));
  return export_mesh(context, command, mesh, name, to, form);
}

}  // namespace algebra3d
