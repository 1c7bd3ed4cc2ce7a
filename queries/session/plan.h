#pragma once

#include "queries/language/plan_recorder.h"

namespace queries {

/// Pulls a result to its end.
algebra3d::Status exhaust(const Datum& value, const Context& context);

/// Evaluates an expression and pulls its result to the end, so that all its operators have run.
algebra3d::Status run_to_end(const TypedNode& node, Context& context);

/// The operators of an expression as a result list, `(inquiry (plan ((depth name 'signature' calls tuples milliseconds
/// estimate 'how') ...)))`, each operator before its arguments. `estimate` is the number of tuples that was expected,
/// -1 if nothing was. `how` names the index that is read, and the stages with their counts.
NestedList plan_list(const PlanRecorder& recorder);

}  // namespace queries
