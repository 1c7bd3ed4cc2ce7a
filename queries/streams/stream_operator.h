#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/datum.h"

namespace queries {

/// One argument of a stream operator as its type mapping sees it. The kind of its place in the syntax pattern
/// (SyntaxPattern::PlaceKind) says which members are set.
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
  /// Evaluates an operand or `_` place whose value is the same in every run: a literal, or an expression outside of
  /// functions. Null for all others.
  std::function<Result<Value>()> constant;
};

/// An operator bound to the types of its arguments: the type of the result, and the function that computes it.
/// `arguments` holds per place: the evaluated expression (operands, `_`), a Function (`fun`), a list of Functions
/// (`functions`), or an empty list (name places).
struct BoundOperator {
  TypeExpr type;
  std::function<Result<Datum>(std::vector<Datum> arguments, algebra3d::Context& context)> run;
};

/// The type mapping: binds an operator to argument types. Errors: type_error "filter: expected ..., got ...".
using TypeMapping = std::function<Result<BoundOperator>(std::span<const ArgumentType> arguments)>;

/// A type mapping that may read files to find the result type, as that of importCSV does. It reports to `context`,
/// which outlives the call.
using ReadingTypeMapping =
    std::function<Result<BoundOperator>(std::span<const ArgumentType> arguments, algebra3d::Context& context)>;

/// The implementation of an operator over streams, relations, tuples and functions.
class StreamOperator final : public algebra3d::StreamImplementation {
 public:
  explicit StreamOperator(ReadingTypeMapping mapping) : mapping_(std::move(mapping)) {}
  Result<BoundOperator> bind(std::span<const ArgumentType> arguments, algebra3d::Context& context) const {
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
/// Errors: type_error if the operand is not a stream or relation.
Result<TypeExpr> pseudo_type(const std::string& name, std::span<const TypeExpr> operands);

}  // namespace queries
