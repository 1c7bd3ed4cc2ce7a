#include "queries/transfer/detail/copy_lane.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/propagate.h"

namespace queries {
namespace {

constexpr std::string_view kLockTimeout = "55P03";
/// Rows are given to libpq in pieces, since it keeps what the network does not take yet.
constexpr std::size_t kPiece = std::size_t{1} << 16U;

}  // namespace

Status CopyLane::store(Batch batch, const std::string& before_copy_sql, const std::string& copy_sql) {
  batch_ = std::move(batch);
  sent_ = 0;
  has_sent_end_ = false;
  state_ = State::opening;
  return connection_->send("BEGIN; " + before_copy_sql + copy_sql);
}

Status CopyLane::commit() {
  state_ = State::recording;
  A3D_TRY(connection_->send(batch_.record_sql));
  return advance();
}

Status CopyLane::advance() {
  if (state_ == State::free || state_ == State::stored) return {};
  const Libpq& pq = connection_->pq();
  if (state_ == State::sending) A3D_TRY(send_rows());
  const int flushed = pq.flush(connection_->handle());
  if (flushed < 0) return connection_->lost();
  is_writing_ = flushed > 0 || state_ == State::sending;
  if (pq.consume_input(connection_->handle()) == 0 && pq.is_busy(connection_->handle()) != 0)
    return connection_->lost();
  if (state_ == State::sending) return {};
  return take_answers();
}

Status CopyLane::send_rows() {
  const Libpq& pq = connection_->pq();
  while (sent_ < batch_.rows.size()) {
    const int flushed = pq.flush(connection_->handle());
    if (flushed < 0) return connection_->lost();
    if (flushed > 0) return {};
    const std::size_t size = std::min(kPiece, batch_.rows.size() - sent_);
    const int put = pq.put_copy_data(connection_->handle(), batch_.rows.data() + sent_, static_cast<int>(size));
    if (put < 0) return connection_->lost();
    if (put == 0) return {};
    sent_ += size;
  }
  const int ended = pq.put_copy_end(connection_->handle(), nullptr);
  if (ended < 0) return connection_->lost();
  if (ended == 0) return {};
  batch_.rows = std::string();
  state_ = State::ending;
  return {};
}

Status CopyLane::take_answers() {
  while (state_ != State::free && state_ != State::stored && state_ != State::sending) {
    bool is_ready = false;
    A3D_ASSIGN(const auto answer, connection_->next_answer_if_ready(is_ready));
    if (!is_ready) return {};
    if (answer)
      A3D_TRY(take(*answer));
    else
      A3D_TRY(end_of_answers());
  }
  return {};
}

Status CopyLane::take(const ServerAnswer& answer) {
  if (answer.sql_state() == kLockTimeout)
    return Error{
        ErrorCode::io_error,
        "another session, or a later batch with the same keys, has kept a row of the table locked for seconds; "
        "with --connections 1 the server says which key is there twice"};
  A3D_TRY(answer.check());
  if (state_ == State::opening && answer.status() == Libpq::kCopyIn) {
    state_ = State::sending;
    return advance();
  }
  if (state_ == State::ending && answer.affected() != std::to_string(batch_.row_count))
    return Error{ErrorCode::io_error,
                 "the server has stored {} of {} rows: a rule or trigger of the table takes the others",
                 answer.affected(), batch_.row_count};
  if (state_ == State::recording && answer.affected() != "1")
    return Error{ErrorCode::database_busy, "another push of the same relation into the same table is at work"};
  return {};
}

Status CopyLane::end_of_answers() {
  switch (state_) {
    case State::ending:
      state_ = State::stored;
      return {};
    case State::recording:
      state_ = State::committing;
      A3D_TRY(connection_->send("COMMIT"));
      return advance();
    case State::committing:
      state_ = State::free;
      return {};
    default:
      return Error{ErrorCode::internal, "the server has answered less than was asked"};
  }
}

}  // namespace queries
