#include "queries/exchange/exchange_values.h"

#include <array>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_format.h"
#include "queries/exchange/json_text.h"

namespace queries {
namespace {

// The box in the order of a rect3, so that it can be read as one.
std::string summary_json(const Value& value) {
  const algebra3d::GeometryHeader header = value.header();
  std::string json =
      fmt::format(R"({{"type":"{}","{}s":{},"box":)", value.type().name(), value.type().summary_unit(), header.size);
  append_json(json, header.box.is_empty() ? NestedList::symbol("undefined")
                                          : Value::of<algebra3d::Box3>(header.box).to_nested());
  return json + "}";
}

// The list with every fraction `p/q` in it rounded to the nearest double.
NestedList with_doubles(NestedList list) {
  if (list.is_list())
    for (NestedList& element : list.elements()) element = with_doubles(std::move(element));
  if (!list.is_symbol() || list.as_symbol().find('/') == std::string::npos) return list;
  const auto number = algebra3d::coordinate_from_nested(list, "a coordinate");
  return number ? NestedList(number->nearest_double()) : list;
}

/// The form of mesh files with that ending, which there is.
algebra3d::MeshFileForm form_of_ending(const std::string& ending) {
  const mesh_formats::MeshFormat* const format = mesh_formats::known_mesh_formats().of_name("x." + ending);
  return {format, format->forms.front().encoding};
}

template <typename T>
bool is_a(const Value& value) {
  return &value.type() == &algebra3d::TypeOf<T>::type();
}

/// Whether a value is written as a mesh file.
bool has_faces(const Value& value) {
  return is_a<algebra3d::Volume3d>(value) || is_a<algebra3d::Surface3d>(value) || is_a<algebra3d::Mesh3d>(value);
}

/// Writes a loaded solid, surface or mesh; surfaces as meshes with the same triangles.
Result<algebra3d::ExportedSolid> export_faces(Context& context, const Value& value, const std::string& name,
                                              const std::string& file, const algebra3d::MeshFileForm& form) {
  const std::string command = "export" + std::string(form.format->name);
  if (is_a<algebra3d::Volume3d>(value))
    return export_solid(context, command, value.get<algebra3d::Volume3d>(), name, file, form);
  if (is_a<algebra3d::Surface3d>(value)) {
    A3D_ASSIGN(algebra3d::PolygonMesh mesh,
               polygon_mesh_of(value.get<algebra3d::Surface3d>().mesh(), algebra3d::Merging::none, context.monitor()));
    return export_mesh(context, command, algebra3d::Mesh3d(std::move(mesh)), name, file, form);
  }
  if (!form.format->stores_triangles)
    return export_mesh(context, command, value.get<algebra3d::Mesh3d>(), name, file, form);
  A3D_ASSIGN(const algebra3d::Mesh3d triangles, triangulated(value.get<algebra3d::Mesh3d>(), context.monitor()));
  return export_mesh(context, command, triangles, name, file, form);
}

std::string csv_text_of(const NestedList& list) {
  if (list.is_string()) return list.as_string();
  if (list.is_text()) return list.as_text();
  return list.print();
}

// The name for the file of a result that is not an attribute.
constexpr const char* kResultName = "value";

// Undefined in a row has a note beside it; as all of a result it would look like an answer.
template <typename Append>
Status written_or_error(Context& context, const Append& append) {
  using About = algebra3d::Diagnostics::About;
  algebra3d::Diagnostics own;
  Context writing = context.with(own);
  A3D_TRY(append(writing));
  const std::vector<std::string> lines = own.summary();
  if (own.count(About::unwritten) > 0 || own.count(About::undefined) > 0)
    return Error{ErrorCode::io_error, "--geometry-dir: not written: {}", fmt::join(lines, "; ")};
  for (const std::string& line : lines) context.diagnostics.show(line);
  return {};
}

}  // namespace

bool is_summarised(const Value& value) {
  return !value.type().summary_unit().empty();
}

Error no_nested_in_csv(const std::string& name) {
  return {ErrorCode::type_error,
          "csv: '{}' is a nested relation, which CSV does not have; leave it out, `unnest` it, or write JSON", name};
}

void append_csv_text(std::string& csv, std::string_view text) {
  const bool has_edge_blank = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!text.empty() && !has_edge_blank && text.find_first_of(",\"\r\n") == std::string_view::npos) {
    csv += text;
    return;
  }
  csv += '"';
  for (const char c : text) csv.append(c == '"' ? 2 : 1, c);
  csv += '"';
}

Result<NestedList> ExchangeValues::written_file(const Value& value, const std::string& name, Context& context) {
  std::error_code error;
  A3D_ASSIGN(const std::filesystem::path folder, context.resolve(options_.folder));
  std::filesystem::create_directories(folder, error);
  if (error) return Error{ErrorCode::io_error, "--geometry-dir: '{}': {}", options_.folder.string(), error.message()};
  const std::string file =
      (options_.folder / fmt::format("{}_{}.{}", name, ++file_counts_[name], options_.mesh_ending)).string();
  A3D_ASSIGN(const Value loaded, value.loaded());
  A3D_ASSIGN(const auto exported, export_faces(context, loaded, name, file, form_of_ending(options_.mesh_ending)));
  return exported.refusal ? NestedList::symbol("undefined") : NestedList::text(file);
}

Result<ExchangeValues::Form> ExchangeValues::form_of(const Value& value, const std::string& name, Context& context) {
  using Geometry = ExchangeOptions::Geometry;
  if (is_summarised(value) && options_.geometry == Geometry::summary) return Form{{}, summary_json(value)};
  if (options_.geometry == Geometry::file && has_faces(value)) {
    A3D_ASSIGN(NestedList file, written_file(value, name, context));
    return Form{std::move(file), {}};
  }
  A3D_ASSIGN(const Value loaded, value.loaded());
  NestedList list = loaded.to_nested();
  return Form{options_.rounds_fractions ? with_doubles(std::move(list)) : std::move(list), {}};
}

// An array of objects, as a relation that is the whole result. Recursion follows the nesting of the type.
Status ExchangeValues::append_nested(const Value& relation, Context& context, std::string& json) {
  if (const std::size_t count = relation.header().size; count > options_.most_nested_tuples) {
    json += fmt::format(R"({{"type":"arel","tuples":{}}})", count);
    return {};
  }
  A3D_ASSIGN(const Value loaded, relation.loaded());
  const auto& attributes = algebra3d::as_nested_relation(loaded.type())->attributes();
  const auto& tuples = loaded.get<algebra3d::NestedRelation>();
  json += '[';
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    A3D_TRY(context.check_cancelled());
    json += i == 0 ? "{" : ",{";
    for (std::size_t k = 0; k < attributes.size(); ++k) {
      if (k > 0) json += ',';
      append_json_string(json, attributes[k].name);
      json += ':';
      A3D_TRY(append_json(tuples.tuple(i)[k], attributes[k].name, context, json));
    }
    json += '}';
  }
  json += ']';
  return {};
}

Status ExchangeValues::append_json(const Value& value, const std::string& name, Context& context, std::string& json) {
  if (!value.is_defined()) {
    json += "null";
    return {};
  }
  if (algebra3d::as_nested_relation(value.type()) != nullptr) return append_nested(value, context, json);
  A3D_ASSIGN(const Form form, form_of(value, name, context));
  if (form.json.empty())
    queries::append_json(json, form.list);
  else
    json += form.json;
  return {};
}

Status ExchangeValues::append_csv(const Value& value, const std::string& name, Context& context, std::string& csv) {
  if (!value.is_defined()) return {};
  if (algebra3d::as_nested_relation(value.type()) != nullptr) return no_nested_in_csv(name);
  A3D_ASSIGN(const Form form, form_of(value, name, context));
  if (!form.json.empty())
    append_csv_text(csv, form.json);
  else if (!form.list.is_undefined())
    append_csv_text(csv, csv_text_of(form.list));
  return {};
}

Status ExchangeValues::append_json_result(const Value& value, Context& context, std::string& json) {
  return written_or_error(context, [&](Context& writing) { return append_json(value, kResultName, writing, json); });
}

Status ExchangeValues::append_csv_result(const Value& value, Context& context, std::string& csv) {
  return written_or_error(context, [&](Context& writing) { return append_csv(value, kResultName, writing, csv); });
}

}  // namespace queries
