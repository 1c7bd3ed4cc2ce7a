// importSTL, checkSTL, importSurface, exportSTL.
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/number_text.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/import_solid.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/repair/rounded_solid.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "stl/stl_writer.h"

namespace algebra3d {
namespace {

Result<Maybe<Volume3d>> import_with(Context& context, const Text& file, const RepairOptions& options) {
  ASSIGN_OR_RETURN(ImportedSolid imported, import_solid(context.resolve(file.content), options, context.monitor()));
  for (const std::string& remark : imported.remarks) context.diagnostics.report("importSTL: " + remark, file.content);
  if (imported.solid) return Maybe<Volume3d>(*std::move(imported.solid));
  // The reader's messages name the file; those about the solid do not.
  const bool names_file = imported.status.find(file.content) != std::string::npos;
  return Maybe<Volume3d>(Undefined{names_file ? imported.status : file.content + ": " + imported.status});
}

Result<Maybe<Volume3d>> import_stl(Context& context, const Text& file) {
  return import_with(context, file, {});
}

Result<Maybe<Volume3d>> import_stl_as_told(Context& context, const Text& file, const Text& options) {
  const Result<RepairOptions> parsed = parse_repair_options(options.content);
  if (!parsed) return Error{ErrorCode::invalid_value, "importSTL: {}", parsed.error().message};
  return import_with(context, file, *parsed);
}

Result<Text> check_stl(Context& context, const Text& file) {
  ASSIGN_OR_RETURN(ImportedSolid imported,
                   import_solid(context.resolve(file.content), RepairOptions::strict(), context.monitor()));
  return Text{std::move(imported.status)};
}

Result<Maybe<Surface3d>> import_as_surface(Context& context, const Text& file) {
  ASSIGN_OR_RETURN(ImportedSurface imported, import_surface(context.resolve(file.content), context.monitor()));
  for (const std::string& remark : imported.remarks)
    context.diagnostics.report("importSurface: " + remark, file.content);
  if (imported.surface) return Maybe<Surface3d>(*std::move(imported.surface));
  return Maybe<Surface3d>(Undefined{imported.reason});
}

TriangleSoup soup_of(const TriangleMesh& mesh) {
  TriangleSoup soup;
  soup.triangles.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef corners = mesh.corners(FaceId(f));
    soup.triangles.push_back({corners[0].approx, corners[1].approx, corners[2].approx});
  }
  return soup;
}

bool refuse(Context& context, const std::string& reason) {
  context.diagnostics.report("exportSTL: " + reason);
  return false;
}

Result<bool> export_stl(Context& context, const std::optional<Volume3d>& solid, const std::optional<std::string>& name,
                        const std::optional<Text>& file, const std::optional<bool>& is_binary) {
  if (!solid) return refuse(context, "the solid is undefined");
  if (!name || !file || !is_binary) return refuse(context, "the name, the file or the format is undefined");
  ASSIGN_OR_RETURN(const RoundedSolid rounded, rounded_solid(solid->mesh(), CoordinateGrid::floats(), context.cancel));
  if (!rounded.mesh) return refuse(context, file->content + ": rounded to floats, " + rounded.reason);
  if (rounded.mesh->is_empty() && !solid->mesh().is_empty())
    return refuse(context, file->content + ": rounded to floats, nothing of the solid is left");
  if (rounded.attempts_failed > 0)
    context.diagnostics.report(
        fmt::format("exportSTL: rounded to floats, which moves the boundary by at most {} where it is crowded",
                    real_text(rounded.largest_movement)),
        file->content);
  const Status written = stl::write_stl_file(context.resolve(file->content), soup_of(*rounded.mesh), *name,
                                             *is_binary ? stl::Format::binary : stl::Format::ascii);
  if (!written) return refuse(context, written.error().message);
  return true;
}

}  // namespace

void register_files(Registry& registry) {
  registry.add({
      .name = "importSTL",
      .syntax = "importSTL(_ ...)",
      .doc = "The solid in an STL file, ASCII or binary, repaired where it is none.",
      .detail =
          "Equal corners are welded, and a solid that is inside out is turned right side out; what is then a valid "
          "solid is accepted as it is, with its triangles in spatial order. Everything else is repaired: a diagnostic "
          "says what was changed and how far from the facets, repairReport says more. What cannot be repaired, a "
          "missing "
          "or malformed file too, is undefined, with the defects and the reason. A file without facets is the empty "
          "solid. Options, separated by semicolons: `cracks=0.001` (vertices on open edges that are closer are joined; "
          "by "
          "default 1e-4 of the diagonal), `holes=20` (diameter of the largest hole that is closed; by default all "
          "are), "
          "`cavities=drop` (they are filled), `smallest=0.5` (bodies and cavities with less volume are left out), "
          "`work=500` (million pairs of near triangles, after which a file is given up), `strict` (no repair). "
          "Relative "
          "names start at the folder of the session.",
      .exactness = Exactness::reported,
      .overloads = {overload<&import_stl>("file"), overload<&import_stl_as_told>("file", "options")},
      .examples = {{"isEmpty(importSTL('no such file.stl'))", "TRUE"},
                   {"importSTL('no such file.stl')", "undefined"},
                   {"importSTL([const text value undefined])", "undefined"}},
      .errors = {{R"(query importSTL("part.stl"))", "importSTL: expected (text) or (text text), got (string)"},
                 {"query importSTL('part.stl', 'cracks=wide')",
                  "importSTL: option 'cracks' is 'wide'; expected a number that is not negative"}},
  });
  registry.add({
      .name = "checkSTL",
      .syntax = "checkSTL(_)",
      .doc = "What an STL file is without repair: 'ok', or the defects that make it no valid solid.",
      .detail = "Counts each kind of defect, and says where the first one is. Nothing is repaired.",
      .exactness = Exactness::exact,
      .overloads = {overload<&check_stl>("file")},
      .examples = {{"checkSTL([const text value undefined])", "undefined"}},
  });
  registry.add({
      .name = "importSurface",
      .syntax = "importSurface(_)",
      .doc = "The surface in an STL file.",
      .detail = "Equal corners are welded and facets without area dropped; facets that pass through each other, lie "
                "upon each "
                "other or touch an edge in its middle are divided there, and what several cover is there once. Nothing "
                "moves, "
                "and no hole is closed. Undefined, with the reason, for a file that cannot be read.",
      .exactness = Exactness::exact,
      .overloads = {overload<&import_as_surface>("file")},
      .examples = {{"importSurface('no such file.stl')", "undefined"},
                   {"importSurface([const text value undefined])", "undefined"}},
  });
  registry.add({
      .name = "exportSTL",
      .syntax = "_ exportSTL[_, _, _]",
      .doc = "Writes a solid to an STL file with a name, in binary (TRUE) or ASCII; TRUE if the file was written.",
      .detail =
          "Coordinates are rounded to floats, as roundCoordinates does it: what is written is a valid solid. FALSE "
          "with a diagnostic if a coordinate is beyond the range of floats, if nothing of the solid is left, if an "
          "argument is undefined, or if the "
          "file cannot be written; a file that was there before is then left as it was.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&export_stl>("solid", "name", "file", "binary")},
      .examples = {{kUnitCube + R"( exportSTL["cube", 'no such folder/cube.stl', TRUE])", "FALSE"},
                   {R"([const volume3d value undefined] exportSTL["cube", 'cube.stl', TRUE])", "FALSE"}},
      .errors = {{"query " + kUnitCube + R"( exportSTL["cube", 'cube.stl'])",
                  "exportSTL: expected (volume3d string text bool), got (volume3d string text)"}},
  });
}

}  // namespace algebra3d
