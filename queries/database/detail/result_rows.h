#pragma once

#include "base/diagnostics.h"
#include "queries/database/detail/handover.h"
#include "queries/session/session.h"

namespace algebra3d::database::detail {

/// A presenter that converts the result of a statement to rows: a relation or stream tuple by tuple, an inquiry as a
/// table, any other result as one row with the column `value`. The statement ends, and is committed, when the end of
/// the rows is asked for.
class ResultRows final : public queries::Presenter {
 public:
  enum class Wanted : std::uint8_t { rows, single_value };
  /// With `single_value` any other result is the error type_error, and only queries run.
  ResultRows(Handover& handover, Wanted wanted) : handover_(handover), is_single_(wanted == Wanted::single_value) {}

  Status present(const TypeExpr& type, const queries::Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;
  bool takes_streams() const override { return true; }
  bool takes_queries_only() const override { return is_single_; }
  bool can_begin_again() const override { return !has_rows_; }
  void advance(const std::string& how_far) override { handover_.tell(how_far); }

 private:
  Status present_tuples(const TypeExpr& tuple, queries::TupleStream& tuples, Context& context);
  Status present_elements(const TypeExpr& element, queries::ValueStream& elements, Context& context);
  Status present_one(const TypeExpr& type, const queries::Datum& value, Context& context);
  void begin(std::vector<Column> columns);
  Status add(const std::vector<algebra3d::Value>& values, const Context& context);
  Status flush();
  Status end(const Context& context);
  std::string reason_since_last_row(const Diagnostics& diagnostics);

  Handover& handover_;
  bool is_single_;
  bool has_rows_ = false;
  ColumnsPtr columns_;
  std::vector<Row> batch_;
  std::size_t batch_rows_ = 1;   // grows, so that the first row comes early
  std::size_t batch_bytes_ = 0;  // estimated size of the batch
  std::uint64_t reasons_before_ = 0;
};

/// A presenter that pulls a result to its end and discards it.
class DroppedResult final : public queries::Presenter {
 public:
  explicit DroppedResult(Handover& handover) : handover_(handover) {}

  Status present(const TypeExpr& type, const queries::Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& /*result*/) override { return {}; }
  bool takes_streams() const override { return true; }
  bool ends_at_failed_result() const override { return true; }
  bool can_begin_again() const override { return true; }
  bool shows_inquiries() const override { return false; }
  void advance(const std::string& how_far) override { handover_.tell(how_far); }

 private:
  Handover& handover_;
};

}  // namespace algebra3d::database::detail
