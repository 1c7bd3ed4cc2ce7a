#pragma once

#include "queries/language/plan_recorder.h"

namespace queries {

/// Pulls a result to its end, so that all its operators have run.
algebra3d::Status exhaust(const Datum& value, const Context& context);

/// The operators of an expression as a result list, `(inquiry (plan ((depth name 'signature' calls tuples milliseconds)
/// ...)))`, each operator before its arguments.
NestedList plan_list(const PlanRecorder& recorder);

}  // namespace queries
