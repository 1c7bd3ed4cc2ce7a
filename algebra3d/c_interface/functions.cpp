#include "algebra3d/c_interface/detail/functions.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/operators/descriptions/all.h"
#include "base/propagate.h"

namespace algebra3d::c_interface {
namespace {

a3d_cost cost_of(Cost cost) {
  switch (cost) {
    case Cost::linear:
      return A3D_LINEAR;
    case Cost::sorting:
      return A3D_SORTING;
    case Cost::pairs:
      return A3D_PAIRS;
    case Cost::arrangement:
      return A3D_ARRANGEMENT;
    case Cost::file:
      return A3D_FILE;
    default:
      return A3D_CONSTANT;
  }
}

a3d_kind kind_of(OperatorKind kind) {
  return kind == OperatorKind::table ? A3D_TABLE : kind == OperatorKind::aggregate ? A3D_AGGREGATE : A3D_SCALAR;
}

a3d_boxes boxes_of(const Operator& op, const Overload& overload) {
  if (overload.parameters.size() < 2 || !overload.parameters[0].type->is_spatial() ||
      !overload.parameters[1].type->is_spatial())
    return A3D_BOXES_NONE;
  switch (op.boxes) {
    case BoxCondition::meet:
      return A3D_BOXES_MEET;
    case BoxCondition::first_is_inside:
      return A3D_BOXES_INSIDE;
    case BoxCondition::first_encloses:
      return A3D_BOXES_ENCLOSES;
    case BoxCondition::are_near:
      return A3D_BOXES_NEAR;
    case BoxCondition::none:
      break;
  }
  return A3D_BOXES_NONE;
}

/// Names of types are literals, and all other texts those of the registry.
Function described(const Operator& op, const Overload& overload) {
  Function function;
  function.call = {&op, &overload};
  for (const Parameter& parameter : overload.parameters)
    function.parameters.push_back(
        {parameter.name.c_str(), parameter.type->name().data(), parameter.accepts_undefined ? 1 : 0});
  for (const Column& column : overload.columns)
    function.columns.push_back({column.name.c_str(), column.type->name().data()});
  a3d_function& description = function.description;
  description.name = op.host_name.c_str();
  description.operator_name = op.name.c_str();
  description.family = op.family.c_str();
  description.doc = op.doc.c_str();
  description.detail = op.detail.c_str();
  description.kind = kind_of(overload.kind());
  description.cost = cost_of(op.cost_of(overload));
  description.parameter_count = function.parameters.size();
  description.parameters = function.parameters.data();
  description.result_type = overload.result == nullptr ? nullptr : overload.result->name().data();
  description.column_count = function.columns.size();
  description.columns = function.columns.data();
  description.gives_elements = overload.gives_elements ? 1 : 0;
  description.has_one_row = overload.has_one_row ? 1 : 0;
  description.is_pure = op.is_pure_in(overload) ? 1 : 0;
  description.is_symmetric = overload.is_symmetric ? 1 : 0;
  description.reads_files = op.reads_files_in(overload) ? 1 : 0;
  description.writes_files = op.writes_files_in(overload) ? 1 : 0;
  description.boxes = boxes_of(op, overload);
  description.has_parts = overload.part != nullptr ? 1 : 0;
  description.keeps_values = overload.start != nullptr && overload.start()->keeps_values() ? 1 : 0;
  return function;
}

const std::vector<Function>& all_functions() {
  static const std::vector<Function> all = [] {
    std::vector<Function> made;
    for (const Operator* op : operators().operators())
      for (const Overload& overload : op->overloads) made.push_back(described(*op, overload));
    std::ranges::stable_sort(
        made, {}, [](const Function& function) -> const std::string& { return function.call.op->host_name; });
    return made;
  }();
  return all;
}

/// The operators with this name in other hosts, or else the one with this name in the query language.
std::vector<const Operator*> operators_named(std::string_view name) {
  std::vector<const Operator*> found;
  for (const Function& function : std::ranges::equal_range(functions(), name, {}, [](const Function& candidate) {
         return std::string_view(candidate.description.name);
       }))
    if (std::ranges::find(found, function.call.op) == found.end()) found.push_back(function.call.op);
  const Operator* const op = found.empty() ? operators().find_operator(name) : nullptr;
  if (op != nullptr && !op->overloads.empty()) found.push_back(op);
  return found;
}

bool takes_exactly(const Overload& overload, std::span<const TypeExpr> types) {
  return std::ranges::equal(overload.parameters, types, [](const Parameter& parameter, const TypeExpr& type) {
    return parameter.type->term() == type;
  });
}

/// Errors: unknown_name; type_error of the first operator of that name.
Result<ResolvedCall> resolved(std::string_view name, std::span<const TypeExpr> types) {
  const std::vector<const Operator*> named = operators_named(name);
  if (named.empty()) return Error{ErrorCode::unknown_name, "there is no function '{}'", name};
  std::optional<Result<ResolvedCall>> best;
  for (const Operator* op : named) {
    auto call = operators().resolve(*op, types);
    if (call.ok() && takes_exactly(*call->overload, types)) return call;
    if (!best || (!best->ok() && call.ok())) best = std::move(call);
  }
  return *std::move(best);
}

}  // namespace

const Registry& operators() {
  static const Registry registry = make_registry();
  return registry;
}

std::string in_host_names(std::string_view message) {
  const auto is_of_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const auto is_capital = [](unsigned char c) { return std::isupper(c) != 0; };
  std::string result;
  if (const std::size_t colon = message.find(": "); colon != std::string_view::npos) {
    const Operator* const op = operators().find_operator(message.substr(0, colon));
    if (op != nullptr) {
      result = op->host_name;
      message.remove_prefix(colon);
    }
  }
  while (!message.empty()) {
    const auto* const end = std::ranges::find_if_not(message, is_of_name);
    const std::string_view word(message.begin(), end);
    message.remove_prefix(word.size());
    const Operator* const op = std::ranges::any_of(word, is_capital) ? operators().find_operator(word) : nullptr;
    result += op != nullptr ? std::string_view(op->host_name) : word;
    if (message.empty()) break;
    result += message.front();
    message.remove_prefix(1);
  }
  return result;
}

std::span<const Function> functions() {
  return all_functions();
}

const Function& function_of(const a3d_function* description) {
  return *reinterpret_cast<const Function*>(description);
}

extern "C" {

size_t a3d_function_count(void) {
  return functions().size();
}

const a3d_function* a3d_function_at(size_t number) {
  return &functions()[number].description;
}

a3d_status a3d_find(a3d_session* session, const char* name, const char* const* types, size_t count,
                    const a3d_function** result) {
  return done(
      session,
      [&](Context&) -> Result<const a3d_function*> {
        std::vector<TypeExpr> terms;
        for (std::size_t i = 0; i < count; ++i) terms.emplace_back(std::string(types[i]));
        A3D_ASSIGN(const ResolvedCall call, resolved(name, terms));
        const auto all = functions();
        const auto found = std::ranges::find_if(
            all, [&](const Function& function) { return function.call.overload == call.overload; });
        return &found->description;
      },
      [&](const a3d_function* found) { *result = found; });
}

}  // extern "C"
}  // namespace algebra3d::c_interface
