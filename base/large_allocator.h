#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace algebra3d {

/// Allocates large arrays with random access: aligned to huge pages, and in huge pages if the system has them. Throws
/// std::bad_alloc.
void* allocate_large(std::size_t bytes, std::size_t alignment);
/// Demands the size and the alignment with which the memory was allocated.
void free_large(void* memory, std::size_t bytes, std::size_t alignment) noexcept;

/// Asks for huge pages in allocated memory that nothing has touched yet; a wish. For arrays whose allocator is another.
void prefer_huge_pages(void* memory, std::size_t bytes);
/// Takes the wish back, for an array of which little will be touched: the first touch clears a huge page as a whole.
void avoid_huge_pages(void* memory, std::size_t bytes);

/// Resizes an empty array in huge pages: fewer faults of the processor.
template <typename T>
void resize_large(std::vector<T>& array, std::size_t size) {
  array.reserve(size);
  prefer_huge_pages(array.data(), size * sizeof(T));
  array.resize(size);
}

/// An allocator for std::vector that uses allocate_large.
template <typename T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <typename U>
  explicit LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T), alignof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { free_large(memory, count * sizeof(T), alignof(T)); }

  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

/// A LargeAllocator with which `resize` leaves new numbers unset: so the tasks that fill an array are the first to
/// touch its memory.
template <typename T>
struct UnsetAllocator : LargeAllocator<T> {
  UnsetAllocator() = default;
  template <typename U>
  explicit UnsetAllocator(const UnsetAllocator<U>&) {}

  template <typename U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
};

template <typename T>
using LargeVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace algebra3d
