#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace algebra3d::interrupts {

/// A call that was interrupted.
struct Measured {
  double used = 0;             ///< processor seconds from the start to the return
  std::optional<double> late;  ///< of them from the interrupt to the return; nothing if the call ended before it
  std::string outcome;         ///< what the call says of itself
  std::string place;           ///< functions that ran long after the interrupt, innermost first; may be empty
  bool is_killed = false;      ///< it had not returned after Limits::patience
};

struct Limits {
  double moment = 0.05;  ///< processor seconds after which the interrupt comes
  double traced = 0.15;  ///< processor seconds after the interrupt after which the place is noted; 0: never
  double patience = 10;  ///< processor seconds after the interrupt after which the call is killed
};

/// Calls `work` in a child process, with a flag that is set at the moment of `limits`. The child has copies of all
/// values of this process. Time is the processor time of the child, of all its threads, so other processes do not
/// matter.
Measured measure(const Limits& limits, const std::function<std::string(const std::atomic<bool>& flag)>& work);

}  // namespace algebra3d::interrupts
