#pragma once

#include <ostream>
#include <string>

#include "queries/exchange/exchange_values.h"
#include "queries/streams/datum.h"

namespace queries {

/// Appends a tuple as a JSON object, its attributes in their order. Errors: those of the store.
Status append_json_row(const TypeExpr& tuple, const Tuple& row, ExchangeValues& values, Context& context,
                       std::string& json);

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
  void begin_row(std::string& json, bool is_first) const;
  void end_rows(std::string& json, bool is_empty) const;

  std::ostream& out_;
  ExchangeValues& values_;
  Layout layout_;
};

}  // namespace queries
