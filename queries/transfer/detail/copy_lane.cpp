#include "queries/transfer/detail/copy_lane.h"

#include "base/propagate.h"

namespace queries {
namespace {

constexpr std::string_view kLockTimeout = "55P03";

}  // namespace

Status CopyLane::store(Batch batch, const std::string& before_copy_sql, const std::string& copy_sql) {
  state_ = State::storing;
  record_sql_ = std::move(batch.record_sql);
  const auto taken = [expected = batch.row_count](const std::string& affected) {
    return Error{ErrorCode::io_error,
                 "the server has stored {} of {} rows: a rule or trigger of the table takes the others", affected,
                 expected};
  };
  return lane_.add({"BEGIN; " + before_copy_sql + copy_sql, std::move(batch.rows), batch.row_count, taken});
}

Status CopyLane::commit() {
  state_ = State::committing;
  const auto is_busy = [](const std::string&) {
    return Error{ErrorCode::database_busy, "another push of the same relation into the same table is at work"};
  };
  A3D_TRY(lane_.add({std::move(record_sql_), {}, 1, is_busy}));
  A3D_TRY(lane_.add({"COMMIT"}));
  return advance();
}

Status CopyLane::advance() {
  if (state_ == State::free || state_ == State::stored) return {};
  Status status = lane_.advance();
  if (!status && lane_.sql_state() == kLockTimeout)
    return Error{
        ErrorCode::io_error,
        "another session, or a later batch with the same keys, has kept a row of the table locked for seconds; "
        "with --connections 1 the server says which key is there twice"};
  if (status && lane_.is_idle()) state_ = state_ == State::storing ? State::stored : State::free;
  return status;
}

}  // namespace queries
