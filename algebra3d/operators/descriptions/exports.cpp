// exportSTL, exportOBJ, exportOFF: one operator for each format of mesh files.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/diagnostics.h"
#include "base/mesh_content.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {
namespace {

using mesh_formats::CoordinateRange;
using mesh_formats::Encoding;
using mesh_formats::MeshFormat;

/// Whether people choose between binary and ASCII.
bool has_choice(const MeshFormat& format) {
  return format.forms.size() > 1;
}

std::string export_name(const MeshFormat& format) {
  return "export" + std::string(format.name);
}

/// The parameter for the exported value: a solid or a mesh.
template <typename T>
Parameter exported_parameter();
template <>
Parameter exported_parameter<Volume3d>() {
  return {"solid", &TypeOf<Volume3d>::type(), true};
}
template <>
Parameter exported_parameter<Mesh3d>() {
  return {"mesh", &TypeOf<Mesh3d>::type(), true};
}

template <typename T>
std::vector<Parameter> export_parameters(const MeshFormat& format) {
  std::vector<Parameter> parameters{exported_parameter<T>()};
  if (format.stores_name) parameters.push_back({"name", &TypeOf<std::string>::type(), true});
  parameters.push_back({"file", &TypeOf<Text>::type(), true});
  if (has_choice(format)) parameters.push_back({"binary", &TypeOf<bool>::type(), true});
  return parameters;
}

Result<Outcome> unwritten(Context& context, const std::string& reason) {
  context.diagnostics.report(reason, {}, Diagnostics::About::unwritten);
  return Outcome(Value::of<bool>(false));
}

Result<ExportedSolid> export_value(Context& context, const std::string& op, const Volume3d& solid,
                                   const std::string& name, const std::string& file, const MeshFileForm& form) {
  return export_solid(context, op, solid, name, file, form);
}
Result<ExportedSolid> export_value(Context& context, const std::string& op, const Mesh3d& mesh, const std::string& name,
                                   const std::string& file, const MeshFileForm& form) {
  if (!form.format->stores_triangles) return export_mesh(context, op, mesh, name, file, form);
  A3D_ASSIGN(const Mesh3d triangles, triangulated(mesh, context.monitor()));
  return export_mesh(context, op, triangles, name, file, form);
}

/// `given` are the arguments for export_parameters.
template <typename T>
Result<Outcome> export_to(const MeshFormat& format, std::span<const Value> given, Context& context) {
  const std::string op = export_name(format);
  std::size_t place = 0;
  const Value& exported = given[place++];
  const Value* const name = format.stores_name ? &given[place++] : nullptr;
  const Value& file = given[place++];
  const Value* const is_binary = has_choice(format) ? &given[place++] : nullptr;
  if (!exported.is_defined())
    return unwritten(context, fmt::format("{}: the {} is undefined", op, exported_parameter<T>().name));
  for (const auto& [value, what] : {std::pair(name, "name"), std::pair(&file, "file"), std::pair(is_binary, "format")})
    if (value != nullptr && !value->is_defined())
      return unwritten(context, fmt::format("{}: the {} is undefined", op, what));
  MeshFileForm form{&format, format.forms.front().encoding};
  if (is_binary != nullptr) form.encoding = is_binary->get<bool>() ? Encoding::binary : Encoding::ascii;
  A3D_ASSIGN(const Value loaded, exported.loaded());
  A3D_ASSIGN(const ExportedSolid result,
             export_value(context, op, loaded.get<T>(), name != nullptr ? name->get<std::string>() : std::string(),
                          file.get<Text>().content, form));
  return Outcome(Value::of<bool>(!result.refusal));
}

template <typename T>
Overload export_overload(const MeshFormat& format) {
  Overload overload;
  overload.parameters = export_parameters<T>(format);
  overload.result = &TypeOf<bool>::type();
  overload.function = [&format](std::span<const Value> given, Context& context) {
    return export_to<T>(format, given, context);
  };
  return overload;
}

std::string_view rounding_text(CoordinateRange coordinates) {
  if (coordinates == CoordinateRange::floats) return "coordinates are rounded to floats, as by roundCoordinates";
  return "corners that are not doubles are rounded, as by roundCoordinates, and written with digits that read back "
         "as the same doubles";
}

/// How coordinates are written: one sentence for all forms, or a clause for each.
std::string coordinates_text(const MeshFormat& format) {
  std::string text;
  for (const mesh_formats::FileForm& form : format.forms)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", form.encoding == Encoding::ascii ? "ASCII" : "binary",
                        rounding_text(form.coordinates));
  const CoordinateRange first = format.forms.front().coordinates;
  if (std::ranges::all_of(format.forms, [&](const mesh_formats::FileForm& f) { return f.coordinates == first; }))
    text = rounding_text(first);
  if (text[0] >= 'a') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text + ". The written solid is valid. ";
}

/// The arguments of an example, in the order of export_parameters.
std::vector<std::string> example_arguments(const MeshFormat& format, const std::string& solid,
                                           const std::string& folder) {
  std::vector<std::string> arguments{solid};
  if (format.stores_name) arguments.emplace_back(R"("cube")");
  arguments.push_back(fmt::format("'{}cube{}'", folder, format.endings.front()));
  if (has_choice(format)) arguments.emplace_back("TRUE");
  return arguments;
}

std::vector<Overload> export_overloads(const MeshFormat& format) {
  return {export_overload<Volume3d>(format), export_overload<Mesh3d>(format)};
}

/// Such as "(volume3d string text bool) or (mesh3d string text bool)".
std::string parameter_types(const MeshFormat& format) {
  std::string text;
  for (const Overload& overload : export_overloads(format)) {
    std::string types;
    for (const Parameter& parameter : overload.parameters)
      types += (types.empty() ? "(" : " ") + std::string(parameter.type->name());
    text += (text.empty() ? "" : " or ") + types + ")";
  }
  return text;
}

std::vector<Example> export_examples(const MeshFormat& format) {
  return {{example_arguments(format, kUnitCube, "no such folder/"), "FALSE"},
          {example_arguments(format, kUndefinedSolid, ""), "FALSE"},
          {example_arguments(format, "(mesh3d (() ()))", "no such folder/"), "FALSE"}};
}

void register_export(OperatorGroup& group, const MeshFormat& format) {
  const std::string op = export_name(format);
  std::string syntax = "_ " + op + "[_";
  for (std::size_t i = 2; i < export_parameters<Volume3d>(format).size(); ++i) syntax += ", _";
  group.add({
      .name = op,
      .syntax = syntax + "]",
      .doc = fmt::format("Writes a solid or mesh to {}{}{}; TRUE if the file was written.", format.title,
                         format.stores_name ? " with a name" : "",
                         has_choice(format) ? ", in binary (TRUE) or ASCII" : ""),
      .detail = coordinates_text(format) +
                "A diagnostic reports the change of the boundary and of the volume if it exceeds a ten thousandth of "
                "the diagonal or of the volume, if shells vanished, or if facets were divided. FALSE with a "
                "diagnostic if a coordinate is beyond the range of the file's numbers, if nothing of the solid is "
                "left, if an argument is undefined, or if the file cannot be written; an existing file is then "
                "unchanged." +
                " The vertices and faces of a mesh are written in their order, with a diagnostic that counts the "
                "vertices whose coordinates are rounded" +
                (format.stores_triangles ? "; faces of more corners are triangulated, as by triangulate." : "."),
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .is_pure = false,
      .writes_files = true,
      .overloads = export_overloads(format),
      .examples = export_examples(format),
      .errors = {{{kUnitCube, "5"}, fmt::format("{}: expected {}, got (volume3d int)", op, parameter_types(format))}},
  });
}

}  // namespace

void register_exports(OperatorGroup& group) {
  for (const MeshFormat& format : mesh_formats::known_mesh_formats()) register_export(group, format);
}

}  // namespace algebra3d
