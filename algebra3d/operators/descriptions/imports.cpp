// importSTL, importOBJ, importOFF (one operator for each format of mesh files), checkSTL, importSurface, importMesh.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

using mesh_formats::MeshFormat;

std::string operator_name(const MeshFormat& format) {
  return "import" + std::string(format.name);
}

Result<Maybe<Volume3d>> import_with(Context& context, const MeshFormat& format, const Text& file,
                                    const RepairOptions& options) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedSolid imported, import_solid(path, &format, options, context.monitor()));
  for (const std::string& remark : imported.remarks)
    context.diagnostics.report(operator_name(format) + ": " + remark, file.content);
  if (imported.solid) return Maybe<Volume3d>(*std::move(imported.solid));
  return Maybe<Volume3d>(Undefined{imported.text_about(file.content)});
}

/// `given`: the file, and perhaps options.
Result<Outcome> import_as(const MeshFormat& format, std::span<const Value> given, Context& context) {
  RepairOptions options;
  if (given.size() > 1) {
    Result<RepairOptions> parsed = parse_repair_options(given[1].get<Text>().content);
    if (!parsed) return std::move(parsed).error().about(operator_name(format));
    options = *std::move(parsed);
  }
  A3D_ASSIGN(Maybe<Volume3d> solid, import_with(context, format, given[0].get<Text>(), options));
  if (!solid) return Outcome(Undefined{solid.reason()});
  return Outcome(Value::of<Volume3d>(*std::move(solid)));
}

Overload import_overload(const MeshFormat& format, bool has_options) {
  Overload overload;
  overload.parameters = {{"file", &TypeOf<Text>::type()}};
  if (has_options) overload.parameters.push_back({"options", &TypeOf<Text>::type()});
  overload.result = &TypeOf<Volume3d>::type();
  overload.function = [&format](std::span<const Value> given, Context& context) {
    return import_as(format, given, context);
  };
  return overload;
}

Result<Text> check_stl(Context& context, const Text& file) {
  const MeshFormat* const stl = mesh_formats::known_mesh_formats().named("STL");
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedSolid imported, import_solid(path, stl, RepairOptions::strict(), context.monitor()));
  return Text{context.folder.with_names(imported.text())};
}

Result<Maybe<Surface3d>> import_as_surface(Context& context, const Text& file) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedSurface imported, import_surface(path, context.monitor()));
  for (const std::string& remark : imported.remarks)
    context.diagnostics.report("importSurface: " + remark, file.content);
  if (imported.surface) return Maybe<Surface3d>(*std::move(imported.surface));
  return Maybe<Surface3d>(Undefined{imported.refusal->text()});
}

Result<Maybe<Mesh3d>> import_as_mesh(Context& context, const Text& file) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedMesh imported, import_mesh(path, context.monitor()));
  for (const std::string& remark : imported.remarks) context.diagnostics.report("importMesh: " + remark, file.content);
  if (imported.mesh) return Maybe<Mesh3d>(*std::move(imported.mesh));
  return Maybe<Mesh3d>(Undefined{imported.refusal->text()});
}

constexpr const char* kRepairDetail =
    "Equal corners are welded, and a solid that is inside out is flipped; a valid solid is then accepted, with its "
    "triangles in spatial order. All others are repaired: a diagnostic reports the changes, and the areas that were "
    "left out and added, with distances; `repairReport` has the details. Undefined, with the defects and the reason, "
    "if the repair fails or the file is missing or malformed. A file that is clearly of another format is read as "
    "that, with a diagnostic. A file without triangles, or without area, is the empty solid. Options, separated by "
    "semicolons: `gaps=0.001` (gaps up to this width are stitched; by default 1e-4 of the diagonal), `holes=20` "
    "(diameter of the largest hole to close; by default all are closed), `cavities=drop` (cavities are filled), "
    "`smallest=0.5` (bodies and cavities with less volume are removed), `dropped=0.9` (no solid if a larger part of "
    "the area seen would be left out), `added=0.2` (no solid if more than that part of it would be added; by default "
    "any), `work=500` (limit of the work, in million pairs of near triangles), `strict` (no repair, and a binary STL "
    "file with a wrong count of triangles in its header is refused). Polygons that are not planar are reported. "
    "Relative names start at the working folder.";

void register_import(Registry& registry, const MeshFormat& format) {
  const std::string name = operator_name(format);
  const std::string ending(format.endings.front());
  const std::string missing = "'no such file" + ending + "'";
  registry.add({
      .name = name,
      .syntax = name + "(_ ...)",
      .doc = fmt::format("The solid in {}{}{}, repaired if necessary.", format.title, format.variants,
                         format.stores_triangles ? "" : ", its polygons triangulated"),
      .detail = kRepairDetail,
      .exactness = Exactness::reported,
      .is_pure = false,
      .reads_files = true,
      .overloads = {import_overload(format, false), import_overload(format, true)},
      .examples = {{{missing}, "TRUE", "(isEmpty _)"},
                   {{missing}, "undefined"},
                   {{missing, "'gaps=0.001; strict'"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, name + ": expected (text) or (text text), got (int)"},
                 {{"'part" + ending + "'", "'gaps=wide'"},
                  name + ": option 'gaps' is 'wide'; expected a number of at least 0 without a unit"}},
  });
}

}  // namespace

void register_imports(Registry& registry) {
  const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
  for (const MeshFormat& format : formats) register_import(registry, format);
  registry.add({
      .name = "checkSTL",
      .syntax = "checkSTL(_)",
      .doc = "The defects of an STL file without repair, or 'ok' if it is a valid solid.",
      .detail =
          "Counts each kind of defect and gives the place of the first one. Also reports a count of triangles in the "
          "header of a binary file that contradicts the file's size.",
      .exactness = Exactness::exact,
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&check_stl>("file")},
      .examples = {{{"'no such file.stl'"}, "TRUE", "(contains _ 'No such file')"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "checkSTL: expected (text), got (int)"}},
  });
  registry.add({
      .name = "importSurface",
      .syntax = "importSurface(_)",
      .doc = "The surface in an " + formats.names("or") + " file.",
      .detail =
          "Equal corners are welded and degenerate triangles dropped; triangles that cross, overlap or touch an edge "
          "in its middle are divided there, and overlaps are kept once. Nothing moves, and no hole is closed. "
          "Undefined, with the reason, for a file that cannot be read, and where the work limit of solids, 500, is "
          "met. The format is detected from the content of "
          "the file and, if that is ambiguous, from its name.",
      .exactness = Exactness::exact,
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&import_as_surface>("file")},
      .examples = {{{"'no such file.stl'"}, "FALSE", "(isdefined _)"},
                   {{"'no such file.stl'"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "importSurface: expected (text), got (int)"}},
  });
  registry.add({
      .name = "importMesh",
      .syntax = "importMesh(_)",
      .doc = "The vertices and polygons in an " + formats.names("or") + " file, as they are.",
      .detail =
          "Vertices and faces keep their order; equal corners of the triangles of an STL file become one vertex. "
          "Nothing is repaired: a diagnostic counts non-manifold edges and vertices. Undefined, with the reason, for a "
          "file that cannot be read. The format is detected from the content of the file and, if that is ambiguous, "
          "from its name.",
      .exactness = Exactness::exact,
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&import_as_mesh>("file")},
      .examples = {{{"'no such file.obj'"}, "FALSE", "(isdefined _)"},
                   {{"'no such file.obj'"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "importMesh: expected (text), got (int)"}},
  });
}

}  // namespace algebra3d
