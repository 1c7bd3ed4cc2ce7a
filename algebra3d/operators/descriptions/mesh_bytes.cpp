// toSTL, toOBJ, toOFF (one operator for each format of mesh files), toGLB: the content of files as bytes.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/file_bytes.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/display/glb.h"
#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/memory_limit.h"
#include "base/memory_sink.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

using mesh_formats::MeshFormat;

std::string to_name(const MeshFormat& format) {
  return "to" + std::string(format.name);
}

// The bytes of a value as a file of the format, in its first form.

Result<ExportedSolid> write_value(Context& context, const std::string& op, const Volume3d& solid,
                                  const MeshDestination& to, const MeshFileForm& form) {
  return export_solid(context, op, solid, {}, to, form);
}
Result<ExportedSolid> write_value(Context& context, const std::string& op, const Mesh3d& mesh,
                                  const MeshDestination& to, const MeshFileForm& form) {
  if (!form.format->stores_triangles) return export_mesh(context, op, mesh, {}, to, form);
  A3D_ASSIGN(const Mesh3d triangles, triangulated(mesh, context.monitor()));
  return export_mesh(context, op, triangles, {}, to, form);
}
Result<ExportedSolid> write_value(Context& context, const std::string& op, const Surface3d& surface,
                                  const MeshDestination& to, const MeshFileForm& form) {
  A3D_ASSIGN(PolygonMesh mesh, polygon_mesh_of(surface.mesh(), Merging::none, context.monitor()));
  return write_value(context, op, Mesh3d(std::move(mesh)), to, form);
}

Result<Bytes> joined_pieces(std::vector<std::string> pieces) {
  if (pieces.size() == 1) return Bytes{std::move(pieces.front())};
  std::size_t size = 0;
  for (const std::string& piece : pieces) size += piece.size();
  A3D_TRY(require_memory(size, "the bytes of the file"));
  Bytes bytes;
  bytes.content.reserve(size);
  for (std::string& piece : pieces) {
    bytes.content += piece;
    piece = {};
  }
  return bytes;
}

/// The reason of an undefined result: the refusal without the name of the operator, which comes before every reason.
std::string reason_of(const Error& refusal, const std::string& op) {
  std::string text = refusal.text();
  const std::string prefix = op + ": ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

template <typename T>
Result<Outcome> bytes_of(const MeshFormat& format, const Value& given, Context& context) {
  const std::string op = to_name(format);
  A3D_ASSIGN(const Value loaded, given.loaded());
  MemorySink sink(context.monitor());
  // A refusal is reported as that of a file that was not written, which is not meant here.
  Diagnostics diagnostics;
  Context writing = context.with(diagnostics);
  A3D_ASSIGN(const ExportedSolid written,
             write_value(writing, op, loaded.get<T>(), MeshDestination::sink(sink, kBytesName),
                         {&format, format.forms.front().encoding}));
  if (written.refusal) return Outcome(Undefined{reason_of(*written.refusal, op)});
  for (const Diagnostics::Entry& entry : diagnostics.entries()) context.diagnostics.report(entry.text);
  A3D_ASSIGN(Bytes bytes, joined_pieces(std::move(sink).take()));
  return Outcome(Value::of(std::move(bytes)));
}

template <typename T>
Overload to_overload(const MeshFormat& format, const char* parameter) {
  Overload overload;
  overload.parameters = {{parameter, &TypeOf<T>::type()}};
  overload.result = &TypeOf<Bytes>::type();
  overload.function = [&format](std::span<const Value> given, Context& context) {
    return bytes_of<T>(format, given.front(), context);
  };
  return overload;
}

/// A view of an example: the volume of the solid that is read again.
std::string read_back(const MeshFormat& format) {
  return fmt::format("(volume (import{} _))", format.name);
}

void register_bytes_of(OperatorGroup& group, const MeshFormat& format) {
  const std::string op = to_name(format);
  const bool has_floats =
      format.form(format.forms.front().encoding)->coordinates == mesh_formats::CoordinateRange::floats;
  group.add({
      .name = op,
      .syntax = op + "(_)",
      .doc = fmt::format("The content of {} with a solid, surface or mesh.", format.title),
      .detail = fmt::format(
          "{}, as by export{}: coordinates are rounded to {}, of a solid as by roundCoordinates, so that what is "
          "written is valid. A diagnostic reports the change of a solid if it can be seen, and the number of vertices "
          "of others that were rounded. {} Undefined, with the reason, if a coordinate is beyond the range of the "
          "file's numbers, or if nothing of the solid is left.",
          format.forms.front().encoding == mesh_formats::Encoding::binary ? "Binary" : "ASCII", format.name,
          has_floats ? "floats" : "doubles",
          format.stores_triangles ? "Faces of more than three corners are triangulated, as by triangulate."
                                  : "Vertices and faces of a mesh keep their order."),
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .cost = Cost::arrangement,
      .overloads = {to_overload<Volume3d>(format, "solid"), to_overload<Surface3d>(format, "surface"),
                    to_overload<Mesh3d>(format, "mesh")},
      .examples = {{{kUnitCube}, "1.0", read_back(format)},
                   {{kCubeOfTwo}, "TRUE", "(isdefined _)"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0))))"}, "0.5", "(area (importSurface _))"},
                   {{"(mesh3d (((0 0 0) (1 0 0) (0 1 0) (0 0 1)) ((2 1 0) (0 1 3) (1 2 3) (2 0 3))))"},
                    "TRUE",
                    "(> " + read_back(format) + " 0.16)"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"5"}, op + ": expected (volume3d), (surface3d) or (mesh3d), got (int)"}},
  });
}

template <typename T>
Result<Bytes> glb_of_value(Context& context, const T& value) {
  A3D_ASSIGN(const DrawnShape shape, shape_of(Value::of(value), context.monitor()));
  const std::array<GlbNode, 1> nodes{GlbNode{0, &shape}};
  A3D_TRY(require_memory(glb_bytes(shape), "the bytes of the file"));
  A3D_ASSIGN(std::string content, glb_of(nodes));
  return Bytes{std::move(content)};
}

}  // namespace

void register_mesh_bytes(OperatorGroup& group) {
  for (const MeshFormat& format : mesh_formats::known_mesh_formats()) register_bytes_of(group, format);
  group.add({
      .name = "toGLB",
      .syntax = "toGLB(_)",
      .doc = "The content of a binary glTF file with a solid, surface or mesh, to be shown.",
      .detail =
          "One node with triangles, smooth normals that are divided at creases of 30 degrees, and the edges between "
          "faces that are not coplanar, of meshes all edges. Coordinates are rounded to floats relative to the middle "
          "of the box, which is the translation of the node: at most a part in 16 million of the size of the box.",
      .exactness = Exactness::bounded,
      .frame_use = FrameUse::coordinates,
      .cost = Cost::linear,
      .overloads = {overload<&glb_of_value<Volume3d>>("solid"), overload<&glb_of_value<Surface3d>>("surface"),
                    overload<&glb_of_value<Mesh3d>>("mesh")},
      .examples = {{{kUnitCube}, "TRUE", "(startsWith (bytes2hex _) '676c544602000000')"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0))))"}, "TRUE", "(startsWith (bytes2hex _) '676c5446')"},
                   {{"(mesh3d (((0 0 0) (1 0 0) (0 1 0)) ((0 1 2))))"},
                    "TRUE",
                    "(startsWith (bytes2hex _) '676c5446')"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"5"}, "toGLB: expected (volume3d), (surface3d) or (mesh3d), got (int)"}},
  });
}

}  // namespace algebra3d
