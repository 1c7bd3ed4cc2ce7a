#include "queries/transfer/detail/transfer_report.h"

#include <unistd.h>

#include <exception>
#include <iostream>
#include <new>

#include <fmt/format.h>

#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/propagate.h"
#include "base/text.h"

namespace queries {
namespace {

constexpr int kDone = 0;
constexpr int kTransferFailed = 1;
constexpr int kUsedWrongly = 2;
constexpr int kEndedBySignal = 130;

using algebra3d::grouped;

}  // namespace

TransferReport::TransferReport(const TransferHost& host, bool is_quiet, std::string_view command)
    : host_(host),
      is_quiet_(is_quiet),
      command_(command),
      progress_(host.err, algebra3d::ProgressDisplay::usual_style(is_quiet, host.err_is_terminal), command) {}

void TransferReport::note(const std::string& text) {
  progress_.clear();
  host_.err << "note: " << algebra3d::one_line(text) << "\n";
}

void TransferReport::begin(std::string_view target, std::uint64_t before_count, std::uint64_t total) {
  target_ = algebra3d::one_line(target);
  before_ = before_count;
  total_ = total;
}

double TransferReport::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double TransferReport::part() const {
  return total_ == 0 ? 0 : static_cast<double>(before_ + committed_) / static_cast<double>(total_);
}

std::string TransferReport::figures(std::uint64_t pending) const {
  const double rate = seconds() > 0 ? static_cast<double>(bytes_) / 1e6 / seconds() : 0;
  return fmt::format("{}{} rows, {:.1f} MB/s, {} on their way", before_ + committed_,
                     total_ > 0 ? fmt::format("/{}", total_) : "", rate, pending);
}

void TransferReport::advance(std::uint64_t committed, std::uint64_t pending, std::uint64_t bytes) {
  committed_ = committed;
  bytes_ = bytes;
  progress_.update(part(), [&] { return figures(pending); });
}

void TransferReport::work_at(const std::string& what) {
  progress_.update(part(), [&] { return what; });
}

// Names and messages of a server are shown without what could control a terminal.
int TransferReport::fail(const Error& error) {
  progress_.clear();
  const bool is_interrupt = error.code == ErrorCode::interrupted;
  if (!is_interrupt) host_.err << "error: " << command_ << ": " << algebra3d::one_line(error.text()) << "\n";
  const std::string far = target_.empty()
                              ? "nothing was copied"
                              : fmt::format(
                                    "{}{} rows are in {}; run the same {} again, without --replace, to go on from "
                                    "there",
                                    grouped(before_ + committed_),
                                    total_ > 0 ? fmt::format(" of {}", grouped(total_)) : "", target_, command_);
  if (is_interrupt) {
    host_.err << "interrupted: " << far << "\n";
    return kEndedBySignal;
  }
  if (can_be_resumed_) host_.err << far << "\n";
  return error.code == ErrorCode::wrong_usage ? kUsedWrongly : kTransferFailed;
}

void TransferReport::conclude(const std::string& source, const RowDigest& digest) {
  progress_.clear();
  if (is_quiet_) return;
  const auto row = [&](std::string_view label, std::string_view value) {
    host_.out << fmt::format("  {:<28}{:>16}\n", label, value);
  };
  host_.out << fmt::format("{} of {} into {}\n", command_, algebra3d::one_line(source), target_);
  row("rows", grouped(digest.count));
  if (before_ > 0) row("  of these before", grouped(before_));
  row("MB", fmt::format("{:.1f}", static_cast<double>(bytes_) / 1e6));
  row("seconds", fmt::format("{:.1f}", seconds()));
  row("checksum on both sides", fmt::format("{:016x}", digest.checksum));
  host_.out << std::flush;
}

int reported(TransferReport& report, const TransferHost& host, const std::function<Status()>& transfer) {
  const algebra3d::InterruptionScope scope(host.cancel);
  Status status;
  try {
    status = algebra3d::as_interrupted(transfer);
  } catch (const std::bad_alloc& failure) {
    status = algebra3d::memory_error(failure);
  } catch (const std::exception& exception) {
    status = Error{ErrorCode::internal, "{}", exception.what()};
  }
  return status ? kDone : report.fail(status.error());
}

namespace {

TransferHost standard_host(const algebra3d::Registry& registry, const std::atomic<bool>* cancel) {
  return {registry, std::cout, std::cerr, isatty(STDERR_FILENO) != 0, cancel};
}

}  // namespace

int run_push(const TransferOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel) {
  return options.shards ? run_push_into_shards(options, standard_host(registry, cancel))
                        : run_push(options, standard_host(registry, cancel));
}

int run_pull(const TransferOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel) {
  return run_pull(options, standard_host(registry, cancel));
}

}  // namespace queries
