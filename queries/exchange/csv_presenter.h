#pragma once

#include <ostream>
#include <string>

#include "queries/exchange/exchange_values.h"

namespace queries {

/// Presents results as CSV: a relation as a line of attribute names and a line per tuple, a single value as one cell.
/// Lines end with a line feed. Undefined is an empty cell, the empty string is `""`. Rows are written as they are read.
/// Source: [rfc4180].
class CsvPresenter final : public Presenter {
 public:
  CsvPresenter(std::ostream& out, ExchangeValues& values) : out_(out), values_(values) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;

 private:
  Status present_relation(const TypeExpr& tuple, Relation& relation, Context& context);
  Status write_tuples(const TypeExpr& tuple, TupleStream& tuples, Context& context, std::string& csv);

  std::ostream& out_;
  ExchangeValues& values_;
};

}  // namespace queries
