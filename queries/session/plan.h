#pragma once

#include "queries/language/plan_recorder.h"

namespace queries {

/// Pulls everything out of a result, so that its operators have done their work.
algebra3d::Status exhaust(const Datum& value, const Context& context);

/// The operators of an expression as a result list,
/// `(inquiry (plan ((depth name 'signature' calls tuples milliseconds) ...)))`, each before its arguments.
NestedList plan_list(const PlanRecorder& recorder);

}  // namespace queries
