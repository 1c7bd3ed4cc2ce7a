#include "queries/server/detail/query_request.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "algebra3d/values/conversions/json_tree.h"
#include "base/propagate.h"
#include "queries/language/scanner.h"
#include "queries/server/detail/result_json.h"
#include "queries/server/detail/table_cells.h"

namespace queries {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 8;

Refusal wrong_member(std::string_view name, std::string_view expected, const Json& found) {
  constexpr std::size_t kShown = 60;
  return Refusal::bad_request(
      fmt::format("'{}': expected {}, got {}", name, expected, found.dump(-1, ' ', true).substr(0, kShown)));
}

std::optional<Refusal> refuse_other_members(const Json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [name, value] : object.items())
    if (std::ranges::find(known, name) == known.end())
      return Refusal::bad_request(fmt::format("unknown member '{}'; expected {}", name, fmt::join(known, ", ")));
  return std::nullopt;
}

// A number as the text from which it was read, as far as JSON keeps it.
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "TRUE" : "FALSE";
  return value.dump();
}

/// Looks for a key that an object has twice: the parser keeps the last one, another program might have read the first.
class RepeatedKey {
 public:
  void note(Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event != Json::parse_event_t::key) return;
    const auto key = parsed.get<std::string>();
    if (!open_.back().insert(key).second && !found_) found_ = key;
  }
  const std::optional<std::string>& found() const { return found_; }

 private:
  std::vector<std::set<std::string>> open_;  // the keys of each object that has not ended
  std::optional<std::string> found_;
};

Reply<SessionParameter> constant_parameter(const std::string& name, const Json& given,
                                           const algebra3d::Registry& registry) {
  if (const auto refusal = refuse_other_members(given, {"type", "value"})) return *refusal;
  if (!given.contains("type") || !given["type"].is_string())
    return wrong_member("parameters." + name + ".type", "the name of a type", given.value("type", Json()));
  const Json value = given.value("value", Json());
  if (!value.is_string() && !value.is_number() && !value.is_boolean())
    return wrong_member("parameters." + name + ".value", "a number, a boolean or a text", value);
  const auto type = given["type"].get<std::string>();
  auto parsed = session_parameter(type, text_of(value), registry);
  if (!parsed) return Refusal::bad_request(fmt::format("parameters.{}: {}", name, parsed.error().text()));
  return *std::move(parsed);
}

Reply<SessionParameter> cell_parameter(const std::string& name, const Json& given, KeptResults& results) {
  if (const auto refusal = refuse_other_members(given, {"result", "row", "column"})) return *refusal;
  const std::string place = "parameters." + name;
  if (!given["result"].is_string()) return wrong_member(place + ".result", "the id of a result", given["result"]);
  const Json row = given.value("row", Json(0U));
  if (!row.is_number_unsigned()) return wrong_member(place + ".row", "a number from 0", row);
  const Json column = given.value("column", Json("value"));
  if (!column.is_string()) return wrong_member(place + ".column", "the name of a column", column);
  Reply<std::shared_ptr<Execution>> result = results.find(given["result"].get<std::string>());
  if (!result) return result.refusal();
  Result<Value> value = cell_of(**result, row.get<std::size_t>(), column.get<std::string>());
  if (!value) return refusal_of_cell(value.error());
  return SessionParameter(HostValue(*std::move(value)));
}

Reply<SessionParameters> parameters_of(const Json& given, const algebra3d::Registry& registry, KeptResults& results) {
  SessionParameters parameters;
  parameters.advice = "the request has no parameter '{}'";
  for (const auto& [name, value] : given.items()) {
    if (!is_identifier(name) || !value.is_object())
      return Refusal::bad_request(fmt::format("parameter '{}': expected a name and an object", name));
    Reply<SessionParameter> parameter =
        value.contains("result") ? cell_parameter(name, value, results) : constant_parameter(name, value, registry);
    if (!parameter) return parameter.refusal();
    parameters.values.emplace(name, *std::move(parameter));
  }
  return parameters;
}

}  // namespace

// A part of a result that a request names and that does not exist is `not_found`.
Refusal refusal_of_cell(const algebra3d::Error& error) {
  if (error.code == ErrorCode::unknown_name || error.code == ErrorCode::invalid_value)
    return Refusal::not_found(error.text());
  if (error.code == ErrorCode::interrupted) return {410, "gone", "the result was dropped"};
  return refusal_of(error);
}

Reply<Json> parse_body(const std::string& body) {
  // It says what is wrong, and where; and the parser below takes a zero byte for the end.
  const auto checked = algebra3d::JsonTree::parse(body, 0);
  if (!checked) return Refusal::bad_request("the body is not JSON: " + checked.error().text());
  bool is_too_deep = false;
  RepeatedKey repeated;
  const Json given = Json::parse(
      body,
      [&](int depth, Json::parse_event_t event, Json& parsed) {
        is_too_deep = is_too_deep || depth > kDeepest;
        if (!is_too_deep) repeated.note(event, parsed);
        return !is_too_deep;
      },
      false);
  if (is_too_deep) return Refusal::bad_request(fmt::format("the body is nested deeper than {} levels", kDeepest));
  if (repeated.found()) return Refusal::bad_request(fmt::format("the member '{}' is given twice", *repeated.found()));
  return given;
}

Result<Value> cell_of(Execution& result, std::size_t row, const std::string& column, const Connection* connection) {
  return result.ask<Value>(connection, [row, column](ResultTable& table, Context&) -> Result<Value> {
    A3D_ASSIGN(const Value value, cell(table, row, column));
    return value.loaded();
  });
}

bool is_id(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  const auto is_allowed = [](unsigned char c) { return (std::isalnum(c) != 0 && c < 0x80) || c == '-' || c == '_'; };
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, is_allowed);
}

Reply<StatementRequest> read_query_request(const std::string& body, const algebra3d::Registry& registry,
                                           KeptResults& results) {
  Reply<Json> parsed = parse_body(body);
  if (!parsed) return parsed.refusal();
  const Json given = *std::move(parsed);
  if (!given.is_object()) return wrong_member("body", "an object with the member 'statement'", given);
  if (const auto refusal = refuse_other_members(given, {"statement", "rows", "id", "parameters"})) return *refusal;
  const Json statement = given.value("statement", Json());
  if (!statement.is_string()) return wrong_member("statement", "a text", statement);
  const Json rows = given.value("rows", Json(100U));
  if (!rows.is_number_unsigned() || rows.get<std::uint64_t>() > kMostRows)
    return wrong_member("rows", fmt::format("a number from 0 to {}", kMostRows), rows);
  const Json id = given.value("id", Json(""));
  if (!id.is_string() || (given.contains("id") && !is_id(id.get<std::string>())))
    return wrong_member("id", kIdForm, id);
  const Json parameters = given.value("parameters", Json::object());
  if (!parameters.is_object()) return wrong_member("parameters", "an object", parameters);
  Reply<SessionParameters> read = parameters_of(parameters, registry, results);
  if (!read) return read.refusal();
  return StatementRequest{.id = id.get<std::string>(),
                          .text = statement.get<std::string>(),
                          .row_count = rows.get<std::size_t>(),
                          .parameters = *std::move(read)};
}

}  // namespace queries
