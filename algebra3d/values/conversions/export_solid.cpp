#include "algebra3d/values/conversions/export_solid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>

#include <fmt/format.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/repair/mesh_volume.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/divided_contacts.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/validity/contacts.h"
#include "algebra3d/kernel/validity/edge_contacts.h"
#include "base/diagnostics.h"
#include "base/interruption_scope.h"
#include "base/mesh_content.h"
#include "base/number_text.h"
#include "base/polygon_soup.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

TriangleSoup triangle_soup_of(const TriangleMesh& mesh) {
  TriangleSoup soup;
  soup.triangles.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const TriangleRef corners = mesh.corners(FaceId(f));
    soup.triangles.push_back({corners[0].approx, corners[1].approx, corners[2].approx});
  }
  return soup;
}

PolygonSoup polygon_soup_of(const TriangleMesh& mesh) {
  PolygonSoup soup;
  soup.points = mesh.points().approx();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) soup.add_face(mesh.triangle(FaceId(f)));
  return soup;
}

ExportedSolid refuse(Context& context, Error reason) {
  context.diagnostics.report(reason.text(), {}, Diagnostics::About::unwritten);
  return {std::move(reason)};
}

/// Writes the rounded solid.
using MeshWriter = std::function<Status(const TriangleMesh& mesh)>;

/// The numbers that a file can hold, and their name.
struct FileNumbers {
  CoordinateGrid grid;
  const char* name;
  const char* advice;  ///< what else can be done if the shape changes
};

FileNumbers floats() {
  return {CoordinateGrid::floats(), "floats", "; exportOBJ and exportOFF in ASCII keep doubles"};
}
FileNumbers doubles() {
  return {CoordinateGrid::doubles(), "doubles", ""};
}

/// A boundary that moves by more than this part of the diagonal, or a volume that changes by more than this part, is
/// seen; floats alone are some thousand times finer where a solid lies about its origin.
constexpr double kVisiblePart = 1e-4;

double diagonal_of(const TriangleMesh& mesh) {
  const Box3 box = Box3::around(mesh.points().approx());
  return box.is_empty() ? 0 : length(box.max - box.min);
}

/// The visible changes of the shape by rounding; empty if there are none.
Result<std::string> visible_change(const Context& context, const TriangleMesh& solid, const RoundedSolid& rounded) {
  if (rounded.moved_vertices == 0) return std::string();
  A3D_ASSIGN(const double before, nearest_volume(solid, context.monitor()));
  A3D_ASSIGN(const double after, nearest_volume(*rounded.mesh, context.monitor()));
  const bool changes_volume = std::abs(after - before) > kVisiblePart * before;
  const bool loses_shells = rounded.shells_after < rounded.shells_before;
  const bool is_seen = rounded.largest_movement > kVisiblePart * diagonal_of(solid) || changes_volume || loses_shells;
  if (!is_seen && rounded.reach == 0) return std::string();
  const std::string distance = rounded.largest_movement > 0 ? "which moves the remaining boundary by at most " +
                                                                  real_text(rounded.largest_movement)
                                                            : "which does not move the remaining boundary";
  std::string text = fmt::format("{} ({})", distance, name_of(rounded.method));
  if (changes_volume)
    text += fmt::format(" and makes the volume {} instead of {}", real_text(after), real_text(before));
  if (loses_shells) text += "; " + shells_text(rounded);
  return text;
}

/// A mesh that touches itself in corners only, but for some pairs of edges that cross.
struct DividedMesh {
  TriangleMesh mesh;
  std::ptrdiff_t contacts_left = 0;  ///< these, in points that are not on the grid
};

/// Many programs take vertices inside edges or faces of others for crossings, and edges that touch, too.
Result<DividedMesh> divided_where_it_touches(const TriangleMesh& mesh, const CoordinateGrid& grid,
                                             const std::atomic<bool>* cancel) {
  A3D_ASSIGN(FacePairs touching, touching_faces(mesh, cancel));
  if (touching.empty()) return DividedMesh{mesh};
  const TriangleMesh divided = divided_at_contacts(mesh, vertex_contacts(mesh, touching));
  A3D_ASSIGN(touching, touching_faces(divided, cancel));
  const std::vector<EdgeContact> at_edges = edge_contacts(divided, touching);
  const auto is_left = [&](const EdgeContact& contact) { return !is_on_grid(contact.point, grid); };
  return DividedMesh{divided_at_edge_contacts(divided, at_edges, grid), std::ranges::count_if(at_edges, is_left)};
}

Result<ExportedSolid> export_rounded(Context& context, const std::string& name, const Volume3d& solid,
                                     const std::string& file, const FileNumbers& numbers, const MeshWriter& write) {
  A3D_ASSIGN(const RoundedSolid rounded, rounded_solid(solid.mesh(), numbers.grid, context.monitor()));
  const std::string rounding = fmt::format("{}: {}: rounded to {}, ", name, file, numbers.name);
  if (!rounded.mesh) return refuse(context, {ErrorCode::invalid_value, rounding + rounded.reason + numbers.advice});
  if (rounded.mesh->is_empty() && !solid.mesh().is_empty())
    return refuse(context, {ErrorCode::invalid_value, rounding + "nothing of the solid is left" + numbers.advice});
  A3D_ASSIGN(const std::string change, visible_change(context, solid.mesh(), rounded));
  if (!change.empty())
    context.diagnostics.report(fmt::format("{}: rounded to {}, {}{}", name, numbers.name, change, numbers.advice),
                               file);
  A3D_ASSIGN(const DividedMesh divided, divided_where_it_touches(*rounded.mesh, numbers.grid, context.cancel));
  if (divided.contacts_left > 0)
    context.diagnostics.report(
        fmt::format("{}: {} in points that are not {}: other programs may take them for crossings", name,
                    divided.contacts_left == 1 ? "1 pair of edges crosses"
                                               : fmt::format("{} pairs of edges cross", divided.contacts_left),
                    numbers.name),
        file);
  Status written = write(divided.mesh);
  if (!written && written.error().code == ErrorCode::interrupted) return std::move(written).error();
  if (!written) return refuse(context, std::move(written).error().about(name));
  return ExportedSolid();
}

}  // namespace

Result<ExportedSolid> export_solid(Context& context, const std::string& command, const Volume3d& solid,
                                   const std::string& name, const MeshDestination& to, const MeshFileForm& form) {
  const mesh_formats::MeshFormat& format = *form.format;
  const bool has_floats = format.form(form.encoding)->coordinates == mesh_formats::CoordinateRange::floats;
  return export_rounded(
      context, command, solid, to.name(), has_floats ? floats() : doubles(), [&](const TriangleMesh& mesh) {
        const mesh_formats::Facets facets = format.stores_triangles ? mesh_formats::Facets(triangle_soup_of(mesh))
                                                                    : mesh_formats::Facets(polygon_soup_of(mesh));
        return to.write(format, facets, name, form.encoding);
      });
}

Result<ExportedSolid> export_solid(Context& context, const std::string& command, const Volume3d& solid,
                                   const std::string& name, const std::string& file, const MeshFileForm& form) {
  A3D_ASSIGN(const MeshDestination to, MeshDestination::file(context, file));
  return export_solid(context, command, solid, name, to, form);
}

}  // namespace algebra3d
