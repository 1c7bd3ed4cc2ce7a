#pragma once

#include <atomic>

namespace queries {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag that running statements ask. One per process, made by `main`.
/// A second Ctrl-C while the first is still pending ends the process at once; the database stays whole.
class Interruption {
 public:
  Interruption();
  /// True once a signal has come, until `reset`.
  static std::atomic<bool>& flag();
  /// True once SIGTERM has come: then a prompt ends too.
  static bool is_terminated();
  static void reset() { flag().store(false); }
};

}  // namespace queries
