#include "algebra3d/operators/registry/failed_calls.h"

#include <fmt/format.h>

#include "algebra3d/operators/registry/conversion.h"

namespace algebra3d {
namespace {

const Type& parameter_type(const ResolvedCall& call, std::size_t place) {
  const auto& parameters = call.overload->parameters;
  return *(call.overload->kind() == OperatorKind::aggregate ? parameters.front() : parameters[place]).type;
}

bool is_wanted(const Error& error, const Context& context) {
  return error.code == ErrorCode::internal && context.failed_calls != nullptr && !context.failed_calls->first();
}

}  // namespace

void note_failed_call(const ResolvedCall& call, std::span<const Value> arguments, const Error& error,
                      Context& context) {
  if (!is_wanted(error, context)) return;
  FailedCall failed{call.op, call.overload, {}, error, {}};
  failed.arguments.reserve(arguments.size());
  for (const Value& argument : arguments) {
    const auto loaded = argument.loaded();
    if (!loaded)
      return note_failed_call(
          call, fmt::format("argument {} cannot be read: {}", failed.arguments.size() + 1, loaded.error().text()),
          error, context);
    failed.arguments.push_back(converted(*loaded, parameter_type(call, failed.arguments.size())));
  }
  context.failed_calls->note(std::move(failed));
}

void note_failed_call(const ResolvedCall& call, std::string obstacle, const Error& error, Context& context) {
  if (is_wanted(error, context)) context.failed_calls->note({call.op, call.overload, {}, error, std::move(obstacle)});
}

}  // namespace algebra3d
