#include "queries/shell/exchange_values.h"

#include <array>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "algebra3d/types/coordinate_text.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "queries/shell/json_text.h"
#include "queries/shell/table.h"

namespace queries {
namespace {

using algebra3d::Text;

// The box in the order of a rect3, so that it can be read as one.
std::string summary_json(const Value& value) {
  const algebra3d::GeometryHeader header = value.header();
  const bool is_points = value.type().name() == "points3d";
  std::string json = fmt::format(R"({{"type":"{}","{}":{},"box":)", value.type().name(),
                                 is_points ? "points" : "triangles", header.size);
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

/// The operator that writes a format, and its arguments behind the solid.
struct MeshWriterCall {
  std::string_view op;
  std::vector<Value> arguments;
};

MeshWriterCall writer_call(const std::string& format, const std::string& name, const std::string& file) {
  const Value file_text = Value::of<Text>({file});
  if (format == "stl") return {"exportSTL", {Value::of<std::string>(name), file_text, Value::of<bool>(true)}};
  if (format == "off") return {"exportOFF", {file_text, Value::of<bool>(false)}};
  return {"exportOBJ", {Value::of<std::string>(name), file_text}};
}

std::string csv_text_of(const NestedList& list) {
  if (list.is_string()) return list.as_string();
  if (list.is_text()) return list.as_text();
  return list.print();
}

// What the file of a result is named after that is no attribute.
constexpr const char* kResultName = "value";

// Undefined in a row has a note beside it; as all of a result it would look like an answer.
template <typename Append>
Status written_or_error(Context& context, const Append& append) {
  using About = algebra3d::Diagnostics::About;
  algebra3d::Diagnostics own;
  Context writing{own, context.cancel, context.folder, context.memory, context.report};
  RETURN_IF_ERROR(append(writing));
  const std::vector<std::string> lines = own.summary();
  if (own.count(About::unwritten) > 0 || own.count(About::undefined) > 0)
    return Error{ErrorCode::io_error, "--geometry-dir: the solid is not written: {}", fmt::join(lines, "; ")};
  for (const std::string& line : lines) context.diagnostics.show(line);
  return {};
}

}  // namespace

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

Result<NestedList> ExchangeValues::written_file(const Value& solid, const std::string& name, Context& context) {
  std::error_code error;
  std::filesystem::create_directories(context.resolve(options_.folder), error);
  if (error) return Error{ErrorCode::io_error, "--geometry-dir: '{}': {}", options_.folder.string(), error.message()};
  const std::string file =
      (options_.folder / fmt::format("{}_{}.{}", name, ++file_counts_[name], options_.mesh_format)).string();
  ASSIGN_OR_RETURN(const Value loaded, solid.loaded());
  MeshWriterCall writer = writer_call(options_.mesh_format, name, file);
  writer.arguments.insert(writer.arguments.begin(), loaded);
  std::vector<TypeExpr> types;
  for (const Value& argument : writer.arguments) types.emplace_back(argument.type().name());
  ASSIGN_OR_RETURN(const auto call, registry_.resolve(*registry_.find_operator(writer.op), types));
  ASSIGN_OR_RETURN(const Value written, algebra3d::Registry::call_for_value(call, writer.arguments, context));
  const bool is_written = written.is_defined() && written.get<bool>();
  return is_written ? NestedList::text(file) : NestedList::symbol("undefined");
}

Result<ExchangeValues::Form> ExchangeValues::form_of(const Value& value, const std::string& name, Context& context) {
  using Geometry = ExchangeOptions::Geometry;
  if (is_large(value) && options_.geometry == Geometry::summary) return Form{{}, summary_json(value)};
  if (options_.geometry == Geometry::file && value.type().name() == "volume3d") {
    ASSIGN_OR_RETURN(NestedList file, written_file(value, name, context));
    return Form{std::move(file), {}};
  }
  ASSIGN_OR_RETURN(const Value loaded, value.loaded());
  NestedList list = loaded.to_nested();
  return Form{options_.rounds_fractions ? with_doubles(std::move(list)) : std::move(list), {}};
}

Status ExchangeValues::append_json(const Value& value, const std::string& name, Context& context, std::string& json) {
  if (!value.is_defined()) {
    json += "null";
    return {};
  }
  ASSIGN_OR_RETURN(const Form form, form_of(value, name, context));
  if (form.json.empty())
    queries::append_json(json, form.list);
  else
    json += form.json;
  return {};
}

Status ExchangeValues::append_csv(const Value& value, const std::string& name, Context& context, std::string& csv) {
  if (!value.is_defined()) return {};
  ASSIGN_OR_RETURN(const Form form, form_of(value, name, context));
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
