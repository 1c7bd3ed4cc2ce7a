// exportSTL, exportOBJ, exportOFF.
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/number_text.h"
#include "algebra3d/base/polygon_soup.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/export_solid.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/repair/kept_shells.h"
#include "algebra3d/repair/rounded_solid.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "stl/obj_writer.h"
#include "stl/off_writer.h"
#include "stl/stl_writer.h"

namespace algebra3d {
namespace {

TriangleSoup triangle_soup_of(const TriangleMesh& mesh) {
  TriangleSoup soup;
  soup.triangles.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
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

bool refuse(Context& context, const std::string& reason) {
  context.diagnostics.report(reason, {}, Diagnostics::About::unwritten);
  return false;
}

/// Writes the rounded solid to the path.
using MeshWriter = std::function<Status(const std::filesystem::path& path, const TriangleMesh& mesh)>;

/// What a file can hold: the numbers and their name.
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
  Box3 box;
  for (const Vec3& point : mesh.points().approx()) box.extend(point);
  return box.is_empty() ? 0 : length(box.max - box.min);
}

/// What rounding did to the shape, if anybody would see it; else empty.
Result<std::string> visible_change(const Context& context, const TriangleMesh& solid, const RoundedSolid& rounded) {
  if (rounded.moved_vertices == 0) return std::string();
  ASSIGN_OR_RETURN(const double before, nearest_volume(solid, context.monitor()));
  ASSIGN_OR_RETURN(const double after, nearest_volume(*rounded.mesh, context.monitor()));
  const bool changes_volume = std::abs(after - before) > kVisiblePart * before;
  const bool loses_shells = rounded.shells_after < rounded.shells_before;
  const bool is_seen = rounded.largest_movement > kVisiblePart * diagonal_of(solid) || changes_volume || loses_shells;
  if (!is_seen && rounded.attempts_failed == 0) return std::string();
  std::string text = fmt::format("which moves the boundary by at most {}", real_text(rounded.largest_movement));
  if (!is_seen) text += " where it is crowded";
  if (changes_volume)
    text += fmt::format(" and makes the volume {} instead of {}", real_text(after), real_text(before));
  if (loses_shells) text += fmt::format(" and leaves {} of {} shells", rounded.shells_after, rounded.shells_before);
  return text;
}

/// FALSE, with a diagnostic, if the solid cannot be rounded or the file not be written.
Result<bool> export_rounded(Context& context, const std::string& name, const Volume3d& solid, const std::string& file,
                            const FileNumbers& numbers, const MeshWriter& write) {
  ASSIGN_OR_RETURN(const RoundedSolid rounded, rounded_solid(solid.mesh(), numbers.grid, context.cancel));
  const std::string rounding = fmt::format("{}: {}: rounded to {}, ", name, file, numbers.name);
  if (!rounded.mesh) return refuse(context, rounding + rounded.reason + numbers.advice);
  if (rounded.mesh->is_empty() && !solid.mesh().is_empty())
    return refuse(context, rounding + "nothing of the solid is left" + numbers.advice);
  ASSIGN_OR_RETURN(const std::string change, visible_change(context, solid.mesh(), rounded));
  if (!change.empty())
    context.diagnostics.report(fmt::format("{}: rounded to {}, {}{}", name, numbers.name, change, numbers.advice),
                               file);
  const Status written = write(context.resolve(file), *rounded.mesh);
  if (!written) return refuse(context, name + ": " + written.error().message);
  return true;
}

Result<bool> export_stl(Context& context, const std::optional<Volume3d>& solid, const std::optional<std::string>& name,
                        const std::optional<Text>& file, const std::optional<bool>& is_binary) {
  if (!solid) return refuse(context, "exportSTL: the solid is undefined");
  if (!name || !file || !is_binary) return refuse(context, "exportSTL: the name, the file or the format is undefined");
  return export_solid(context, "exportSTL", *solid, *name, file->content,
                      {stl::MeshFormat::stl, *is_binary ? stl::Format::binary : stl::Format::ascii});
}

Result<bool> export_obj(Context& context, const std::optional<Volume3d>& solid, const std::optional<std::string>& name,
                        const std::optional<Text>& file) {
  if (!solid) return refuse(context, "exportOBJ: the solid is undefined");
  if (!name || !file) return refuse(context, "exportOBJ: the name or the file is undefined");
  return export_solid(context, "exportOBJ", *solid, *name, file->content, {stl::MeshFormat::obj, stl::Format::ascii});
}

Result<bool> export_off(Context& context, const std::optional<Volume3d>& solid, const std::optional<Text>& file,
                        const std::optional<bool>& is_binary) {
  if (!solid) return refuse(context, "exportOFF: the solid is undefined");
  if (!file || !is_binary) return refuse(context, "exportOFF: the file or the format is undefined");
  return export_solid(context, "exportOFF", *solid, {}, file->content,
                      {stl::MeshFormat::off, *is_binary ? stl::Format::binary : stl::Format::ascii});
}

}  // namespace

Result<bool> export_solid(Context& context, const std::string& command, const Volume3d& solid, const std::string& name,
                          const std::string& file, const MeshFileForm& form) {
  const bool has_doubles = form.format == stl::MeshFormat::obj ||
                           (form.format == stl::MeshFormat::off && form.encoding == stl::Format::ascii);
  return export_rounded(context, command, solid, file, has_doubles ? doubles() : floats(),
                        [&](const std::filesystem::path& path, const TriangleMesh& mesh) {
                          if (form.format == stl::MeshFormat::stl)
                            return stl::write_stl_file(path, triangle_soup_of(mesh), name, form.encoding);
                          if (form.format == stl::MeshFormat::obj)
                            return stl::write_obj_file(path, polygon_soup_of(mesh), name);
                          return stl::write_off_file(path, polygon_soup_of(mesh), form.encoding);
                        });
}

void register_exports(Registry& registry) {
  registry.add({
      .name = "exportSTL",
      .syntax = "_ exportSTL[_, _, _]",
      .doc = "Writes a solid to an STL file with a name, in binary (TRUE) or ASCII; TRUE if the file was written.",
      .detail =
          "Coordinates are rounded to floats, as roundCoordinates does it: what is written is a valid solid. A "
          "diagnostic says how far the boundary moved and what became of the volume, if that is more than a ten "
          "thousandth of the diagonal or of the volume, if shells are gone, or if facets had to be divided. FALSE with "
          "a diagnostic if a coordinate is beyond the range of floats, if nothing of the solid is left, if an "
          "argument is undefined, or if the file cannot be written; a file that was there before is then left as it "
          "was.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&export_stl>("solid", "name", "file", "binary")},
      .examples = {{kUnitCube + R"( exportSTL["cube", 'no such folder/cube.stl', TRUE])", "FALSE"},
                   {kUndefinedSolid + R"( exportSTL["cube", 'cube.stl', TRUE])", "FALSE"}},
      .errors = {{"query " + kUnitCube + R"( exportSTL["cube", 'cube.stl'])",
                  "exportSTL: expected (volume3d string text bool), got (volume3d string text)"}},
  });
  registry.add({
      .name = "exportOBJ",
      .syntax = "_ exportOBJ[_, _]",
      .doc = "Writes a solid to a Wavefront OBJ file with a name; TRUE if the file was written.",
      .detail =
          "Corners that are no doubles are rounded, as roundCoordinates does it, and written with the digits that give "
          "the same doubles again: what is written is a valid solid. FALSE as exportSTL gives it.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&export_obj>("solid", "name", "file")},
      .examples = {{kUnitCube + R"( exportOBJ["cube", 'no such folder/cube.obj'])", "FALSE"},
                   {kUndefinedSolid + R"( exportOBJ["cube", 'cube.obj'])", "FALSE"}},
      .errors = {{"query " + kUnitCube + R"( exportOBJ['cube.obj'])",
                  "exportOBJ: expected (volume3d string text), got (volume3d text)"}},
  });
  registry.add({
      .name = "exportOFF",
      .syntax = "_ exportOFF[_, _]",
      .doc = "Writes a solid to an OFF file, in binary (TRUE) or ASCII; TRUE if the file was written.",
      .detail =
          "ASCII: corners that are no doubles are rounded, as roundCoordinates does it, and written with the digits "
          "that give the same doubles again; binary: rounded to floats. What is written is a valid solid. FALSE as "
          "exportSTL gives it.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&export_off>("solid", "file", "binary")},
      .examples = {{kUnitCube + " exportOFF['no such folder/cube.off', TRUE]", "FALSE"},
                   {kUndefinedSolid + " exportOFF['cube.off', FALSE]", "FALSE"}},
      .errors = {{"query " + kUnitCube + " exportOFF['cube.off']",
                  "exportOFF: expected (volume3d text bool), got (volume3d text)"}},
  });
}

}  // namespace algebra3d
