#pragma once

#include <cstddef>
#include <filesystem>

namespace algebra3d {

/// The memory limit of all operators of a statement together, and the folder of the temporary files for the rest. Owned
/// by the session; outlives all accounts. Used by one thread.
class WorkMemory {
 public:
  /// `limit` in bytes; `folder`: folder of temporary files.
  WorkMemory(std::size_t limit, std::filesystem::path folder) : limit_(limit), folder_(std::move(folder)) {}
  WorkMemory(const WorkMemory&) = delete;
  WorkMemory& operator=(const WorkMemory&) = delete;

  std::size_t limit() const { return limit_; }
  /// Changes the limit; existing accounts keep their memory.
  void set_limit(std::size_t limit) { limit_ = limit; }
  std::size_t used() const { return used_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// A quarter of the machine's memory.
  static std::size_t default_limit();
  /// The system's folder of large temporary files: TMPDIR, else /var/tmp, else /tmp.
  static std::filesystem::path default_folder();

 private:
  friend class MemoryAccount;
  std::size_t limit_;
  std::filesystem::path folder_;
  std::size_t used_ = 0;
};

/// The share of one operator in a WorkMemory; returned at the end of the account.
///
/// An account may grow to half of the memory that the others leave: the first may take a half, the next a quarter, and
/// so on. So the limit holds for any number of operators, and each of them gets some memory.
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
