#include "interrupts/call_sweep.h"

#include <optional>
#include <utility>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/example_notation.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/scalars.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d::interrupts {
namespace {

/// What a statement that runs such a call says.
std::string outcome_of(const Status& status) {
  return status ? "done" : status.error().code == ErrorCode::interrupted ? "interrupted" : status.error().text();
}

template <typename Run>
std::string with_context(const std::atomic<bool>& flag, const Run& run) {
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = &flag, .folder = {}};
  const InterruptionScope scope(&flag);
  return outcome_of(as_interrupted([&]() -> Status { return run(context); }));
}

Result<Value> evaluated(const ExampleTerm& term, const Registry& registry, Context& context) {
  if (term.kind == ExampleTerm::Kind::value) return value_from_nested(*term.type, term.value, context);
  if (term.kind != ExampleTerm::Kind::call) return Error{ErrorCode::internal, "a term without a value"};
  std::vector<Value> arguments;
  std::vector<TypeExpr> types;
  for (const ExampleTerm& each : term.arguments) {
    A3D_ASSIGN(Value value, evaluated(each, registry, context));
    types.push_back(value.type().term());
    arguments.push_back(std::move(value));
  }
  A3D_ASSIGN(const ResolvedCall call, registry.resolve(*term.op, types));
  return Registry::call(call, arguments, context);
}

/// The arguments of an example for the overload, all defined; nothing if there is none.
std::optional<std::vector<Value>> example_arguments(const Registry& registry, const Operator& op,
                                                    const Overload& overload) {
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .folder = {}};
  std::optional<std::vector<Value>> last_resort;
  for (const Example& example : op.examples) {
    std::vector<Value> values;
    bool fits = example.arguments.size() == overload.parameters.size(), is_exact = true;
    for (std::size_t i = 0; fits && i < example.arguments.size(); ++i) {
      const auto term = ExampleTerm::parse(example.arguments[i], registry);
      auto value = term ? evaluated(*term, registry, context) : Result<Value>(term.error());
      fits = value.ok() && value->is_defined();
      if (!fits) break;
      is_exact = is_exact && &value->type() == overload.parameters[i].type;
      values.push_back(*std::move(value));
    }
    if (fits && is_exact) return values;
    if (fits && !last_resort) last_resort = std::move(values);
  }
  return last_resort;
}

/// The arguments of a call: large ones where there are such of the type, else those of the example. Nothing if no
/// argument is large, or one is missing.
std::optional<std::vector<Value>> large_arguments(const Registry& registry, const Operator& op,
                                                  const Overload& overload, const LargeValues& values) {
  const auto small = example_arguments(registry, op, overload);
  std::vector<Value> arguments;
  bool is_large = false;
  for (std::size_t i = 0; i < overload.parameters.size(); ++i) {
    const Type& type = *overload.parameters[i].type;
    if (const Value* const large = values.find(type, i)) {
      is_large = true;
      arguments.push_back(*large);
    } else if (small && &(*small)[i].type() == &type) {
      arguments.push_back((*small)[i]);
    } else {
      return std::nullopt;
    }
  }
  return is_large ? std::optional(arguments) : std::nullopt;
}

Status run_call(const ResolvedCall& call, std::vector<Value> arguments, Context& context) {
  if (call.overload->kind() != OperatorKind::table) {
    A3D_TRY(Registry::call(call, arguments, context));
    return {};
  }
  A3D_ASSIGN(const RowSourcePtr rows, Registry::rows(call, arguments, context));
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const std::optional<Row> row, rows->next(context));
    if (!row) return {};
  }
}

}  // namespace

std::vector<Work> calls(const Registry& registry, const LargeValues& values, const std::string& what) {
  std::vector<Work> all;
  for (const Operator* const op : registry.operators())
    for (const Overload& overload : op->overloads) {
      if (overload.kind() == OperatorKind::aggregate || op->writes_files) continue;
      const auto arguments = large_arguments(registry, *op, overload, values);
      if (!arguments) continue;
      all.push_back({op->name + " " + overload.signature() + what,
                     [op, &overload, given = *arguments](const std::atomic<bool>& flag) {
                       return with_context(flag, [&](Context& context) {
                         return run_call(ResolvedCall{op, &overload}, given, context);
                       });
                     }});
    }
  return all;
}

std::vector<Work> aggregations(const Registry& registry, std::size_t count) {
  std::vector<Work> all;
  for (const Operator* const op : registry.operators())
    for (const Overload& overload : op->overloads) {
      if (overload.kind() != OperatorKind::aggregate) continue;
      const auto values = many_values(*overload.parameters.front().type, count);
      if (values.empty()) continue;
      all.push_back({op->name + " " + overload.signature(), [op, &overload, values](const std::atomic<bool>& flag) {
                       return with_context(flag, [&](Context& context) -> Status {
                         Aggregation aggregation(ResolvedCall{op, &overload});
                         for (const Value& value : values) A3D_TRY(aggregation.step(value, context));
                         A3D_TRY(aggregation.finish(context));
                         return {};
                       });
                     }});
    }
  return all;
}

std::vector<Work> value_work(const Registry& registry, const LargeValues& values, const std::string& what) {
  std::vector<Work> all;
  for (const Type* const type : registry.types()) {
    const Value* const one = values.find(*type, 0);
    if (one == nullptr) continue;
    const auto add = [&](const std::string& name, auto run) {
      all.push_back({name + " " + std::string(type->name()) + what, [run](const std::atomic<bool>& flag) {
                       return with_context(flag, [&](Context& context) -> Status { return run(context); });
                     }});
    };
    const std::string bytes = encode(*one);
    add("encode", [one](Context&) { return encode(*one), Status(); });
    add("decode", [type, bytes](Context&) -> Status {
      A3D_TRY(decode(*type, bytes, Origin::own_store));
      return {};
    });
    add("decode and prove", [type, bytes](Context&) -> Status {
      A3D_TRY(decode(*type, bytes, Origin::elsewhere));
      return {};
    });
    add("print", [one](Context&) { return one->to_nested().print(), Status(); });
    add("parse", [type, text = one->to_nested().print()](Context& context) -> Status {
      A3D_ASSIGN(const NestedList list, NestedList::parse(text));
      A3D_TRY(value_from_nested(*type, list, context));
      return {};
    });
    add("hash", [one](Context&) { return hash(*one), Status(); });
    const auto copy = decode(*type, bytes, Origin::own_store);
    if (copy)
      add("compare", [one, other = *copy](Context&) { return static_cast<void>(compare(*one, other)), Status(); });
  }
  return all;
}

}  // namespace algebra3d::interrupts
