// The commands of a session that hold other commands, and those that set options.
#include <map>

#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/syntax_tree.h"
#include "queries/session/detail/objects.h"
#include "queries/session/session.h"

namespace queries {

Result<Value> Session::evaluate_alone(const Expression& expression, Context& context) {
  std::optional<Value> result;
  A3D_TRY(in_transaction(false, [&]() -> Status {
    Objects objects(registry_, store_.get(), context, options_.rewrites_plans);
    A3D_ASSIGN(const TypedPtr node, Checker(registry_, objects, context).check(expression));
    A3D_ASSIGN(const Datum datum, node->evaluate(nullptr, context));
    const auto* value = std::get_if<Value>(&datum.content);
    if (value == nullptr)
      return Error(ErrorCode::type_error, "expected a value, got {}", node->type().text()).at(expression.place);
    A3D_ASSIGN(result, value->loaded());
    return {};
  }));
  return *std::move(result);
}

Result<bool> Session::holds(const Expression& condition, std::string_view command, Context& context) {
  A3D_ASSIGN(const Value value, evaluate_alone(condition, context));
  if (value.type().name() != "bool")
    return Error(ErrorCode::type_error, "{}: expected a condition of type bool, got {}", command, value.type().name())
        .at(condition.place);
  if (!value.is_defined())
    return Error(ErrorCode::not_evaluable, "{}: the condition is undefined", command).at(condition.place);
  return value.get<bool>();
}

Status Session::run(const Conditional& command, Presenter& presenter, Context& context) {
  A3D_ASSIGN(const bool is_true, holds(*command.condition, "if", context));
  if (is_true) return run(*command.then_branch, presenter, context);
  if (command.else_branch != nullptr) return run(*command.else_branch, presenter, context);
  return {};
}

Status Session::run(const Loop& command, Presenter& presenter, Context& context) {
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const bool is_true, holds(*command.condition, "while", context));
    if (!is_true) return {};
    A3D_TRY(run(*command.body, presenter, context));
    if (has_failed_by_result(presenter)) return {};
  }
}

Status Session::run(const Sequence& command, Presenter& presenter, Context& context) {
  Status first;
  for (const CommandPtr& each : command.commands) {
    Status status = run(*each, presenter, context);
    if (status && !command.goes_on_after_errors && has_failed_by_result(presenter)) return {};
    if (status) continue;
    if (!command.goes_on_after_errors || status.error().code == ErrorCode::interrupted) return status;
    if (first)
      first = std::move(status);
    else
      context.diagnostics.report("a further command of the sequence failed: " + status.error().text());
    // After a `begin` that failed, each further command would be a transaction of its own.
    const auto* step = std::get_if<TransactionStep>(&each->content);
    const bool was_begin = step != nullptr && step->step == TransactionStep::Step::begin;
    if (was_begin && (store_ == nullptr || !store_->is_in_explicit_transaction())) break;
  }
  return first;
}

Status Session::set_memory(const Value& value, const SourcePlace& place) {
  const bool is_int = value.type().name() == "int";
  constexpr std::int64_t kMost = std::int64_t{1} << 40U;
  if (!value.is_defined() || !is_int || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > kMost)
    return Error(ErrorCode::type_error, "set \"memory\": expected the limit in megabytes, an int from 1 to {}, got {}",
                 kMost, value.to_nested().print_short())
        .at(place);
  const std::size_t limit = static_cast<std::size_t>(value.get<std::int64_t>()) << 20U;
  memory_.set_limit(limit);
  memory_user_.set_limit(limit);
  return {};
}

Status Session::run(const SetOption& command, Presenter&, Context& context) {
  static const std::map<std::string, bool SessionOptions::*, std::less<>> switches = {
      {"timing", &SessionOptions::shows_timing},
      {"paging", &SessionOptions::uses_pager},
      {"restoreReads", &SessionOptions::restore_reads},
      {"rewrites", &SessionOptions::rewrites_plans}};
  A3D_ASSIGN(const Value value, evaluate_alone(*command.value, context));
  if (command.name == "memory") return set_memory(value, command.value->place);
  const auto found = switches.find(command.name);
  if (found == switches.end()) {
    context.diagnostics.report("set: there is no option '" + command.name + "'; the command has no effect");
    return {};
  }
  if (!value.is_defined() || value.type().name() != "bool")
    return Error(ErrorCode::type_error, "set \"{}\": expected TRUE or FALSE, got {}", command.name,
                 value.to_nested().print_short())
        .at(command.value->place);
  options_.*found->second = value.get<bool>();
  return {};
}

}  // namespace queries
