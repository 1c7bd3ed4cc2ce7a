#include "algebra3d/base/large_allocator.h"

#include <algorithm>
#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace algebra3d {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

}  // namespace

// Only arrays of several huge pages, so that rounding up costs little.
void* allocate_large(std::size_t bytes, std::size_t alignment) {
  const bool is_large = bytes >= 4 * kHugePage;
  const std::size_t unit = is_large ? kHugePage : std::max(alignment, sizeof(void*));
  void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // A wish: where the system does not grant it, small pages serve as well.
  if (is_large) (void)madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory) noexcept {
  std::free(memory);
}

}  // namespace algebra3d
