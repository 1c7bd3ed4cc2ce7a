#include "algebra3d/kernel/exact/number_memory.h"

#include <gmp.h>
#include <malloc.h>

#include <cstdlib>
#include <new>

#include "base/memory_limit.h"

namespace algebra3d {
namespace {

/// Tries once more with the memory of the reserve. Other allocations are refused until there is a reserve again, so the
/// numbers of a computation have it to themselves until it makes anything else.
template <typename Allocate>
void* with_reserve(const Allocate& allocate) {
  if (void* const memory = allocate()) return memory;
  if (ProcessMemory::release_reserve())
    if (void* const memory = allocate()) return memory;
  // A number of many megabytes, or many threads at once. GMP says that an exception has undefined results: it leaks
  // what the function in progress had for itself. The other choice is to end the program.
  throw std::bad_alloc();
}

void* allocate(std::size_t bytes) {
  void* const memory = with_reserve([&] { return std::malloc(bytes); });
  ProcessMemory::charge_always(malloc_usable_size(memory));
  return memory;
}

void* reallocate(void* old, std::size_t, std::size_t bytes) {
  const std::size_t old_bytes = malloc_usable_size(old);
  void* const memory = with_reserve([&] { return std::realloc(old, bytes); });
  ProcessMemory::discharge(old_bytes);
  ProcessMemory::charge_always(malloc_usable_size(memory));
  return memory;
}

void release(void* memory, std::size_t) {
  if (memory == nullptr) return;
  ProcessMemory::discharge(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void count_number_memory() {
  ProcessMemory::keep_reserve();
  mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace algebra3d
