#pragma once

#include <span>
#include <string>
#include <string_view>

#include "queries/streams/stream_operator.h"

namespace queries {

using algebra3d::Context;

/// What type mappings of stream operators have in common: the checks, and the errors "OP: expected ..., got ...".
/// Positions count operands first, then the places in the brackets.
class MappingCheck {
 public:
  MappingCheck(std::string_view op, std::span<const ArgumentType> arguments) : op_(op), arguments_(arguments) {}

  /// The tuple type of a stream or relation operand.
  Result<TypeExpr> tuple_stream(std::size_t position) const;
  Result<TypeExpr> relation(std::size_t position) const;
  /// A function with that result type, or any if `result` is empty.
  Status function(std::size_t position, std::string_view result = {}) const;
  Status type(std::size_t position, std::string_view wanted) const;
  /// Position of the attribute that `names[which]` of an argument names.
  Result<std::size_t> attribute(std::size_t position, const TypeExpr& tuple, std::size_t which = 0) const;
  /// A tuple type without clashes. `left` and `right` in this order.
  Result<TypeExpr> concatenated(const TypeExpr& left, const TypeExpr& right) const;
  /// Error unless every name is new in `tuple` and in the list itself.
  Status new_names(const TypeExpr& tuple, std::span<const std::string> names) const;

  Error expected(std::string_view what, const TypeExpr& got) const;
  Error error(std::string_view text) const;
  std::size_t count() const { return arguments_.size(); }
  const ArgumentType& operator[](std::size_t position) const { return arguments_[position]; }

 private:
  std::string op_;
  std::span<const ArgumentType> arguments_;
};

}  // namespace queries
