#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/streams/datum.h"

namespace queries {

/// One argument of a stream operator as its type mapping sees it. What stands in each member follows from the kind of
/// the place in the operator's syntax pattern (SyntaxPattern::PlaceKind).
struct ArgumentType {
  /// Operands and `_` places: the type of the expression. `fun` places: `(map P... R)`.
  TypeExpr type;
  /// `attribute`, `name`: one name. `attributes`: the names. `keys`: the attribute names. `functions`: the new names.
  /// `renames`: the new names.
  std::vector<std::string> names;
  /// `keys`: "asc" or "desc" per name. `renames`: the old names.
  std::vector<std::string> modifiers;
  /// `functions`: the type `(map P... R)` per name.
  std::vector<TypeExpr> types;
  /// For an int constant written as a literal: its value (node sizes, bucket counts and the like).
  std::optional<std::int64_t> literal;
  /// Gives the value of an operand or `_` place that is the same whenever the query runs: of a literal, or of what
  /// stands in no function. Null for all others. Costs what its evaluation costs.
  std::function<Result<Value>()> constant;
};

/// A checked application: its type, and how it is evaluated. `arguments` holds per place: the evaluated expression
/// (operands, `_`), a Function (`fun`), a list of Functions (`functions`), or an empty list (name places).
struct Plan {
  TypeExpr type;
  std::function<Result<Datum>(std::vector<Datum> arguments, algebra3d::Context& context)> run;
};

/// The type mapping: from argument types to the plan. Errors: type_error "filter: expected ..., got ...".
using TypeMapping = std::function<Result<Plan>(std::span<const ArgumentType> arguments)>;

/// The same for an operator whose result type depends on more than types: it may read files, and it reports to
/// `context`, which outlives the call.
using ReadingTypeMapping =
    std::function<Result<Plan>(std::span<const ArgumentType> arguments, algebra3d::Context& context)>;

/// The implementation of an operator over streams, relations, tuples and functions.
class StreamOperator final : public algebra3d::StreamImplementation {
 public:
  explicit StreamOperator(ReadingTypeMapping mapping) : mapping_(std::move(mapping)) {}
  Result<Plan> plan(std::span<const ArgumentType> arguments, algebra3d::Context& context) const {
    return mapping_(arguments, context);
  }

 private:
  ReadingTypeMapping mapping_;
};

inline std::shared_ptr<const algebra3d::StreamImplementation> reading_stream_operator(ReadingTypeMapping mapping) {
  return std::make_shared<StreamOperator>(std::move(mapping));
}
inline std::shared_ptr<const algebra3d::StreamImplementation> stream_operator(TypeMapping mapping) {
  return reading_stream_operator(
      [mapping = std::move(mapping)](std::span<const ArgumentType> arguments, algebra3d::Context& /*context*/) {
        return mapping(arguments);
      });
}

/// The type that a pseudo parameter type of a syntax pattern stands for, given the operand types: TUPLE (tuple type of
/// operand 1), TUPLE2 (of operand 2), STREAMELEM (element type of operand 1), GROUP (relation of operand 1's tuples).
/// Errors: type_error if the operand is no stream or relation.
Result<TypeExpr> pseudo_type(const std::string& name, std::span<const TypeExpr> operands);

}  // namespace queries
