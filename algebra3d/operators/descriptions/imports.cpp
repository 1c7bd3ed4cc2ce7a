// importSTL, importOBJ, importOFF (one operator for each format of mesh files), checkSTL, importSurface, importMesh.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/file_bytes.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/bytes.h"
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

// The solid that was imported from a file or from bytes of this name.

Maybe<Volume3d> reported_solid(Context& context, const std::string& op, ImportedSolid imported,
                               const std::string& name) {
  for (const std::string& remark : imported.remarks) context.diagnostics.report(op + ": " + remark, name);
  if (imported.solid) return *std::move(imported.solid);
  return Undefined{imported.text_about(name)};
}

Maybe<Surface3d> reported_surface(Context& context, ImportedSurface imported, const std::string& name) {
  for (const std::string& remark : imported.remarks) context.diagnostics.report("importSurface: " + remark, name);
  if (imported.surface) return *std::move(imported.surface);
  return Undefined{imported.refusal->text()};
}

Maybe<Mesh3d> reported_mesh(Context& context, ImportedMesh imported, const std::string& name) {
  for (const std::string& remark : imported.remarks) context.diagnostics.report("importMesh: " + remark, name);
  if (imported.mesh) return *std::move(imported.mesh);
  return Undefined{imported.refusal->text()};
}

Result<Maybe<Volume3d>> import_with(Context& context, const MeshFormat& format, const Value& given,
                                    const RepairOptions& options) {
  if (&given.type() == &TypeOf<Bytes>::type()) {
    A3D_ASSIGN(ImportedSolid imported, solid_of_bytes(context, given.get<Bytes>(), &format, options));
    return reported_solid(context, operator_name(format), std::move(imported), kBytesName);
  }
  const std::string& file = given.get<Text>().content;
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file));
  A3D_ASSIGN(ImportedSolid imported, import_solid(path, &format, options, context.monitor()));
  return reported_solid(context, operator_name(format), std::move(imported), file);
}

/// `given`: the file or its bytes, and perhaps options.
Result<Outcome> import_as(const MeshFormat& format, std::span<const Value> given, Context& context) {
  RepairOptions options;
  if (given.size() > 1) {
    Result<RepairOptions> parsed = parse_repair_options(given[1].get<Text>().content);
    if (!parsed) return std::move(parsed).error().about(operator_name(format));
    options = *std::move(parsed);
  }
  A3D_ASSIGN(Maybe<Volume3d> solid, import_with(context, format, given[0], options));
  if (!solid) return Outcome(Undefined{solid.reason()});
  return Outcome(Value::of<Volume3d>(*std::move(solid)));
}

template <typename T>
Overload import_overload(const MeshFormat& format, bool has_options) {
  Overload overload;
  overload.parameters = {{std::is_same_v<T, Bytes> ? "bytes" : "file", &TypeOf<T>::type()}};
  if (has_options) overload.parameters.push_back({"options", &TypeOf<Text>::type()});
  overload.result = &TypeOf<Volume3d>::type();
  overload.function = [&format](std::span<const Value> given, Context& context) {
    return import_as(format, given, context);
  };
  return std::is_same_v<T, Bytes> ? without_files(std::move(overload), Cost::arrangement) : overload;
}

const MeshFormat* stl_format() {
  return mesh_formats::known_mesh_formats().named("STL");
}

Result<Text> check_stl(Context& context, const Text& file) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedSolid imported, import_solid(path, stl_format(), RepairOptions::strict(), context.monitor()));
  return Text{context.folder.with_names(imported.text())};
}

Result<Text> check_stl_bytes(Context& context, const Bytes& bytes) {
  A3D_ASSIGN(ImportedSolid imported, solid_of_bytes(context, bytes, stl_format(), RepairOptions::strict()));
  return Text{imported.text()};
}

Result<Maybe<Surface3d>> import_as_surface(Context& context, const Text& file) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedSurface imported, import_surface(path, context.monitor()));
  return reported_surface(context, std::move(imported), file.content);
}

Result<Maybe<Surface3d>> import_bytes_as_surface(Context& context, const Bytes& bytes) {
  A3D_ASSIGN(ImportedSurface imported,
             import_surface(read_mesh(bytes.content, kBytesName, nullptr, context.cancel), context.monitor()));
  return reported_surface(context, std::move(imported), kBytesName);
}

Result<Maybe<Mesh3d>> import_as_mesh(Context& context, const Text& file) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(file.content));
  A3D_ASSIGN(ImportedMesh imported, import_mesh(path, context.monitor()));
  return reported_mesh(context, std::move(imported), file.content);
}

Result<Maybe<Mesh3d>> import_bytes_as_mesh(Context& context, const Bytes& bytes) {
  A3D_ASSIGN(ImportedMesh imported, import_mesh(bytes.content, kBytesName, nullptr, context.monitor()));
  return reported_mesh(context, std::move(imported), kBytesName);
}

/// Errors: invalid_value for a format that there is not.
Result<Maybe<Mesh3d>> import_bytes_of_format(Context& context, const Bytes& bytes, const Text& name) {
  const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
  const auto is_named = [&](const MeshFormat& format) {
    return format.name == name.content || is_equal_but_for_case(format.name, name.content);
  };
  const auto format = std::find_if(formats.begin(), formats.end(), is_named);
  if (format == formats.end())
    return Error{ErrorCode::invalid_value, "importMesh: expected the format {}, got '{}'", formats.names("or"),
                 name.content};
  A3D_ASSIGN(ImportedMesh imported, import_mesh(bytes.content, kBytesName, &*format, context.monitor()));
  return reported_mesh(context, std::move(imported), kBytesName);
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
    "Relative names start at the working folder. Bytes are the content of such a file.";

const std::string kUndefinedBytes = "(bytes undefined)";
const std::string kQuadFaces = "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))";
const std::string kQuad = "(mesh3d " + kQuadFaces + ")";

void register_import(OperatorGroup& group, const MeshFormat& format) {
  const std::string name = operator_name(format);
  const std::string ending(format.endings.front());
  const std::string missing = "'no such file" + ending + "'";
  group.add({
      .name = name,
      .syntax = name + "(_ ...)",
      .doc = fmt::format("The solid in {}{}{}, repaired if necessary.", format.title, format.variants,
                         format.stores_triangles ? "" : ", its polygons triangulated"),
      .detail = kRepairDetail,
      .exactness = Exactness::reported,
      .is_pure = false,
      .reads_files = true,
      .overloads = {import_overload<Text>(format, false), import_overload<Text>(format, true),
                    import_overload<Bytes>(format, false), import_overload<Bytes>(format, true)},
      .examples = {{{missing}, "TRUE", "(isEmpty _)"},
                   {{missing}, "undefined"},
                   {{missing, "'gaps=0.001; strict'"}, "undefined"},
                   {{fmt::format("(to{} {})", format.name, kUnitCube)}, "1.0", "(volume _)"},
                   {{"(hex2bytes '666f6f')", "'strict'"}, "undefined"},
                   {{kUndefinedBytes}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, name + ": expected (text), (text text), (bytes) or (bytes text), got (int)"},
                 {{"'part" + ending + "'", "'gaps=wide'"},
                  name + ": option 'gaps' is 'wide'; expected a number of at least 0 without a unit"}},
  });
}

}  // namespace

void register_imports(OperatorGroup& group) {
  const mesh_formats::MeshFormats& formats = mesh_formats::known_mesh_formats();
  for (const MeshFormat& format : formats) register_import(group, format);
  group.add({
      .name = "checkSTL",
      .syntax = "checkSTL(_)",
      .doc = "The defects of an STL file without repair, or 'ok' if it is a valid solid.",
      .detail =
          "Counts each kind of defect and gives the place of the first one. Also reports a count of triangles in the "
          "header of a binary file that contradicts the file's size.",
      .exactness = Exactness::exact,
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&check_stl>("file"),
                    without_files(overload<&check_stl_bytes>("bytes"), Cost::arrangement)},
      .examples = {{{"'no such file.stl'"}, "TRUE", "(contains _ 'No such file')"},
                   {{"(toSTL " + kUnitCube + ")"}, "'ok'"},
                   {{"(hex2bytes '')"}, "'the bytes: empty file; expected an STL file'"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "checkSTL: expected (text) or (bytes), got (int)"}},
  });
  group.add({
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
      .overloads = {overload<&import_as_surface>("file"),
                    without_files(overload<&import_bytes_as_surface>("bytes"), Cost::arrangement)},
      .examples = {{{"'no such file.stl'"}, "FALSE", "(isdefined _)"},
                   {{"'no such file.stl'"}, "undefined"},
                   {{"(toSTL (surface3d (((0 0 0) (1 0 0) (0 1 0)))))"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "importSurface: expected (text) or (bytes), got (int)"}},
  });
  group.add({
      .name = "importMesh",
      .syntax = "importMesh(_ ...)",
      .doc = "The vertices and polygons in an " + formats.names("or") + " file, as they are.",
      .detail =
          "Vertices and faces keep their order; equal corners of the triangles of an STL file become one vertex. "
          "Nothing is repaired: a diagnostic counts non-manifold edges and vertices. Undefined, with the reason, for a "
          "file that cannot be read. The format is detected from the content of the file and, if that is ambiguous, "
          "from its name. Bytes are the content of such a file; their format may be given by its name.",
      .exactness = Exactness::exact,
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&import_as_mesh>("file"),
                    without_files(overload<&import_bytes_as_mesh>("bytes"), Cost::sorting),
                    without_files(overload<&import_bytes_of_format>("bytes", "format"), Cost::sorting)},
      .examples = {{{"'no such file.obj'"}, "FALSE", "(isdefined _)"},
                   {{"'no such file.obj'"}, "undefined"},
                   {{"(toOFF " + kQuad + ")"}, kQuadFaces},
                   {{"(toOBJ " + kQuad + ")", "'obj'"}, kQuadFaces},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"5"}, "importMesh: expected (text), (bytes) or (bytes text), got (int)"},
                 {{"(toOBJ " + kQuad + ")", "'PLY'"}, "importMesh: expected the format STL, OBJ or OFF, got 'PLY'"}},
  });
}

}  // namespace algebra3d
