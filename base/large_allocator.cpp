#include "base/large_allocator.h"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace algebra3d {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21, kDefaultAlignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

/// Only arrays of several huge pages, so that alignment costs little. The rest behind the last one is in small pages.
bool is_large(std::size_t bytes) {
  return bytes >= 2 * kHugePage;
}

// For the huge pages that lie in the memory. Where the system does not grant the wish, small pages serve as well.
void advise([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] bool wants_huge_pages) {
#if defined(__linux__)
  if (!is_large(bytes)) return;
  const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(memory) % kHugePage) % kHugePage;
  (void)madvise(static_cast<char*>(memory) + before, bytes - before,
                wants_huge_pages ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
}

}  // namespace

void* allocate_large(std::size_t bytes, std::size_t alignment) {
  if (!is_large(bytes))
    return alignment <= kDefaultAlignment ? ::operator new(bytes) : ::operator new(bytes, std::align_val_t(alignment));
  void* memory = ::operator new((bytes + kHugePage - 1) / kHugePage * kHugePage, std::align_val_t(kHugePage));
  prefer_huge_pages(memory, bytes);
  return memory;
}

void prefer_huge_pages(void* memory, std::size_t bytes) {
  advise(memory, bytes, true);
}

void avoid_huge_pages(void* memory, std::size_t bytes) {
  advise(memory, bytes, false);
}

void free_large(void* memory, std::size_t bytes, std::size_t alignment) noexcept {
  if (is_large(bytes))
    ::operator delete(memory, std::align_val_t(kHugePage));
  else if (alignment <= kDefaultAlignment)
    ::operator delete(memory);
  else
    ::operator delete(memory, std::align_val_t(alignment));
}

}  // namespace algebra3d
