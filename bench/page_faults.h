#pragma once

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace bench {

/// Pages that this process has touched first so far: each is cleared by the system. Linux only, elsewhere always 0.
inline double page_faults() {
#if defined(__linux__)
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_minflt);
#else
  return 0;
#endif
}

}  // namespace bench
