#include "queries/exchange/json_presenter.h"

#include "base/propagate.h"
#include "queries/exchange/json_text.h"
#include "queries/session/inquiry_table.h"
#include "queries/streams/nested_relations.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

void append_key(std::string& json, bool is_first, std::string_view key) {
  json += is_first ? "{" : ",";
  append_json_string(json, key);
  json += ':';
}

}  // namespace

Status append_json_row(const TypeExpr& tuple, const Tuple& row, ExchangeValues& values, Context& context,
                       std::string& json) {
  if (row.attributes.empty()) json += '{';
  for (std::size_t i = 0; i < row.attributes.size(); ++i) {
    const std::string& name = tuple.attributes()[i].name;
    append_key(json, i == 0, name);
    A3D_TRY(values.append_json(row.attributes[i], name, context, json));
  }
  json += '}';
  return {};
}

Status JsonPresenter::present(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(const RelationPtr table, table_of(type, value));
  if (table != nullptr) return present_relation(type.element(), *table, context);
  std::string json;
  if (const auto* single = std::get_if<Value>(&value.content)) {
    A3D_TRY(values_.append_json_result(*single, context, json));
  } else {
    A3D_ASSIGN(const NestedList list, value_list(type, value, context));
    // A function is a text of the language; the parts of an index are names and a number.
    append_json(json, type.is_function() ? NestedList::text(list.print()) : list);
  }
  out_ << json << "\n";
  return {};
}

void JsonPresenter::begin_row(std::string& json, bool is_first) const {
  if (layout_ == Layout::document) json += is_first ? "[" : ",\n";
}

void JsonPresenter::end_rows(std::string& json, bool is_empty) const {
  if (layout_ == Layout::document) json += is_empty ? "[]\n" : "]\n";
}

Status JsonPresenter::present_relation(const TypeExpr& tuple, Relation& relation, Context& context) {
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  std::string json;
  Status status = write_tuples(tuple, *tuples, context, json);
  // Rows read before an error are shown: an array that is not closed is noticed, nothing at all might not be.
  out_ << json << (status ? "" : "\n");
  return status;
}

// Leaves in `json` what is not written yet.
Status JsonPresenter::write_tuples(const TypeExpr& tuple, TupleStream& tuples, Context& context, std::string& json) {
  bool is_empty = true;
  while (out_) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr next, tuples.next());
    if (next == nullptr) break;
    begin_row(json, is_empty);
    is_empty = false;
    A3D_TRY(append_json_row(tuple, *next, values_, context, json));
    if (layout_ == Layout::lines) json += '\n';
    if (json.size() < kBytesAtOnce) continue;
    out_ << json;
    json.clear();
  }
  end_rows(json, is_empty);
  return {};
}

Status JsonPresenter::present_inquiry(const NestedList& result) {
  const InquiryTable table = inquiry_table(result);
  std::string json;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    begin_row(json, row == 0);
    for (std::size_t i = 0; i < table.rows[row].size(); ++i) {
      append_key(json, i == 0, table.columns[i]);
      append_json(json, table.rows[row][i]);
    }
    json += layout_ == Layout::lines ? "}\n" : "}";
  }
  end_rows(json, table.rows.empty());
  out_ << json;
  return {};
}

}  // namespace queries
