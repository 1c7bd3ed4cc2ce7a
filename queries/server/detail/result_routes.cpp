// Rows, cells, shapes and files of results.

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/export_solid.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/memory_sink.h"
#include "base/propagate.h"
#include "base/text.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/server/detail/api.h"
#include "queries/server/detail/cell_shapes.h"
#include "queries/server/detail/download_name.h"
#include "queries/server/detail/entity_tag.h"
#include "queries/server/detail/result_json.h"
#include "queries/server/detail/table_cells.h"
#include "queries/streams/datum.h"

namespace queries {

using algebra3d::Context;
using algebra3d::ExportedSolid;
using algebra3d::Mesh3d;
using algebra3d::MeshDestination;
using algebra3d::MeshFileForm;
using algebra3d::Surface3d;
using algebra3d::TypeOf;
using algebra3d::Volume3d;

namespace {

/// A value as the content of a mesh file.
struct CellFile {
  std::string_view type;                 ///< media type
  std::string name;                      ///< for the client's file
  std::vector<std::string> pieces;       ///< the bytes
  std::vector<std::string> diagnostics;  ///< how far coordinates were rounded
};

constexpr const char* kCommand = "export";

/// A cell that a client names.
struct NamedCell {
  std::size_t row = 0;
  std::string column;
};

// The name of a row: the first of its texts that can be a name.
std::string name_of_row(const Tuple& row) {
  for (const Value& value : row.attributes) {
    if (!value.is_defined() || &value.type() != &TypeOf<std::string>::type()) continue;
    if (std::string name = safe_file_name(value.get<std::string>()); !name.empty()) return name;
  }
  return {};
}

// `bolt-Solid.stl`; without a name `Solid-5.stl` of several rows, and `Solid.stl` of one.
std::string file_name(const Tuple& row, const NamedCell& place, std::size_t rows, const MeshFileForm& form) {
  const std::string name = name_of_row(row);
  const std::string stem = !name.empty() ? fmt::format("{}-{}", name, place.column)
                           : rows == 1   ? place.column
                                         : fmt::format("{}-{}", place.column, place.row);
  return stem + std::string(form.format->endings.front());
}

Result<ExportedSolid> write_mesh(const Mesh3d& mesh, const std::string& name, const MeshDestination& to,
                                 const MeshFileForm& form, Context& context) {
  if (!form.format->stores_triangles) return algebra3d::export_mesh(context, kCommand, mesh, name, to, form);
  A3D_ASSIGN(const Mesh3d triangles, algebra3d::triangulated(mesh, context.monitor()));
  return algebra3d::export_mesh(context, kCommand, triangles, name, to, form);
}

Result<ExportedSolid> write(const Value& value, const std::string& name, const MeshDestination& to,
                            const MeshFileForm& form, Context& context) {
  const algebra3d::Type* const type = &value.type();
  if (type == &TypeOf<Volume3d>::type())
    return algebra3d::export_solid(context, kCommand, value.get<Volume3d>(), name, to, form);
  if (type == &TypeOf<Mesh3d>::type()) return write_mesh(value.get<Mesh3d>(), name, to, form, context);
  if (type == &TypeOf<Surface3d>::type()) {
    A3D_ASSIGN(algebra3d::PolygonMesh mesh,
               algebra3d::polygon_mesh_of(value.get<Surface3d>().mesh(), algebra3d::Merging::none, context.monitor()));
    return write_mesh(Mesh3d(std::move(mesh)), name, to, form, context);
  }
  return Error{ErrorCode::invalid_value, "a {} has no mesh file; expected a volume3d, surface3d or mesh3d",
               type->name()};
}

/// The form that a client names by its word: stl, stl-ascii, ...
std::optional<MeshFileForm> file_form(std::string_view name) {
  for (const auto& [format, form] : mesh_formats::known_mesh_formats().forms())
    if (format->word_of(*form) == name) return MeshFileForm{format, form->encoding};
  return std::nullopt;
}

/// The file of a solid, surface or mesh, written as the export operators do. Errors: invalid_value for other types,
/// undefined values and solids that cannot be rounded; those of the store; interrupted; limit_exceeded if the file does
/// not fit into memory.
Result<CellFile> file_of(ResultTable& table, const NamedCell& place, const MeshFileForm& form, Context& context) {
  A3D_ASSIGN(const Value value, cell(table, place.row, place.column));
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "the value is undefined"};
  A3D_ASSIGN(const Value loaded, value.loaded());
  A3D_ASSIGN(const TuplePtr row, table.row(place.row));
  CellFile result{.type = form.format->media_type,
                  .name = file_name(*row, place, table.count(), form),
                  .pieces = {},
                  .diagnostics = {}};
  algebra3d::MemorySink sink(context.monitor());
  A3D_ASSIGN(ExportedSolid written,
             write(loaded, place.column, MeshDestination::sink(sink, result.name), form, context));
  if (written.refusal) return *std::move(written.refusal);
  result.pieces = std::move(sink).take();
  result.diagnostics = context.diagnostics.summary();
  return result;
}

constexpr const char* kJson = "application/json";
constexpr const char* kGltf = "model/gltf-binary";
constexpr std::size_t kMostCellBytes = std::size_t{64} << 20U;

std::optional<std::string> parameter(const HttpRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? std::nullopt : std::optional(found->second);
}

Reply<std::size_t> number(const HttpRequest& request, const std::string& name, std::size_t otherwise,
                          std::size_t most = std::numeric_limits<std::uint32_t>::max()) {
  const auto text = parameter(request, name);
  if (!text) return otherwise;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || value > most)
    return Refusal::bad_request(fmt::format("'{}': expected a number from 0 to {}, got '{}'", name, most, *text));
  return value;
}

Reply<std::string> text(const HttpRequest& request, const std::string& name) {
  if (const auto found = parameter(request, name)) return *found;
  return Refusal::bad_request(fmt::format("the parameter '{}' is missing", name));
}

// Whether shapes are to be compressed: they shrink to a half only, which costs more time than loopback takes to carry
// them, so clients ask for it.
Reply<bool> wants_gzip(const HttpRequest& request) {
  const auto encoding = parameter(request, "encoding");
  if (encoding && *encoding != "gzip")
    return Refusal::bad_request(fmt::format("'encoding': expected gzip, got '{}'", *encoding));
  return encoding.has_value();
}

// The value list of a cell as JSON. An element takes some dozen bytes at least: a list that is certainly too large is
// not written at all.
Result<std::string> list_of_cell(ResultTable& table, std::size_t row, const std::string& column) {
  constexpr std::size_t kLeastBytes = 16;
  A3D_ASSIGN(const Value value, cell(table, row, column));
  const std::size_t elements = value.is_defined() && value.type().is_large() ? value.header().size : 0;
  std::string list;
  if (elements <= kMostCellBytes / kLeastBytes) {
    A3D_ASSIGN(const Value loaded, value.loaded());
    list = loaded.to_nested().print();
    if (list.size() <= kMostCellBytes)
      return fmt::format(R"({{"type":{},"text":{}}})", json_string(value.type().term().text()), json_string(list));
  }
  return Error{ErrorCode::limit_exceeded, "the list of the value has more than {} bytes", kMostCellBytes};
}

}  // namespace

HttpAnswer Api::get_rows(const Call& call) {
  Reply<std::shared_ptr<Execution>> result = results_.find(call.path.find("id")->second);
  if (!result) return result.refusal().answer();
  Reply<std::size_t> from = number(call.request, "from", 0);
  Reply<std::size_t> count = number(call.request, "count", 100, kMostRows);
  if (!from) return from.refusal().answer();
  if (!count) return count.refusal().answer();
  const EntityTag tag(call.path.find("id")->second, "rows", {std::to_string(*from), std::to_string(*count)});
  if (tag.is_known_to(call.request)) return tag.not_modified(kJson);
  const auto rows = (*result)->ask<std::string>(call.request.connection,
                                                [from = *from, count = *count](ResultTable& table, Context& context) {
                                                  return json_of_rows(table, from, count, context);
                                                });
  if (!rows) return refusal_of_cell(rows.error()).answer();
  return tag.marked({.body = fmt::format("{{\"from\":{},\"rows\":{}}}\n", *from, *rows)}, call.request);
}

HttpAnswer Api::get_cell(const Call& call) {
  Reply<std::shared_ptr<Execution>> result = results_.find(call.path.find("id")->second);
  if (!result) return result.refusal().answer();
  Reply<std::size_t> row = number(call.request, "row", 0);
  Reply<std::string> column = text(call.request, "column");
  if (!row) return row.refusal().answer();
  if (!column) return column.refusal().answer();
  const EntityTag tag(call.path.find("id")->second, "cell", {std::to_string(*row), *column});
  if (tag.is_known_to(call.request)) return tag.not_modified(kJson);
  const auto list = (*result)->ask<std::string>(
      call.request.connection, [&](ResultTable& table, Context&) { return list_of_cell(table, *row, *column); });
  if (list) return tag.marked({.body = *list + "\n"}, call.request);
  if (list.error().code != ErrorCode::limit_exceeded) return refusal_of_cell(list.error()).answer();
  return Refusal{413, "too_large", list.error().text(), "Ask for its file or its shape."}.answer();
}

HttpAnswer Api::get_shapes(const Call& call) {
  Reply<std::shared_ptr<Execution>> result = results_.find(call.path.find("id")->second);
  if (!result) return result.refusal().answer();
  Reply<std::string> column = text(call.request, "column");
  Reply<std::size_t> from = number(call.request, "from", 0);
  Reply<std::size_t> count = number(call.request, "count", 1, kMostRows);
  Reply<std::size_t> triangles = number(call.request, "triangles", 0);
  Reply<std::size_t> bytes = number(call.request, "bytes", std::size_t{64} << 20U);
  for (const auto* each : {&from, &count, &triangles, &bytes})
    if (!*each) return each->refusal().answer();
  if (!column) return column.refusal().answer();
  Reply<bool> is_gzip = wants_gzip(call.request);
  if (!is_gzip) return is_gzip.refusal().answer();
  const EntityTag tag(
      call.path.find("id")->second, "shapes",
      {*column, std::to_string(*from), std::to_string(*count), std::to_string(*triangles), std::to_string(*bytes)});
  if (tag.is_known_to(call.request)) {
    HttpAnswer answer = tag.not_modified(kGltf);
    answer.is_compressible = *is_gzip;
    return answer;
  }
  const ShapeRequest request{*column, *from, *count, *triangles, *bytes};
  auto shapes = (*result)->ask<CellShapes>(call.request.connection, [request](ResultTable& table, Context& context) {
    return shapes_of(table, request, context);
  });
  if (!shapes) return refusal_of_cell(shapes.error()).answer();
  HttpAnswer answer{.type = kGltf, .body = std::move(shapes->file), .is_compressible = *is_gzip};
  if (shapes->next) answer.headers.emplace_back("X-Algebra3d-Next", std::to_string(*shapes->next));
  return tag.marked(std::move(answer), call.request);
}

HttpAnswer Api::get_file(const Call& call) {
  Reply<std::shared_ptr<Execution>> result = results_.find(call.path.find("id")->second);
  if (!result) return result.refusal().answer();
  Reply<std::size_t> row = number(call.request, "row", 0);
  Reply<std::string> column = text(call.request, "column");
  Reply<std::string> format = text(call.request, "format");
  if (!row) return row.refusal().answer();
  if (!column) return column.refusal().answer();
  if (!format) return format.refusal().answer();
  const auto form = file_form(*format);
  if (!form)
    return Refusal::bad_request(fmt::format("'format': expected {}, got '{}'",
                                            mesh_formats::known_mesh_formats().form_words("or"), *format))
        .answer();
  const EntityTag tag(call.path.find("id")->second, "file", {std::to_string(*row), *column, *format});
  if (tag.is_known_to(call.request)) return tag.not_modified(std::string(form->format->media_type));
  auto file = (*result)->ask<CellFile>(call.request.connection, [&](ResultTable& table, Context& context) {
    return file_of(table, {*row, *column}, *form, context);
  });
  if (!file) return refusal_of_cell(file.error()).answer();
  HttpAnswer answer{.type = std::string(file->type), .pieces = std::move(file->pieces)};
  answer.headers.emplace_back("X-Algebra3d-Diagnostics", json_strings(file->diagnostics));
  answer.headers.emplace_back("Content-Disposition", attachment(file->name));
  return tag.marked(std::move(answer), call.request);
}

HttpAnswer Api::get_progress(const Call& call) {
  Reply<std::shared_ptr<Execution>> result = results_.find(call.path.find("id")->second);
  if (!result) return result.refusal().answer();
  return {.body = fmt::format("{{\"text\":{}}}\n", json_string((*result)->progress())),
          .headers = {{"Cache-Control", "no-store"}}};
}

HttpAnswer Api::delete_result(const Call& call) {
  const std::string& id = call.path.find("id")->second;
  if (results_.drop(id)) return {.status = 204};
  return results_.find(id).refusal().answer();
}

}  // namespace queries
