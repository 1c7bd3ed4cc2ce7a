#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"

namespace algebra3d {

/// A call of an operator that ended with the error internal, and what it takes to repeat it.
struct FailedCall {
  const Operator* op = nullptr;
  const Overload* overload = nullptr;
  /// Loaded, and of the types of the parameters; of an aggregate its defined values, in their order.
  std::vector<Value> arguments;
  Error error;
  std::string obstacle;  ///< why the arguments are not here, as a clause; empty if they are
};

/// The calls of one statement that ended with the error internal. Keeps the first of them: its error is the one that
/// the statement ends with. Owned by the host, and used by one thread.
class FailedCalls {
 public:
  void note(FailedCall call) {
    if (!first_) first_ = std::move(call);
  }
  const std::optional<FailedCall>& first() const { return first_; }

 private:
  std::optional<FailedCall> first_;
};

/// Notes the call in `context` if the error is internal and the context wants to know. Loads deferred arguments.
void note_failed_call(const ResolvedCall& call, std::span<const Value> arguments, const Error& error, Context& context);
/// As above, for a call whose arguments are not at hand, with the reason as a clause.
void note_failed_call(const ResolvedCall& call, std::string obstacle, const Error& error, Context& context);

}  // namespace algebra3d
