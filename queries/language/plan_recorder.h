#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "queries/language/typed_tree.h"

namespace queries {

/// One operator of a checked expression, with what it did while the expression ran.
struct PlanStep {
  std::string name;       ///< of the operator
  std::string signature;  ///< argument types and result type of the overload that was chosen
  int depth = 0;          ///< below how many operators it stands
  std::uint64_t calls = 0;
  std::uint64_t tuples = 0;  ///< that came out, of those whose result is a stream
  double seconds = 0;        ///< spent in it and in what it calls
};

/// Collects the operators of an expression while it is checked, and wraps each so that its calls, tuples and time are
/// counted while it runs. Lives as long as the expression. Used by one thread.
class PlanRecorder {
 public:
  /// The steps in the order in which the operators were met: an operator stands before its arguments.
  const std::deque<PlanStep>& steps() const { return steps_; }

  /// Before the arguments of an operator are checked; `finish` after them. If they are wrong, the whole check has
  /// failed.
  std::size_t begin(const std::string& name);
  TypedPtr finish(std::size_t step, std::string signature, TypedPtr node);

 private:
  std::deque<PlanStep> steps_;  // a deque: nodes refer to their steps
  int depth_ = 0;
};

}  // namespace queries
