#include "queries/database/detail/result_rows.h"

#include <algorithm>
#include <utility>

#include "algebra3d/values/types/scalars.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/database/detail/value_content.h"
#include "queries/session/inquiry_table.h"
#include "queries/session/plan.h"
#include "queries/streams/collection.h"
#include "queries/streams/relation.h"

namespace algebra3d::database::detail {
namespace {

// Rows and bytes in a batch: enough that handing it over takes no time worth mentioning.
constexpr std::size_t kMostRows = 256;
constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

Column column(std::string name, const TypeExpr& type) {
  return {std::move(name), type.text()};
}

std::uint64_t reason_count(const Diagnostics& diagnostics) {
  using About = Diagnostics::About;
  return diagnostics.count(About::undefined) + diagnostics.count(About::unreadable);
}

Error no_single_value(std::string_view found) {
  return {ErrorCode::type_error, "expected a single value, got {}", found};
}

// The type of a column of an inquiry: that of its cells if all are numbers, else text.
std::string type_of_column(const queries::InquiryTable& table, std::size_t index) {
  const auto all_are = [&](bool (NestedList::*is_kind)() const) {
    return !table.rows.empty() && std::ranges::all_of(table.rows, [&](const NestedList::List& row) {
      return index < row.size() && (row[index].*is_kind)();
    });
  };
  return all_are(&NestedList::is_int) ? "int" : all_are(&NestedList::is_real) ? "real" : "text";
}

algebra3d::Value inquiry_cell(const NestedList& cell, const std::string& type) {
  if (type == "int") return algebra3d::Value::of<std::int64_t>(cell.as_int());
  if (type == "real") return algebra3d::Value::of<double>(cell.as_real());
  return algebra3d::Value::of<Text>({cell.is_text()     ? cell.as_text()
                                     : cell.is_string() ? cell.as_string()
                                                        : cell.print()});
}

}  // namespace

Status ResultRows::present(const TypeExpr& type, const queries::Datum& value, Context& context) {
  if (type.is_relation()) {
    A3D_ASSIGN(const queries::TupleStreamPtr tuples, value.relation()->scan());
    return present_tuples(type.element(), *tuples, context);
  }
  if (const auto* tuples = std::get_if<queries::TupleStreamPtr>(&value.content))
    return present_tuples(type.element(), **tuples, context);
  if (const auto* elements = std::get_if<queries::ValueStreamPtr>(&value.content))
    return present_elements(type.element(), **elements, context);
  if (queries::is_collection(type))
    return present_elements(type.arguments().front(), *queries::elements_of(value.value()), context);
  return present_one(type, value, context);
}

Status ResultRows::present_tuples(const TypeExpr& tuple, queries::TupleStream& tuples, Context& context) {
  std::vector<Column> columns;
  for (const auto& [name, type] : tuple.attributes()) columns.push_back(column(name, type));
  begin(std::move(columns));
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const queries::TuplePtr next, tuples.next());
    if (next == nullptr) return end(context);
    A3D_TRY(add(next->attributes, context));
  }
}

Status ResultRows::present_elements(const TypeExpr& element, queries::ValueStream& elements, Context& context) {
  begin({column("value", element)});
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const auto next, elements.next());
    if (!next) return end(context);
    A3D_TRY(add({*next}, context));
  }
}

// Functions and indexes have no values of their own, only a notation.
Status ResultRows::present_one(const TypeExpr& type, const queries::Datum& value, Context& context) {
  begin({column("value", type)});
  if (const auto* single = std::get_if<algebra3d::Value>(&value.content)) {
    A3D_TRY(add({*single}, context));
  } else {
    A3D_ASSIGN(const NestedList list, queries::value_list(type, value, context));
    A3D_TRY(add({algebra3d::Value::of<Text>({list.print()})}, context));
  }
  return end(context);
}

Status ResultRows::present_inquiry(const NestedList& result) {
  const queries::InquiryTable table = queries::inquiry_table(result);
  std::vector<Column> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    columns.push_back({table.columns[i], type_of_column(table, i)});
  begin(columns);
  Diagnostics none;
  const Context context{none, nullptr, {}};
  for (const NestedList::List& row : table.rows) {
    std::vector<algebra3d::Value> values;
    values.reserve(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      values.push_back(i < row.size() ? inquiry_cell(row[i], columns[i].type) : algebra3d::Value(TypeOf<Text>::type()));
    A3D_TRY(add(values, context));
  }
  return end(context);
}

void ResultRows::begin(std::vector<Column> columns) {
  columns_ = std::make_shared<const std::vector<Column>>(std::move(columns));
  handover_.put_columns(columns_);
}

Status ResultRows::add(const std::vector<algebra3d::Value>& values, const Context& context) {
  if (std::exchange(has_rows_, true) && is_single_) return no_single_value("several rows");
  std::vector<Value> row;
  row.reserve(values.size());
  std::string reason = reason_since_last_row(context.diagnostics);
  for (const algebra3d::Value& value : values) {
    A3D_ASSIGN(const algebra3d::Value loaded, value.loaded());
    batch_bytes_ += heap_bytes(loaded);
    row.push_back(ValueAccess::outer(loaded, loaded.is_defined() ? std::string() : reason));
  }
  batch_.emplace_back(columns_, std::move(row));
  return batch_.size() >= batch_rows_ || batch_bytes_ >= kMostBytes ? flush() : Status();
}

// The reason of a row's undefined values: what became undefined while the row was made.
std::string ResultRows::reason_since_last_row(const Diagnostics& diagnostics) {
  const std::uint64_t before = std::exchange(reasons_before_, reason_count(diagnostics));
  return reasons_before_ > before ? diagnostics.last_reason() : std::string();
}

Status ResultRows::flush() {
  if (batch_.empty()) return {};
  batch_rows_ = std::min(2 * batch_rows_, kMostRows);
  batch_bytes_ = 0;
  return handover_.put_rows(std::exchange(batch_, {}));
}

// An error, also a wish to cancel that came while nobody asked, undoes the statement.
Status ResultRows::end(const Context& context) {
  if (is_single_ && !has_rows_) return no_single_value("no row");
  if (is_single_ && columns_->size() != 1) return no_single_value("a row of several values");
  A3D_TRY(flush());
  A3D_TRY(handover_.await_end());
  return context.check_cancelled();
}

Status DroppedResult::present(const TypeExpr&, const queries::Datum& value, Context& context) {
  return queries::exhaust(value, context);
}

}  // namespace algebra3d::database::detail
