#pragma once

#include <cstddef>
#include <new>

namespace rtree {

/// Memory for large arrays that are read all over: aligned to, and where the system can, made of huge pages.
/// Throws std::bad_alloc as any allocator.
void* allocate_large(std::size_t bytes, std::size_t alignment);
void free_large(void* memory) noexcept;

/// Allocator for std::vector on top of it.
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

}  // namespace rtree
