#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Thrown by an allocation that would exceed a memory limit. Caught where std::bad_alloc is.
class MemoryLimitReached final : public std::bad_alloc {
 public:
  /// `limit` in bytes; `is_of_process`: of all sessions together; else `setting` is that of the user (MemoryUser).
  MemoryLimitReached(std::size_t limit, bool is_of_process, const char* setting)
      : limit_(limit), is_of_process_(is_of_process), setting_(setting) {}
  const char* what() const noexcept override { return "the memory limit is reached"; }
  std::size_t limit() const { return limit_; }
  bool is_of_process() const { return is_of_process_; }
  const char* setting() const { return setting_; }

 private:
  std::size_t limit_;
  bool is_of_process_;
  const char* setting_;
};

/// The error of a failed allocation: limit_exceeded with limit and remedy, or out_of_memory.
Error memory_error(const std::bad_alloc& failure);

/// The share of the heap of a piece of work (a session, a statement, a command), and its limit. Memory that another
/// user frees counts for that one, so the number is approximate where values change hands. Outlives the scopes in which
/// it is current. May be used by any number of threads.
class MemoryUser {
 public:
  static constexpr std::size_t kNoLimit = SIZE_MAX / 4;
  /// A limit below this is one of the operators that can go on in temporary files; others are stopped here.
  static constexpr std::size_t kLeastLimit = std::size_t{16} << 20U;

  /// `setting`: how people change the limit, for messages; a literal, empty if the host says it.
  explicit MemoryUser(std::size_t limit = kNoLimit, const char* setting = "`set \"memory\"` or --memory")
      : limit_(limit), setting_(setting) {}
  MemoryUser(const MemoryUser&) = delete;
  MemoryUser& operator=(const MemoryUser&) = delete;
  ~MemoryUser() = default;

  /// In bytes.
  std::size_t limit() const { return limit_.load(std::memory_order_relaxed); }
  void set_limit(std::size_t limit) { limit_ = limit; }
  std::size_t used() const;
  const char* setting() const { return setting_; }
  void add(std::int64_t bytes) { used_.fetch_add(bytes, std::memory_order_relaxed); }
  /// Replaces the count by what is known better.
  void set_used(std::size_t bytes) { used_.store(static_cast<std::int64_t>(bytes), std::memory_order_relaxed); }
  /// How often this limit refused memory.
  std::size_t refusals() const { return refusals_.load(std::memory_order_relaxed); }
  void note_refusal() { refusals_.fetch_add(1, std::memory_order_relaxed); }
  /// The user of this thread; null if there is none.
  static MemoryUser* current();

 private:
  std::atomic<std::size_t> limit_;
  std::atomic<std::int64_t> used_ = 0;
  std::atomic<std::size_t> refusals_ = 0;
  const char* setting_;
};

/// Makes a user the current one of this thread, until the end of the scope. The tasks of `scheduler.h` take over that
/// of the thread that starts them.
class MemoryUserScope {
 public:
  explicit MemoryUserScope(MemoryUser* user);
  ~MemoryUserScope();
  MemoryUserScope(const MemoryUserScope&) = delete;
  MemoryUserScope& operator=(const MemoryUserScope&) = delete;

 private:
  MemoryUser* before_;
};

/// The heap of the process as its allocation functions count it, and its limit. Only programs and modules that replace
/// `operator new` (queries/heap.cpp) count; elsewhere all numbers are 0. Each thread keeps up to kBatch bytes
/// uncounted.
class ProcessMemory {
 public:
  static constexpr std::int64_t kBatch = std::int64_t{64} << 10U;

  /// The limit of all users together, in bytes. The last `reserve` bytes are for users that hold little (an eighth of
  /// the reserve), so that one that takes all there is does not keep the others from going on.
  static void set_limit(std::size_t limit, std::size_t reserve = 0);
  static std::size_t limit();
  static std::size_t used();

  /// Counts `bytes` that were allocated, or are about to be. Throws MemoryLimitReached, and counts nothing, if a limit
  /// would be exceeded. Small amounts are never refused while an exception is on its way, nor to threads without a
  /// user.
  static void charge(std::size_t bytes);
  /// Counts `bytes` in any case; if that exceeds a limit, the next `charge` of the thread is refused. For allocators
  /// whose callers cannot fail.
  static void charge_always(std::size_t bytes) noexcept;
  static void discharge(std::size_t bytes) noexcept;
  /// How often `charge` was refused, by any limit.
  static std::size_t refusals();
  /// True, and says nothing, if `charge` would be refused.
  static bool would_exceed(std::size_t bytes) noexcept;

  /// Sets memory aside for allocators whose callers cannot fail.
  static void keep_reserve();
  /// Gives the reserve to them, if it is there: the system has no memory left. All others are refused until it could be
  /// set aside again.
  static bool release_reserve() noexcept;

  /// Three quarters of the memory that the machine has, or the process's control group if that is less.
  static std::size_t default_limit();
};

/// Bytes that the current user may still take; at least MemoryUser::kNoLimit / 2 if nothing limits it.
std::size_t memory_left();

/// The error limit_exceeded if about `bytes` are more than the current user may still take: to be asked before work
/// whose size is known. `what` names the result: "subdivide: 1572864 faces".
Status require_memory(std::uint64_t bytes, std::string_view what);

}  // namespace algebra3d
