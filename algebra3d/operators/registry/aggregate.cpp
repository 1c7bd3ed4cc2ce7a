#include "algebra3d/operators/registry/aggregate.h"

#include <cassert>

#include <fmt/format.h>

#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/detail/guarded.h"
#include "algebra3d/operators/registry/failed_calls.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr std::size_t kMostBytesKept = std::size_t{16} << 20U;

}  // namespace

Status Aggregation::step(const Value& value, Context& context) {
  if (!value.is_defined()) return ++undefined_count_, Status();
  const Type& wanted = *call_.overload->parameters.front().type;
  keep(value, context);
  Status status = guarded(*call_.op, [&]() -> Status {
    poll_interruption();
    if (!value.is_deferred() && &value.type() == &wanted) return state_->step(value, context);
    // Not moved out of the result: GCC 12 then takes the unused part of the value for an uninitialised read.
    const auto loaded = value.loaded();
    if (!loaded) return loaded.error();
    return state_->step(converted(*loaded, wanted), context);
  });
  if (!status) note_failure(status.error(), context);
  return status;
}

// Geometry is taken value by value: it may have to be loaded, and what fails with it is worth a report.
Status Aggregation::step_rows(const ValueColumn& column, SelectedRows rows, Context& context) {
  assert(&column.type() == call_.overload->parameters.front().type);
  const auto are_values = []<typename Element>(const Element*) { return std::is_same_v<Element, Value>; };
  if (column.visit(are_values)) {
    for (std::size_t i = 0; i < rows.count; ++i) A3D_TRY(step(column.value(rows[i]), context));
    return {};
  }
  if (column.has_undefined())
    rows.for_each([&](std::size_t row) { undefined_count_ += column.is_defined(row) ? 0 : 1; });
  if (taken_.is_whole) taken_ = {.is_whole = false};
  Status status = guarded(*call_.op, [&]() -> Status {
    poll_interruption();
    return state_->step_rows(column, rows, context);
  });
  if (!status) note_failure(status.error(), context);
  return status;
}

Status Aggregation::combine(Aggregation& later, Context& context) {
  assert(later.call_.overload == call_.overload);
  undefined_count_ += later.undefined_count_;
  keep(later.taken_);
  Status status = guarded(*call_.op, [&] { return state_->combine(*later.state_, context); });
  if (!status) note_failure(status.error(), context);
  return status;
}

Result<Value> Aggregation::finish(Context& context) {
  if (call_.overload->counts_undefined && undefined_count_ > 0)
    context.diagnostics.report(fmt::format("{}: left out {} undefined value{}", call_.op->name, undefined_count_,
                                           undefined_count_ == 1 ? "" : "s"));
  auto outcome = guarded(*call_.op, [&] { return state_->finish(context); });
  if (!outcome) {
    note_failure(outcome.error(), context);
    return std::move(outcome).error();
  }
  if (auto* value = std::get_if<Value>(&*outcome)) return std::move(*value);
  report_undefined(call_, std::get<Undefined>(*outcome), context);
  return Value(*call_.overload->result);
}

Result<Aggregation::Part> Aggregation::finish_part(Context& context) {
  assert(call_.overload->part != nullptr);
  A3D_ASSIGN(const Outcome outcome, guarded(*call_.op, [&] { return state_->finish(context); }));
  const auto* const value = std::get_if<Value>(&outcome);
  return Part{value != nullptr ? *value : Value(*call_.overload->part), undefined_count_};
}

Status Aggregation::step_part(const Part& part, Context& context) {
  undefined_count_ += part.undefined_count;
  if (!part.result.is_defined()) return {};
  return guarded(*call_.op, [&] { return state_->step_part(part.result, context); });
}

// As it was given: a deferred value is loaded again when it is needed.
void Aggregation::keep(const Value& value, const Context& context) {
  if (context.failed_calls == nullptr || !taken_.is_whole) return;
  taken_.values.push_back(value);
  taken_.bytes += sizeof(Value) + heap_bytes(value);
  forget_if_too_many();
}

void Aggregation::keep(const Taken& later) {
  taken_.values.insert(taken_.values.end(), later.values.begin(), later.values.end());
  taken_.bytes += later.bytes;
  taken_.is_whole = taken_.is_whole && later.is_whole;
  forget_if_too_many();
}

void Aggregation::forget_if_too_many() {
  if (taken_.is_whole && (taken_.bytes <= kMostBytesKept || state_->keeps_values())) return;
  taken_.is_whole = false;
  taken_.values = {};
}

void Aggregation::note_failure(const Error& error, Context& context) const {
  if (taken_.is_whole)
    note_failed_call(call_, taken_.values, error, context);
  else
    note_failed_call(call_, "its values were too many to be kept", error, context);
}

}  // namespace algebra3d
