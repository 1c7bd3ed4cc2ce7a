#pragma once

#include <ostream>
#include <string>

#include "queries/shell/detail/exchange_values.h"

namespace queries {

/// Presents results as JSON: one document per statement. A relation is an array of objects, one per line; as JSON lines
/// only the objects. Inquiries are relations, too. Rows are written as they are read. An error in the middle of a
/// relation leaves the array unclosed, so that readers notice it.
class JsonPresenter final : public Presenter {
 public:
  enum class Layout : std::uint8_t { document, lines };

  JsonPresenter(std::ostream& out, ExchangeValues& values, Layout layout)
      : out_(out), values_(values), layout_(layout) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;

 private:
  Status present_relation(const TypeExpr& tuple, Relation& relation, Context& context);
  Status write_tuples(const TypeExpr& tuple, TupleStream& tuples, Context& context, std::string& json);
  Status append_tuple(const TypeExpr& type, const Tuple& tuple, Context& context, std::string& json);
  void begin_row(std::string& json, bool is_first) const;
  void end_rows(std::string& json, bool is_empty) const;

  std::ostream& out_;
  ExchangeValues& values_;
  Layout layout_;
};

}  // namespace queries
