#include "queries/exchange/csv_presenter.h"

#include "base/propagate.h"
#include "queries/session/inquiry_table.h"
#include "queries/streams/nested_relations.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

std::string cell_of(const NestedList& list) {
  return list.is_string() ? list.as_string() : list.is_text() ? list.as_text() : list.print();
}

}  // namespace

Status CsvPresenter::present(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(const RelationPtr table, table_of(type, value));
  if (table != nullptr) return present_relation(type.element(), *table, context);
  std::string csv;
  if (const auto* single = std::get_if<Value>(&value.content)) {
    A3D_TRY(values_.append_csv_result(*single, context, csv));
  } else {
    A3D_ASSIGN(const NestedList list, value_list(type, value, context));
    append_csv_text(csv, list.print());
  }
  out_ << csv << "\n";
  return {};
}

Status CsvPresenter::present_relation(const TypeExpr& tuple, Relation& relation, Context& context) {
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  const auto& attributes = tuple.attributes();
  for (const auto& [name, attribute] : attributes)
    if (attribute.is_nested_relation()) return no_nested_in_csv(name);
  std::string csv;
  for (std::size_t i = 0; values_.options().has_header && i < attributes.size(); ++i)
    csv += (i > 0 ? "," : "") + attributes[i].name + (i + 1 == attributes.size() ? "\n" : "");
  Status status = write_tuples(tuple, *tuples, context, csv);
  out_ << csv;
  return status;
}

// Leaves in `csv` what is not written yet: whole lines, but behind an error.
Status CsvPresenter::write_tuples(const TypeExpr& tuple, TupleStream& tuples, Context& context, std::string& csv) {
  const auto& attributes = tuple.attributes();
  while (out_) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr next, tuples.next());
    if (next == nullptr) break;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      if (i > 0) csv += ',';
      A3D_TRY(values_.append_csv(next->attributes[i], attributes[i].name, context, csv));
    }
    csv += '\n';
    if (csv.size() < kBytesAtOnce) continue;
    out_ << csv;
    csv.clear();
  }
  return {};
}

Status CsvPresenter::present_inquiry(const NestedList& result) {
  const InquiryTable table = inquiry_table(result);
  std::string csv;
  for (std::size_t i = 0; values_.options().has_header && i < table.columns.size(); ++i)
    csv += (i > 0 ? "," : "") + table.columns[i] + (i + 1 == table.columns.size() ? "\n" : "");
  for (const NestedList::List& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) csv += ',';
      append_csv_text(csv, cell_of(row[i]));
    }
    csv += '\n';
  }
  out_ << csv;
  return {};
}

}  // namespace queries
