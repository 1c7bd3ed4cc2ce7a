#include "queries/transfer/detail/statement_lane.h"

#include <algorithm>
#include <utility>

#include "base/propagate.h"

namespace queries {
namespace {

/// Rows are given to libpq in pieces, since it keeps what the network does not take yet.
constexpr std::size_t kPiece = std::size_t{1} << 16U;

}  // namespace

Status StatementLane::add(Step step) {
  steps_.push_back(std::move(step));
  return steps_.size() == 1 ? start() : Status();
}

Status StatementLane::start() {
  sent_ = 0;
  affected_.clear();
  return connection_->send(steps_.front().sql);
}

Status StatementLane::advance() {
  if (is_idle()) return {};
  const Libpq& pq = connection_->pq();
  if (is_sending_) A3D_TRY(send_rows());
  const int flushed = pq.flush(connection_->handle());
  if (flushed < 0) return connection_->lost();
  is_writing_ = flushed > 0 || is_sending_;
  if (pq.consume_input(connection_->handle()) == 0 && pq.is_busy(connection_->handle()) != 0)
    return connection_->lost();
  if (is_sending_) return {};
  return take_answers();
}

Status StatementLane::send_rows() {
  const Libpq& pq = connection_->pq();
  std::string& rows = steps_.front().rows;
  while (sent_ < rows.size()) {
    const int flushed = pq.flush(connection_->handle());
    if (flushed < 0) return connection_->lost();
    if (flushed > 0) return {};
    const std::size_t size = std::min(kPiece, rows.size() - sent_);
    const int put = pq.put_copy_data(connection_->handle(), rows.data() + sent_, static_cast<int>(size));
    if (put < 0) return connection_->lost();
    if (put == 0) return {};
    sent_ += size;
  }
  const int ended = pq.put_copy_end(connection_->handle(), nullptr);
  if (ended < 0) return connection_->lost();
  if (ended == 0) return {};
  rows = std::string();
  is_sending_ = false;
  return {};
}

Status StatementLane::take_answers() {
  while (!is_idle() && !is_sending_) {
    bool is_ready = false;
    A3D_ASSIGN(const auto answer, connection_->next_answer_if_ready(is_ready));
    if (!is_ready) return {};
    if (answer) {
      A3D_TRY(take(*answer));
      continue;
    }
    const Step ended = std::move(steps_.front());
    steps_.pop_front();
    if (ended.changed && affected_ != std::to_string(*ended.changed)) return ended.when_others_changed(affected_);
    if (!steps_.empty()) {
      A3D_TRY(start());
      return advance();
    }
  }
  return {};
}

Status StatementLane::take(const ServerAnswer& answer) {
  sql_state_ = answer.sql_state();
  A3D_TRY(answer.check());
  affected_ = answer.affected();
  if (answer.status() != Libpq::kCopyIn) return {};
  is_sending_ = true;
  return advance();
}

}  // namespace queries
