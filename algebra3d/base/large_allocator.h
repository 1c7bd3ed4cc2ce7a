#pragma once

#include <cstddef>
#include <new>

namespace algebra3d {

/// Allocates large arrays with random access: aligned to huge pages, and in huge pages if the system has them. Throws
/// std::bad_alloc.
void* allocate_large(std::size_t bytes, std::size_t alignment);
void free_large(void* memory) noexcept;

/// An allocator for std::vector that uses allocate_large.
template <typename T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <typename U>
  explicit LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T), alignof(T))); }
  void deallocate(T* memory, std::size_t) noexcept { free_large(memory); }

  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

}  // namespace algebra3d
