#pragma once

#include <atomic>

namespace queries {

/// Converts Ctrl-C (SIGINT) and SIGTERM to a flag that running statements check. One per process, created by `main`. A
/// second Ctrl-C while the first is pending, a tenth of a second later or more, ends the process immediately; the
/// database stays intact.
class Interruption {
 public:
  Interruption();
  /// True after a signal, until `reset`.
  static std::atomic<bool>& flag();
  /// True after SIGTERM, which also ends the prompt.
  static bool is_terminated();
  static void reset() { flag().store(false); }
};

}  // namespace queries
