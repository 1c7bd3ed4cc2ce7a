#pragma once

#include <cstddef>
#include <filesystem>

namespace algebra3d {

/// What the operators of a statement may keep in memory, all together, and the folder of the temporary files that take
/// the rest. Owned by the session, for longer than any account. Used by one thread.
class WorkMemory {
 public:
  /// A limit in bytes; `folder` is where temporary files go.
  WorkMemory(std::size_t limit, std::filesystem::path folder) : limit_(limit), folder_(std::move(folder)) {}
  WorkMemory(const WorkMemory&) = delete;
  WorkMemory& operator=(const WorkMemory&) = delete;

  std::size_t limit() const { return limit_; }
  /// From now on; accounts keep what they have.
  void set_limit(std::size_t limit) { limit_ = limit; }
  std::size_t used() const { return used_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// A quarter of the machine's memory.
  static std::size_t default_limit();
  /// Where the system wants large temporary files: TMPDIR, else /var/tmp, else /tmp.
  static std::filesystem::path default_folder();

 private:
  friend class MemoryAccount;
  std::size_t limit_;
  std::filesystem::path folder_;
  std::size_t used_ = 0;
};

/// What one operator keeps of a WorkMemory; given back when the account goes.
///
/// An account may grow to half of what the others leave. So however many operators a statement has, the limit holds,
/// and none of them finds nothing: the first may take a half, the next one a quarter, and so on.
class MemoryAccount {
 public:
  /// Without a WorkMemory (null) there is no limit.
  explicit MemoryAccount(WorkMemory* memory) : memory_(memory) {}
  ~MemoryAccount() { clear(); }
  MemoryAccount(MemoryAccount&& other) noexcept;
  MemoryAccount& operator=(MemoryAccount&& other) noexcept;
  MemoryAccount(const MemoryAccount&) = delete;
  MemoryAccount& operator=(const MemoryAccount&) = delete;

  /// Takes `bytes` if they are to be had. If not, nothing is taken, and the operator puts something aside first. The
  /// first `kLeast` bytes are always to be had.
  bool take(std::size_t bytes);
  /// Gives everything back.
  void clear();
  std::size_t used() const { return used_; }

  static constexpr std::size_t kLeast = std::size_t{64} * 1024;

 private:
  WorkMemory* memory_;
  std::size_t used_ = 0;
};

}  // namespace algebra3d
