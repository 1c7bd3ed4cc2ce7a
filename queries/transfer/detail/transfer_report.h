#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "base/progress_display.h"
#include "queries/transfer/detail/row_digest.h"
#include "queries/transfer/detail/server_connection.h"
#include "queries/transfer/transfer.h"

namespace queries {

/// What a transfer tells people, and its exit status.
class TransferReport {
 public:
  /// `command`: "push" or "pull", a literal.
  TransferReport(const TransferHost& host, bool is_quiet, std::string_view command);

  void note(const std::string& text);
  /// `target`: where the rows are to be, once that is known; `total`: all rows, where that is known.
  void begin(std::string_view target, std::uint64_t before_count, std::uint64_t total);
  /// Whether the same command goes on after an error, as it does after an interrupt in any case.
  void set_resumable(bool can_be_resumed) { can_be_resumed_ = can_be_resumed; }
  /// Rows that were committed, and rows that were moved but are not committed yet; `bytes` of both.
  void advance(std::uint64_t committed, std::uint64_t pending, std::uint64_t bytes);
  /// Says what is done where rows do not advance: "comparing checksums".
  void work_at(const std::string& what);
  /// The exit status after an error or interrupt, which is shown with the way to go on.
  int fail(const Error& error);
  /// The summary. `digest`: of all rows on both sides.
  void conclude(const std::string& source, const RowDigest& digest);

 private:
  double seconds() const;
  double part() const;
  std::string figures(std::uint64_t pending) const;

  const TransferHost& host_;
  bool is_quiet_;
  std::string_view command_;
  algebra3d::ProgressDisplay progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string target_;
  bool can_be_resumed_ = false;
  std::uint64_t before_ = 0, total_ = 0, committed_ = 0, bytes_ = 0;
};

/// Runs a transfer: turns interrupts, lack of memory and exceptions into the exit status.
int reported(TransferReport& report, const TransferHost& host, const std::function<Status()>& transfer);

}  // namespace queries
