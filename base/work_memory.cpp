#include "base/work_memory.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace algebra3d {

std::size_t WorkMemory::left() const {
  const std::size_t used = user_ != nullptr ? std::max(used_, user_->used()) : used_;
  const std::size_t own = limit_ > used ? limit_ - used : 0;
  return user_ != nullptr ? std::min(own, memory_left()) : own;
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
  if (wanted > kLeast && wanted > (memory_->left() + used_) / 3) return false;
  used_ = wanted;
  memory_->used_ += bytes;
  return true;
}

void MemoryAccount::clear() {
  if (memory_ != nullptr) memory_->used_ -= used_;
  used_ = 0;
}

}  // namespace algebra3d
