#include <cstdlib>  // shows whether this is glibc

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "algebra3d/kernel/exact/number_memory.h"
#include "queries/shell/program.h"
#include "queries/store/sqlite_memory.h"

namespace {

/// Freed memory stays with the process for the next statement, up to 16 MB at the end of each heap; only arrays of 8 MB
/// and more are mapped and given back one by one. By itself glibc goes by the largest array that was freed so far, and
/// gives back and clears anew whatever a set operation takes. A matter of the program: a library must leave it to its
/// host. Larger values make heaps of threads grow beside their holes (docs/decisions/0007-set-operations.md).
void set_malloc_thresholds() {
#ifdef __GLIBC__
  constexpr int kMapped = 8 << 20, kKept = 16 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kMapped);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  set_malloc_thresholds();
  algebra3d::count_number_memory();
  queries::count_sqlite_memory();
  return queries::run_program(argc, argv);
}
