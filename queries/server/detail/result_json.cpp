#include "queries/server/detail/result_json.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "algebra3d/values/display/shape_of_value.h"
#include "base/propagate.h"
#include "queries/exchange/exchange_values.h"
#include "queries/exchange/json_presenter.h"
#include "queries/exchange/json_text.h"

namespace queries {

using algebra3d::Context;

namespace {

/// A cell with a longer nested relation has its number of tuples only.
const ExchangeOptions kCells = {.most_nested_tuples = 1000};

// The presenter ends its document with a line end.
std::string without_line_end(std::string json) {
  while (json.ends_with('\n')) json.pop_back();
  return json;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string json;
  append_json_string(json, text);
  return json;
}

std::string json_strings(const std::vector<std::string>& texts) {
  std::string json = "[";
  for (const std::string& text : texts) {
    if (json.size() > 1) json += ',';
    append_json_string(json, text);
  }
  return json + "]";
}

Result<std::string> json_of_rows(ResultTable& table, std::size_t from, std::size_t count, Context& context) {
  ExchangeValues values(kCells);
  std::string json = "[";
  const std::size_t end = std::min(table.count(), from + count);
  for (std::size_t i = from; i < end && json.size() < kMostRowBytes; ++i) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr tuple, table.row(i));
    if (i > from) json += ',';
    A3D_TRY(append_json_row(table.tuple_type(), *tuple, values, context, json));
  }
  return json + "]";
}

Result<std::string> json_of_single(ResultTable& table, Context& context) {
  ExchangeValues values(kCells);
  std::string json;
  A3D_ASSIGN(const TuplePtr tuple, table.row(0));
  A3D_TRY(values.append_json(tuple->attributes.front(), "value", context, json));
  return json;
}

Result<std::string> json_of_other(const TypeExpr& type, const Datum& value, Context& context) {
  std::ostringstream out;
  ExchangeValues values(kCells);
  A3D_TRY(JsonPresenter(out, values, JsonPresenter::Layout::document).present(type, value, context));
  return without_line_end(std::move(out).str());
}

std::string json_of_inquiry(const algebra3d::NestedList& result) {
  std::ostringstream out;
  ExchangeValues values(kCells);
  // Writing to a string does not fail.
  (void)JsonPresenter(out, values, JsonPresenter::Layout::document).present_inquiry(result);
  return without_line_end(std::move(out).str());
}

bool is_drawn(const TypeExpr& type, const algebra3d::Registry& registry) {
  const algebra3d::Type* const known = registry.value_type(type);
  return known != nullptr && algebra3d::is_drawable(*known);
}

std::string json_of_columns(const TypeExpr& tuple, const algebra3d::Registry& registry) {
  std::string json = "[";
  for (const auto& [name, type] : tuple.attributes()) {
    if (json.size() > 1) json += ',';
    json += fmt::format(R"({{"name":{},"type":{},"shape":{}}})", json_string(name), json_string(type.text()),
                        is_drawn(type, registry));
  }
  return json + "]";
}

bool has_drawn_column(const TypeExpr& tuple, const algebra3d::Registry& registry) {
  return std::ranges::any_of(tuple.attributes(),
                             [&](const auto& attribute) { return is_drawn(attribute.type, registry); });
}

bool has_geometry(const TypeExpr& tuple, const algebra3d::Registry& registry) {
  return std::ranges::any_of(tuple.attributes(), [&](const auto& attribute) {
    const algebra3d::Type* const known = registry.value_type(attribute.type);
    if (known == nullptr) return false;
    return algebra3d::is_drawable(*known) || !known->summary_unit().empty() || attribute.type.is_nested_relation();
  });
}

}  // namespace queries
