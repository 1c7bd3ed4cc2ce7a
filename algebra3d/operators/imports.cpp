// importSTL, importOBJ, importOFF, checkSTL, importSurface.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "algebra3d/operators/all.h"
#include "algebra3d/operators/import_solid.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {
namespace {

using stl::MeshFormat;

std::string operator_name(MeshFormat format) {
  return "import" + std::string(name_of(format));
}

Result<Maybe<Volume3d>> import_with(Context& context, MeshFormat format, const Text& file,
                                    const RepairOptions& options) {
  const std::filesystem::path path = context.resolve(file.content);
  ASSIGN_OR_RETURN(ImportedSolid imported, import_solid(path, format, options, context.monitor()));
  for (const std::string& remark : imported.remarks)
    context.diagnostics.report(operator_name(format) + ": " + remark, file.content);
  if (imported.solid) return Maybe<Volume3d>(*std::move(imported.solid));
  // The reader's messages name the file; those about the solid do not.
  const bool names_file = imported.status.starts_with(path.string());
  return Maybe<Volume3d>(Undefined{names_file ? imported.status : file.content + ": " + imported.status});
}

template <MeshFormat kFormat>
Result<Maybe<Volume3d>> import_file(Context& context, const Text& file) {
  return import_with(context, kFormat, file, {});
}

template <MeshFormat kFormat>
Result<Maybe<Volume3d>> import_as_told(Context& context, const Text& file, const Text& options) {
  const Result<RepairOptions> parsed = parse_repair_options(options.content);
  if (!parsed) return Error{ErrorCode::invalid_value, "{}: {}", operator_name(kFormat), parsed.error().message};
  return import_with(context, kFormat, file, *parsed);
}

Result<Text> check_stl(Context& context, const Text& file) {
  ASSIGN_OR_RETURN(ImportedSolid imported, import_solid(context.resolve(file.content), MeshFormat::stl,
                                                        RepairOptions::strict(), context.monitor()));
  return Text{std::move(imported.status)};
}

Result<Maybe<Surface3d>> import_as_surface(Context& context, const Text& file) {
  ASSIGN_OR_RETURN(ImportedSurface imported, import_surface(context.resolve(file.content), context.monitor()));
  for (const std::string& remark : imported.remarks)
    context.diagnostics.report("importSurface: " + remark, file.content);
  if (imported.surface) return Maybe<Surface3d>(*std::move(imported.surface));
  return Maybe<Surface3d>(Undefined{imported.reason});
}

constexpr const char* kRepairDetail =
    "Equal corners are welded, and a solid that is inside out is turned right side out; what is then a valid solid is "
    "accepted as it is, with its triangles in spatial order. Everything else is repaired: a diagnostic says what was "
    "changed, what was left out and added, and how far that is away, and `repairReport` says more. What cannot be "
    "repaired, a missing or "
    "malformed "
    "file too, is undefined, with the defects and the reason. A content that is without doubt of another of the three "
    "formats is read as what it is, and a diagnostic says so. A file without facets, or of which none has an area, is "
    "the empty solid. Options, "
    "separated by semicolons: `cracks=0.001` (vertices on open edges that are closer are joined; by default 1e-4 of "
    "the "
    "diagonal), `holes=20` (diameter of the largest hole that is closed; by default all are), `cavities=drop` (they "
    "are "
    "filled), `smallest=0.5` (bodies and cavities with less volume are left out), `dropped=0.9` (where a larger part "
    "of "
    "the area seen would be left out, there is no solid), `work=500` (million pairs of near "
    "triangles, after which a file is given up), `strict` (what is no solid is not repaired, and a binary STL file "
    "whose "
    "header announces another count of triangles than it has is refused). Relative names start at "
    "the folder of the "
    "session.";

template <MeshFormat kFormat>
void register_import(Registry& registry, const std::string& doc, const std::string& ending) {
  const std::string name = operator_name(kFormat);
  const std::string missing = name + "('no such file" + ending + "')";
  registry.add({
      .name = name,
      .syntax = name + "(_ ...)",
      .doc = doc,
      .detail = kRepairDetail,
      .exactness = Exactness::reported,
      .reads_file = true,
      .overloads = {overload<&import_file<kFormat>>("file"), overload<&import_as_told<kFormat>>("file", "options")},
      .examples = {{"isEmpty(" + missing + ")", "TRUE"},
                   {missing, "undefined"},
                   {name + "('no such file" + ending + "', 'cracks=0.001; strict')", "undefined"},
                   {name + "([const text value undefined])", "undefined"}},
      .errors = {{"query " + name + "(5)", name + ": expected (text) or (text text), got (int)"},
                 {"query " + name + "('part" + ending + "', 'cracks=wide')",
                  name + ": option 'cracks' is 'wide'; expected a number from 0 on, without a unit"}},
  });
}

}  // namespace

void register_imports(Registry& registry) {
  register_import<MeshFormat::stl>(registry, "The solid in an STL file, ASCII or binary, repaired where it is none.",
                                   ".stl");
  register_import<MeshFormat::obj>(
      registry, "The solid in a Wavefront OBJ file, its polygons triangulated, repaired where it is none.", ".obj");
  register_import<MeshFormat::off>(
      registry,
      "The solid in an OFF file (also COFF, NOFF, binary ones), its polygons triangulated, repaired where it is none.",
      ".off");
  registry.add({
      .name = "checkSTL",
      .syntax = "checkSTL(_)",
      .doc = "What an STL file is without repair: 'ok', or the defects that make it no valid solid.",
      .detail =
          "Counts each kind of defect, and says where the first one is. A count of triangles in the header of a binary "
          "file that contradicts the file's size is told, too. Nothing is repaired.",
      .exactness = Exactness::exact,
      .overloads = {overload<&check_stl>("file")},
      .examples = {{"checkSTL('no such file.stl') contains 'No such file'", "TRUE"},
                   {"checkSTL([const text value undefined])", "undefined"}},
      .errors = {{"query checkSTL(5)", "checkSTL: expected (text), got (int)"}},
  });
  registry.add({
      .name = "importSurface",
      .syntax = "importSurface(_)",
      .doc = "The surface in an STL, OBJ or OFF file.",
      .detail =
          "Equal corners are welded and facets without area dropped; facets that pass through each other, lie upon "
          "each "
          "other or touch an edge in its middle are divided there, and what several cover is there once. Nothing "
          "moves, "
          "and no hole is closed. Undefined, with the reason, for a file that cannot be read. The content of the file "
          "says which format it has or, if that leaves doubts, its name.",
      .exactness = Exactness::exact,
      .reads_file = true,
      .overloads = {overload<&import_as_surface>("file")},
      .examples = {{"isdefined(importSurface('no such file.stl'))", "FALSE"},
                   {"importSurface('no such file.stl')", "undefined"},
                   {"importSurface([const text value undefined])", "undefined"}},
      .errors = {{"query importSurface(5)", "importSurface: expected (text), got (int)"}},
  });
}

}  // namespace algebra3d
