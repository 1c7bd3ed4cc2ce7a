#include "base/memory_limit.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "base/detail/machine_memory.h"

namespace algebra3d {
namespace {

/// The bytes of a thread that are not counted yet. Plain data: allocations come before the constructors of a thread and
/// after its destructors.
struct Tally {
  std::int64_t pending = 0;
  MemoryUser* user = nullptr;
};
constinit thread_local Tally tally;

constinit std::atomic<std::int64_t> process_used = 0;
constinit std::atomic<std::size_t> process_limit = MemoryUser::kNoLimit;
constinit std::atomic<std::size_t> process_reserve = 0;
constinit std::atomic<std::size_t> process_refusals = 0;

void settle() noexcept {
  const std::int64_t bytes = std::exchange(tally.pending, 0);
  process_used.fetch_add(bytes, std::memory_order_relaxed);
  if (tally.user != nullptr) tally.user->add(bytes);
}

/// Counts what the thread still has when it ends.
struct LastSettlement {
  ~LastSettlement() { settle(); }
};
void settle_at_end_of_thread() {
  static thread_local const LastSettlement last;
  static_cast<void>(&last);
}

std::size_t non_negative(std::int64_t bytes) {
  return static_cast<std::size_t>(std::max<std::int64_t>(bytes, 0));
}

/// The limit that `bytes` more, which are not counted yet, would exceed; null if there is none.
struct Exceeded {
  std::size_t limit = 0;
  bool is_of_process = false;
  const char* setting = "";
};
Exceeded exceeded(std::size_t bytes) noexcept {
  const MemoryUser* const user = tally.user;
  const std::size_t users = user != nullptr ? user->used() : 0;
  if (user != nullptr && users + bytes > std::max(user->limit(), MemoryUser::kLeastLimit))
    return {user->limit(), false, user->setting()};
  const std::size_t limit = process_limit.load(std::memory_order_relaxed);
  const std::size_t reserve = process_reserve.load(std::memory_order_relaxed);
  const bool takes_reserve = user == nullptr || users + bytes <= reserve / 8;
  if (ProcessMemory::used() + bytes > (takes_reserve ? limit : limit - reserve)) return {limit, true, ""};
  return {};
}

// A destructor that allocates must not end the program, nor a thread of the server that serves all.
bool is_to_be_granted(std::size_t bytes) noexcept {
  return bytes < static_cast<std::size_t>(ProcessMemory::kBatch) &&
         (tally.user == nullptr || std::uncaught_exceptions() > 0);
}

/// A size that was refused last stays refused until the thread holds less: its next `charge` looks again.
void look_again_soon() noexcept {
  tally.pending += ProcessMemory::kBatch;
  process_used.fetch_sub(ProcessMemory::kBatch, std::memory_order_relaxed);
  if (tally.user != nullptr) tally.user->add(-ProcessMemory::kBatch);
}

// Large enough that the allocator maps it by itself, and so gives it back to the system as a whole.
constexpr std::size_t kReserveBytes = std::size_t{16} << 20U;
constinit std::atomic<void*> kept_reserve = nullptr;
constinit std::atomic<bool> is_reserve_gone = false;

bool has_reserve_again() noexcept {
  if (!is_reserve_gone.load(std::memory_order_relaxed)) return true;
  void* const memory = std::malloc(kReserveBytes);
  if (memory == nullptr) return false;
  void* none = nullptr;
  if (!kept_reserve.compare_exchange_strong(none, memory)) std::free(memory);
  is_reserve_gone = false;
  return true;
}

void charge_slowly(std::size_t bytes) {
  settle();
  settle_at_end_of_thread();
  if (!has_reserve_again() && !is_to_be_granted(bytes)) throw std::bad_alloc();
  const Exceeded limit = exceeded(bytes);
  if (limit.limit != 0 && !is_to_be_granted(bytes)) {
    if (tally.user != nullptr) tally.user->note_refusal();
    process_refusals.fetch_add(1, std::memory_order_relaxed);
    throw MemoryLimitReached(limit.limit, limit.is_of_process, limit.setting);
  }
  tally.pending += static_cast<std::int64_t>(bytes);
  settle();
}

std::string megabytes(std::uint64_t bytes) {
  constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20U, kGigabyte = kMegabyte << 10U;
  if (bytes >= 10 * kGigabyte) return fmt::format("{} GB", bytes / kGigabyte);
  return fmt::format("{} MB", (bytes + kMegabyte - 1) / kMegabyte);
}

std::string limit_text(std::size_t limit, bool is_of_process, std::string_view setting) {
  if (is_of_process)
    return fmt::format("the memory limit of {} for all sessions together (--memory)", megabytes(limit));
  if (setting.empty()) return fmt::format("the memory limit of {}", megabytes(limit));
  return fmt::format("the memory limit of {} ({})", megabytes(limit), setting);
}

}  // namespace

Error memory_error(const std::bad_alloc& failure) {
  const auto* const reached = dynamic_cast<const MemoryLimitReached*>(&failure);
  if (reached == nullptr) return {ErrorCode::out_of_memory, "memory is exhausted"};
  return {ErrorCode::limit_exceeded, "more memory is needed than {} allows; split the work or raise the limit",
          limit_text(reached->limit(), reached->is_of_process(), reached->setting())};
}

std::size_t MemoryUser::used() const {
  return non_negative(used_.load(std::memory_order_relaxed));
}

MemoryUser* MemoryUser::current() {
  return tally.user;
}

// Pending bytes belong to the user before.
static void change_user(MemoryUser* user) {
  if (tally.user == user) return;
  settle();
  tally.user = user;
}

MemoryUserScope::MemoryUserScope(MemoryUser* user) : before_(tally.user) {
  change_user(user);
}

MemoryUserScope::~MemoryUserScope() {
  change_user(before_);
}

void ProcessMemory::set_limit(std::size_t limit, std::size_t reserve) {
  process_limit = limit;
  process_reserve = reserve;
}

std::size_t ProcessMemory::limit() {
  return process_limit;
}

std::size_t ProcessMemory::used() {
  return non_negative(process_used.load(std::memory_order_relaxed));
}

std::size_t ProcessMemory::refusals() {
  return process_refusals.load(std::memory_order_relaxed);
}

void ProcessMemory::charge(std::size_t bytes) {
  const std::int64_t pending = tally.pending + static_cast<std::int64_t>(bytes);
  if (pending < kBatch) [[likely]]
    tally.pending = pending;
  else
    charge_slowly(bytes);
}

void ProcessMemory::charge_always(std::size_t bytes) noexcept {
  tally.pending += static_cast<std::int64_t>(bytes);
  if (tally.pending < kBatch) return;
  settle();
  if (exceeded(0).limit != 0) look_again_soon();
}

void ProcessMemory::discharge(std::size_t bytes) noexcept {
  tally.pending -= static_cast<std::int64_t>(bytes);
  if (tally.pending <= -kBatch) settle();
}

bool ProcessMemory::would_exceed(std::size_t bytes) noexcept {
  return exceeded(bytes + non_negative(tally.pending)).limit != 0;
}

void ProcessMemory::keep_reserve() {
  is_reserve_gone = true;
  static_cast<void>(has_reserve_again());
}

bool ProcessMemory::release_reserve() noexcept {
  void* const memory = kept_reserve.exchange(nullptr);
  if (memory == nullptr) return false;
  is_reserve_gone = true;
  std::free(memory);
  look_again_soon();
  return true;
}

std::size_t ProcessMemory::default_limit() {
  static const std::size_t limit = available_memory() / 4 * 3;
  return limit;
}

std::size_t memory_left() {
  const auto left = [](std::size_t limit, std::size_t used) { return limit > used ? limit - used : 0; };
  const MemoryUser* const user = tally.user;
  const std::size_t limit = ProcessMemory::limit() - process_reserve.load(std::memory_order_relaxed);
  const std::size_t of_process = left(limit, ProcessMemory::used());
  return user == nullptr ? of_process : std::min(of_process, left(user->limit(), user->used()));
}

Status require_memory(std::uint64_t bytes, std::string_view what) {
  const std::size_t left = memory_left();
  if (bytes <= left) return {};
  MemoryUser* const user = tally.user;
  const bool is_of_process = user == nullptr || user->limit() > ProcessMemory::limit();
  if (user != nullptr) user->note_refusal();
  return Error{
      ErrorCode::limit_exceeded,
      "{} would take about {}, and {} are left of {}; raise it, or ask for less",
      what,
      megabytes(bytes),
      megabytes(left),
      is_of_process ? limit_text(ProcessMemory::limit(), true, "") : limit_text(user->limit(), false, user->setting())};
}

}  // namespace algebra3d
