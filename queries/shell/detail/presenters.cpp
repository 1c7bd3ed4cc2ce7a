#include "queries/shell/detail/presenters.h"
#include "queries/exchange/exchange_values.h"

#include <fmt/format.h>

#include "base/propagate.h"
#include "queries/session/result_text.h"
#include "queries/shell/detail/inquiry_text.h"
#include "queries/shell/detail/screen.h"
#include "queries/shell/detail/table.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

// Widths are found per piece, so that the first rows appear before the last ones are read.
constexpr std::size_t kRowsPerPiece = 200;

TextTable empty_table(const TypeExpr& tuple) {
  std::vector<std::string> header;
  std::vector<bool> is_number;
  for (const auto& [name, type] : tuple.attributes()) {
    header.push_back(name);
    is_number.push_back(type.is("int") || type.is("real"));
  }
  return {std::move(header), std::move(is_number)};
}

}  // namespace

Status ListPresenter::present(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(const std::string result, result_text(type, value, context));
  out_ << result << "\n";
  return {};
}

Status ListPresenter::present_inquiry(const NestedList& result) {
  out_ << result.print() << "\n";
  return {};
}

Status TablePresenter::present(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(const RelationPtr table, table_of(type, value));
  if (table != nullptr) return present_relation(type.element(), *table, context);
  // A value alone is shown with all its digits, unless it is geometry.
  if (const auto* single = std::get_if<Value>(&value.content); single != nullptr && is_summarised(*single)) {
    out_ << display_text(*single) << "\n";
    return {};
  }
  A3D_ASSIGN(const std::string result, value_text(type, value, context));
  if (type.is_function() || is_index(type)) out_ << type.text() << "\n";
  out_ << printable(result) << "\n";
  return {};
}

Status TablePresenter::present_relation(const TypeExpr& tuple, Relation& relation, Context& context) {
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  const std::size_t width = columns_();
  const std::size_t longest = width == kNoLimit ? kNoLimit : kLongestCell;
  std::size_t count = 0;
  TextTable table = empty_table(tuple);
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr next, tuples->next());
    if (next != nullptr) {
      std::vector<std::string> row;
      for (const Value& attribute : next->attributes) row.push_back(display_text(attribute, longest));
      table.add(std::move(row));
      if (++count % kRowsPerPiece != 0) continue;
    }
    if (count == 0 || next != nullptr || count % kRowsPerPiece != 0) out_ << table.print(width);
    if (next == nullptr || !out_) break;
    table = empty_table(tuple);
  }
  out_ << fmt::format("({} {})\n", count, count == 1 ? "tuple" : "tuples");
  return {};
}

Status TablePresenter::present_inquiry(const NestedList& result) {
  out_ << inquiry_text(result, columns_());
  return {};
}

}  // namespace queries
