#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/database/database.h"

namespace algebra3d::database::detail {

using ColumnsPtr = std::shared_ptr<const std::vector<Column>>;
using Tell = std::function<void(const std::string& how_far)>;

/// The queue between the thread that runs a statement and the thread that waits for its results: columns, batches of
/// rows, progress, and the end. It holds at most one batch, so a statement is at most two batches ahead.
class Handover {
 public:
  // Called by the thread that runs the statement.

  void put_columns(ColumnsPtr columns);
  /// Adds a batch after the previous one has been taken. Errors: interrupted if no more rows are wanted.
  Status put_rows(std::vector<Row> rows);
  /// Waits until all rows have been taken and more are asked for: only then the statement may end and keep its changes.
  /// Errors: interrupted if no more rows are wanted.
  Status await_end();
  void tell(const std::string& how_far);
  void finish(Status status, Report report);

  // Called by the thread that waits. `tell` is called on it, and may be empty or throw.

  /// Waits for the columns; null if the statement ends without a result.
  ColumnsPtr wait_for_columns(const Tell& tell);
  /// Waits for the next batch; nothing when the statement has ended.
  std::optional<std::vector<Row>> take_rows(const Tell& tell);
  /// Ends the statement and waits for its end.
  void abandon();

  // The status of the statement, after its end.
  Status& status() { return status_; }
  Report& report() { return report_; }

 private:
  template <typename Condition>
  void wait_until(std::unique_lock<std::mutex>& lock, const Tell& tell, const Condition& condition);

  std::mutex mutex_;
  std::condition_variable changed_;
  ColumnsPtr columns_;
  std::optional<std::vector<Row>> rows_;
  std::optional<std::string> how_far_;
  bool is_asked_ = false;  // somebody waits for rows
  bool is_finished_ = false;
  bool is_abandoned_ = false;
  Status status_;
  Report report_;
};

}  // namespace algebra3d::database::detail
