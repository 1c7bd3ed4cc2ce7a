#include "queries/store/sqlite_memory.h"

#include <malloc.h>
#include <sqlite3.h>

#include <cstdlib>
#include <utility>

#include "base/memory_limit.h"

namespace queries {
namespace {

using algebra3d::MemoryUserScope;
using algebra3d::ProcessMemory;

// Smaller ones are always granted: rolling back must not fail.
constexpr int kRefusable = 1 << 20;

int size_of(void* memory) {
  return memory == nullptr ? 0 : static_cast<int>(malloc_usable_size(memory));
}

thread_local bool has_refused = false;

bool is_refused(int bytes) {
  const bool is_too_much = bytes >= kRefusable && ProcessMemory::would_exceed(static_cast<std::size_t>(bytes));
  if (is_too_much) has_refused = true;
  return is_too_much;
}

void count(void* memory) {
  const MemoryUserScope of_the_process(nullptr);
  ProcessMemory::charge_always(static_cast<std::size_t>(size_of(memory)));
}

void discount(int bytes) {
  const MemoryUserScope of_the_process(nullptr);
  ProcessMemory::discharge(static_cast<std::size_t>(bytes));
}

void* allocate(int bytes) {
  if (is_refused(bytes)) return nullptr;
  void* const memory = std::malloc(static_cast<std::size_t>(bytes));
  if (memory != nullptr) count(memory);
  return memory;
}

void release(void* memory) {
  if (memory == nullptr) return;
  discount(size_of(memory));
  std::free(memory);
}

void* reallocate(void* old, int bytes) {
  const int old_bytes = size_of(old);
  if (bytes > old_bytes && is_refused(bytes - old_bytes)) return nullptr;
  void* const memory = std::realloc(old, static_cast<std::size_t>(bytes));
  if (memory == nullptr) return nullptr;
  discount(old_bytes);
  count(memory);
  return memory;
}

}  // namespace

bool take_sqlite_refusal() {
  return std::exchange(has_refused, false);
}

void count_sqlite_memory() {
  const auto in_words = [](int bytes) { return (bytes + 7) & ~7; };
  const auto begin = [](void*) { return SQLITE_OK; };
  const auto end = [](void*) {};
  const sqlite3_mem_methods methods{allocate, release, reallocate, size_of, in_words, begin, end, nullptr};
  static_cast<void>(sqlite3_config(SQLITE_CONFIG_MALLOC, &methods));
}

}  // namespace queries
