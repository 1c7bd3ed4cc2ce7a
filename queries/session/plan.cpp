#include "queries/session/plan.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/propagate.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {

Status exhaust(const Datum& value, const Context& context) {
  if (const auto* tuples = std::get_if<TupleStreamPtr>(&value.content))
    return for_each_tuple(**tuples, context, [](const TuplePtr&) { return Status(); });
  const auto* values = std::get_if<ValueStreamPtr>(&value.content);
  while (values != nullptr) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const auto next, (*values)->next());
    if (!next) break;
  }
  return {};
}

namespace {

// To the microsecond, so three digits behind the point.
double in_milliseconds(double seconds) {
  return std::round(seconds * 1e6) / 1e3;
}

/// "by the index Halls_Shape; 12 pairs of boxes, 5 decided by exact tests"
std::string how_text(const PlanStep& step) {
  std::string text;
  for (const StageCount& stage : step.stages)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", stage.count, stage.what);
  if (step.remark.empty() || text.empty()) return step.remark + text;
  return step.remark + "; " + text;
}

}  // namespace

Status run_to_end(const TypedNode& node, Context& context) {
  A3D_ASSIGN(const Datum value, node.evaluate(nullptr, context));
  return exhaust(value, context);
}

NestedList plan_list(const PlanRecorder& recorder) {
  NestedList::List rows;
  for (const PlanStep& step : recorder.steps())
    rows.push_back(NestedList::list(
        NestedList(step.depth), NestedList::symbol(step.name), NestedList::text(step.signature),
        NestedList(static_cast<std::int64_t>(step.calls)), NestedList(static_cast<std::int64_t>(step.tuples)),
        NestedList(in_milliseconds(step.seconds)),
        NestedList(step.estimate ? static_cast<std::int64_t>(*step.estimate) : -1), NestedList::text(how_text(step))));
  return NestedList::list(NestedList::symbol("inquiry"),
                          NestedList::list(NestedList::symbol("plan"), NestedList(std::move(rows))));
}

}  // namespace queries
