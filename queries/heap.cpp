// The allocation functions of the program: they count the heap and refuse what exceeds a memory limit
// (base/memory_limit.h). A matter of the program: a library must leave them to its host.
//
// The size of a block is what malloc says, so that nothing is stored beside it; it is counted after it was allocated,
// which takes no memory as long as nobody touches it. With a sanitizer malloc is the sanitizer's.
#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>

#include "base/memory_limit.h"

namespace {

using algebra3d::ProcessMemory;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  try {
    ProcessMemory::charge(malloc_usable_size(memory));
  } catch (...) {
    std::free(memory);
    throw;
  }
  return memory;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  ProcessMemory::discharge(malloc_usable_size(memory));
  std::free(memory);
}

/// Refuses a size that no system would grant because of the limit, before malloc fails.
void refuse_early(std::size_t bytes) {
  constexpr std::size_t kLarge = std::size_t{1} << 30U;
  if (bytes < kLarge || !ProcessMemory::would_exceed(bytes)) return;
  ProcessMemory::charge(bytes);
  ProcessMemory::discharge(bytes);  // another thread has made room meanwhile
}

}  // namespace

void* operator new(std::size_t bytes) {
  refuse_early(bytes);
  return counted(std::malloc(bytes == 0 ? 1 : bytes));
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  refuse_early(bytes);
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (bytes + step - 1) / step * step));
}

// The forms below would come from the sanitizer in its builds, and do not go with those above there.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}

void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return operator new(bytes, std::nothrow);
}

void operator delete(void* memory) noexcept {
  release(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept {
  release(memory);
}

void operator delete[](void* memory) noexcept {
  release(memory);
}

void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}

void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  release(memory);
}
