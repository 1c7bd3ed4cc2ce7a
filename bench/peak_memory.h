#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>

#if defined(__linux__)
#include <malloc.h>
#endif

namespace bench {

/// The resident memory of this process above what it was at construction. Linux only, elsewhere always 0. The
/// allocator's unused memory is given back first, so that earlier work does not hide the measured one.
class PeakMemory {
 public:
  PeakMemory() {
    restart();
    before_ = bytes_of("VmRSS:");
  }

  /// Forgets the peak so far.
  void restart() {
#if defined(__linux__)
    malloc_trim(0);
#endif
    std::ofstream("/proc/self/clear_refs") << "5";
  }

  /// The highest value since `restart`.
  double bytes() const {
    return bytes_of("VmHWM:") - before_;
  }

 private:
  static double bytes_of(std::string_view key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (double kilobytes = 0; word == key && status >> kilobytes) return 1024 * kilobytes;
    return 0;
  }

  double before_ = 0;
};

}  // namespace bench
