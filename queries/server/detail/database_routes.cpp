// The server, the database and the language.
#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/version.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/language/command_list.h"
#include "queries/language/documentation.h"
#include "queries/language/example_queries.h"
#include "queries/server/detail/api.h"
#include "queries/server/detail/pages.h"
#include "queries/server/detail/result_json.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

std::string_view kind_of(const TypeExpr& type) {
  if (type.is_function()) return "function";
  if (is_index(type)) return "index";
  return type.is_relation() ? "relation" : "value";
}

Result<std::string> count_of(Store& store, const ObjectInfo& object) {
  if (!object.type.is_relation() || !object.has_value) return std::string("null");
  A3D_ASSIGN(const Datum relation, store.read(object.name));
  A3D_ASSIGN(const std::int64_t count, relation.relation()->count());
  return std::to_string(count);
}

// A relation that cannot be counted must not hide the others.
std::string json_of(Store& store, const ObjectInfo& object, const algebra3d::Registry& registry) {
  const bool has_shape =
      object.type.is_relation() ? has_drawn_column(object.type.element(), registry) : is_drawn(object.type, registry);
  std::string json = fmt::format(R"({{"name":{},"type":{},"kind":"{}","count":{},"shape":{},"hasValue":{})",
                                 json_string(object.name), json_string(object.type.text()), kind_of(object.type),
                                 count_of(store, object).value_or("null"), has_shape, object.has_value);
  if (!object.derived_text.empty()) json += ",\"derivedFrom\":" + json_string(object.derived_text);
  if (!object.index_relation.empty()) json += ",\"indexOf\":" + json_string(object.index_relation);
  return json + "}";
}

Result<std::string> json_of_objects(Store& store, const algebra3d::Registry& registry) {
  A3D_TRY(store.begin(false));
  auto objects = store.objects();
  std::string json = "[";
  if (objects)
    for (const ObjectInfo& object : *objects) {
      if (json.size() > 1) json += ',';
      json += json_of(store, object, registry);
    }
  store.rollback();
  if (!objects) return std::move(objects).error();
  return json + "]";
}

std::string json_of(const algebra3d::Operator& op) {
  return fmt::format(R"("name":{},"family":{},"syntax":{},"doc":{},"signatures":{},"changes":{})", json_string(op.name),
                     json_string(op.family), json_string(op.written()), json_string(op.doc),
                     json_strings(op.all_signatures()), op.writes_files || op.changes_relations);
}

std::string json_of_examples(const std::vector<algebra3d::QueryExample>& examples) {
  std::string json = "[";
  for (const auto& [query, result] : examples) {
    if (json.size() > 1) json += ',';
    const std::string statement = query.starts_with("query ") ? query : "query " + query;
    json += fmt::format(R"({{"query":{},"result":{}}})", json_string(statement), json_string(result));
  }
  return json + "]";
}

std::string json_of_errors(const std::vector<algebra3d::QueryError>& errors) {
  std::string json = "[";
  for (const auto& [query, message] : errors) {
    if (json.size() > 1) json += ',';
    json += fmt::format(R"({{"query":{},"message":{}}})", json_string(query), json_string(message));
  }
  return json + "]";
}

std::string json_of(const mesh_formats::MeshFormat& format) {
  std::vector<std::string> endings(format.endings.begin(), format.endings.end());
  std::string forms;
  for (const mesh_formats::FileForm& form : format.forms) {
    const bool has_floats = form.coordinates == mesh_formats::CoordinateRange::floats;
    forms += fmt::format(R"({}{{"format":{},"binary":{},"coordinates":"{}","mediaType":{}}})", forms.empty() ? "" : ",",
                         json_string(format.word_of(form)), form.encoding == mesh_formats::Encoding::binary,
                         has_floats ? "floats" : "doubles", json_string(format.media_type));
  }
  return fmt::format(
      R"({{"name":{},"endings":{},"importer":{},"polygons":{},"names":{},"attributes":{},"forms":[{}]}})",
      json_string(format.name), json_strings(endings), json_string("import" + std::string(format.name)),
      !format.stores_triangles, format.stores_name, format.read_with_attributes != nullptr, forms);
}

}  // namespace

HttpAnswer Api::get_server(const Call&) {
  if (const Status there = database_.check(); !there) return refusal_of(there.error()).answer();
  return {.body =
              fmt::format("{{\"name\":\"algebra3d\",\"version\":{},\"database\":{},\"readOnly\":{},\"uploadLimit\":{},"
                          "\"statementLimit\":{}}}\n",
                          json_string(algebra3d::kVersion), json_string(database_.file().filename().string()),
                          options_.read_only, options_.max_upload_megabytes << 20U, limits_.statement_bytes)};
}

HttpAnswer Api::get_objects(const Call&) {
  if (const Status there = database_.check(); !there) return refusal_of(there.error()).answer();
  const auto promise = std::make_shared<std::promise<Result<std::string>>>();
  const Status started = sessions_.run([this, promise](Session& session) {
    promise->set_value(algebra3d::without_exceptions([&] { return json_of_objects(*session.store(), registry_); }));
  });
  if (!started) return refusal_of_session(started.error()).answer();
  const Result<std::string> json = promise->get_future().get();
  if (!json) return refusal_of(json.error()).answer();
  return {.body = *json + "\n"};
}

HttpAnswer Api::get_types(const Call&) {
  std::string json = "[";
  for (const algebra3d::Type* type : listed_types(registry_)) {
    if (json.size() > 1) json += ',';
    json += fmt::format(R"({{"name":{},"doc":{},"shape":{}}})", json_string(type->name()), json_string(type->doc()),
                        algebra3d::is_drawable(*type));
  }
  return {.body = json + "]\n"};
}

HttpAnswer Api::get_operators(const Call&) {
  std::string json = "[";
  for (const algebra3d::Operator* op : registry_.operators())
    json += (json.size() > 1 ? ",{" : "{") + json_of(*op) + "}";
  return {.body = json + "]\n"};
}

HttpAnswer Api::get_operator(const Call& call) {
  const std::string& name = call.path.find("name")->second;
  const algebra3d::Operator* const op = registry_.find_operator(name);
  if (op == nullptr) {
    const std::string nearest = registry_.suggestion(name);
    return Refusal::not_found(fmt::format("there is no operator '{}'{}", name,
                                          nearest.empty() ? "" : "; did you mean '" + nearest + "'?"))
        .answer();
  }
  return {.body = fmt::format(R"({{{},"detail":{},"exactness":{},"cost":{},"examples":{},"errors":{},"help":{}}})",
                              json_of(*op), json_string(op->detail), json_string(describe(op->exactness)),
                              json_string(describe(op->cost)), json_of_examples(example_queries(registry_, *op)),
                              json_of_errors(failing_queries(registry_, *op)), json_string(help_text(*op, registry_))) +
                  "\n"};
}

// The words of commands that are not placeholders.
HttpAnswer Api::get_commands(const Call&) {
  std::string json = "[";
  for (const auto& [syntax, meaning] : language_commands())
    json += fmt::format(R"({}{{"syntax":{},"doc":{}}})", json.size() > 1 ? "," : "", json_string(syntax),
                        json_string(meaning));
  return {.body = json + "]\n"};
}

HttpAnswer Api::get_keywords(const Call&) {
  std::set<std::string> words;
  for (const CommandDescription& command : command_list()) {
    std::string word;
    for (const char c : std::string(command.syntax) + " ") {
      if (std::islower(static_cast<unsigned char>(c)) != 0 || c == '_') {
        word += c;
        continue;
      }
      if (word.size() > 1 || word == "q") words.insert(word);
      word.clear();
    }
  }
  return {.body = json_strings({words.begin(), words.end()}) + "\n"};
}

HttpAnswer Api::get_formats(const Call&) {
  std::string json = "[";
  for (const mesh_formats::MeshFormat& format : mesh_formats::known_mesh_formats()) {
    if (json.size() > 1) json += ',';
    json += json_of(format);
  }
  return {.body = json + "]\n"};
}

HttpAnswer Api::get_openapi(const Call&) {
  return {.body = std::string(openapi_description())};
}

}  // namespace queries
