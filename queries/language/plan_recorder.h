#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "queries/language/typed_tree.h"

namespace queries {

/// One operator of a query plan, with its counts and times.
struct PlanStep {
  std::string name;       ///< of the operator
  std::string signature;  ///< argument types and result type of the chosen overload
  int depth = 0;          ///< number of enclosing operators
  std::uint64_t calls = 0;
  std::uint64_t tuples = 0;               ///< that it returned, if its result is a stream
  double seconds = 0;                     ///< including the operators below it
  std::string remark;                     ///< how it works, such as the index that it reads
  std::optional<std::uint64_t> estimate;  ///< of `tuples`, before it runs
  std::vector<StageCount> stages;         ///< of its streams, added up

  void take_counts(const PlanStep& other) {
    calls = other.calls;
    tuples = other.tuples;
    seconds = other.seconds;
    stages = other.stages;
  }
};

/// Records the operators of an expression while it is checked, and wraps each to count its calls, tuples and time while
/// it runs. Outlives the expression. Used by one thread.
class PlanRecorder {
 public:
  /// The steps in prefix order: an operator before its arguments.
  const std::deque<PlanStep>& steps() const { return steps_; }

  /// To be called before the arguments of an operator are checked; `finish` after them. If they are wrong, the whole
  /// check fails.
  std::size_t begin(const std::string& name);
  /// Calls a function, and forgets what is counted and timed meanwhile.
  template <typename Run>
  auto without_counting(Run run) {
    const std::deque<PlanStep> before = steps_;
    auto result = run();
    for (std::size_t step = 0; step < before.size(); ++step) steps_[step].take_counts(before[step]);
    return result;
  }
  /// Adds how an operator works, and how many tuples it is expected to return.
  void describe(std::size_t step, std::string remark, std::optional<std::uint64_t> estimate);
  TypedPtr finish(std::size_t step, std::string signature, TypedPtr node);

 private:
  std::deque<PlanStep> steps_;  // a deque: nodes refer to their steps
  int depth_ = 0;
};

}  // namespace queries
