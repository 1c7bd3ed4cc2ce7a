#include "algebra3d/base/work_memory.h"

#include <cstdlib>
#include <utility>

#include <unistd.h>

namespace algebra3d {

std::size_t WorkMemory::default_limit() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_bytes = sysconf(_SC_PAGESIZE);
  constexpr std::size_t kIfUnknown = std::size_t{256} << 20U;
  if (pages <= 0 || page_bytes <= 0) return kIfUnknown;
  return static_cast<std::size_t>(pages) / 4 * static_cast<std::size_t>(page_bytes);
}

std::filesystem::path WorkMemory::default_folder() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes the environment.
  if (const char* const chosen = std::getenv("TMPDIR"); chosen != nullptr && *chosen != '\0') return chosen;
  // /tmp may lie in memory, which is just what is short.
  std::error_code error;
  if (std::filesystem::is_directory("/var/tmp", error)) return "/var/tmp";
  return "/tmp";
}

MemoryAccount::MemoryAccount(MemoryAccount&& other) noexcept
    : memory_(other.memory_), used_(std::exchange(other.used_, 0)) {}

MemoryAccount& MemoryAccount::operator=(MemoryAccount&& other) noexcept {
  if (this == &other) return *this;
  clear();
  memory_ = other.memory_;
  used_ = std::exchange(other.used_, 0);
  return *this;
}

bool MemoryAccount::take(std::size_t bytes) {
  if (memory_ == nullptr) return true;
  const std::size_t wanted = used_ + bytes;
  const std::size_t others = memory_->used_ - used_;
  const std::size_t left = memory_->limit_ > others ? memory_->limit_ - others : 0;
  if (wanted > kLeast && wanted > left / 2) return false;
  used_ = wanted;
  memory_->used_ += bytes;
  return true;
}

void MemoryAccount::clear() {
  if (memory_ != nullptr) memory_->used_ -= used_;
  used_ = 0;
}

}  // namespace algebra3d
