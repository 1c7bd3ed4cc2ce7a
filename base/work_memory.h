#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>

#include "base/memory_limit.h"

namespace algebra3d {

/// The memory limit of a session as its operators see it, and the folder of the temporary files for what does not fit.
/// Owned by the session; outlives all accounts. Used by one thread.
class WorkMemory {
 public:
  /// `limit` in bytes; `folder`: folder of temporary files. `user`: who holds the memory, if it is counted; null: the
  /// accounts alone count, by their estimates.
  WorkMemory(std::size_t limit, std::filesystem::path folder, const MemoryUser* user = nullptr)
      : limit_(limit), folder_(std::move(folder)), user_(user) {}
  WorkMemory(const WorkMemory&) = delete;
  WorkMemory& operator=(const WorkMemory&) = delete;

  std::size_t limit() const { return limit_; }
  /// Changes the limit; existing accounts keep their memory.
  void set_limit(std::size_t limit) { limit_ = limit; }
  /// Bytes that the accounts have taken.
  std::size_t used() const { return used_; }
  /// Bytes that the limit leaves beside them, or that the counted heap leaves, if these are fewer.
  std::size_t left() const;
  const std::filesystem::path& folder() const { return folder_; }

  /// Three quarters of the memory that the machine has, or the process's control group if that is less.
  static std::size_t default_limit() { return ProcessMemory::default_limit(); }
  /// The system's folder of large temporary files: TMPDIR, else /var/tmp, else /tmp.
  static std::filesystem::path default_folder();

 private:
  friend class MemoryAccount;
  std::size_t limit_;
  std::filesystem::path folder_;
  const MemoryUser* user_;
  std::size_t used_ = 0;
};

/// The share of one operator in a WorkMemory; returned at the end of the account.
///
/// An account may grow to a third of the memory that is left without it: the first may take a third, the next two
/// ninths, and so on. So the limit holds for any number of operators, each of them gets some memory, and so does what
/// they compute.
class MemoryAccount {
 public:
  /// If `memory` is null, there is no limit.
  explicit MemoryAccount(WorkMemory* memory) : memory_(memory) {}
  ~MemoryAccount() { clear(); }
  MemoryAccount(MemoryAccount&& other) noexcept;
  MemoryAccount& operator=(MemoryAccount&& other) noexcept;
  MemoryAccount(const MemoryAccount&) = delete;
  MemoryAccount& operator=(const MemoryAccount&) = delete;

  /// Takes `bytes` if available. If not, nothing is taken, and the operator must write something to a file first. The
  /// first `kLeast` bytes are always available.
  bool take(std::size_t bytes);
  /// Returns all memory.
  void clear();
  std::size_t used() const { return used_; }

  static constexpr std::size_t kLeast = std::size_t{64} * 1024;

 private:
  WorkMemory* memory_;
  std::size_t used_ = 0;
};

}  // namespace algebra3d
