#include "queries/streams/stream_operator.h"

namespace queries {

Result<TypeExpr> pseudo_type(const std::string& name, std::span<const TypeExpr> operands) {
  const std::size_t number = name == "TUPLE2" ? 2 : 1;
  if (operands.size() < number)
    return Error{ErrorCode::type_error, "{} has no meaning here: there is no operand {}", name, number};
  const TypeExpr& operand = operands[number - 1];
  if (name == "STREAMELEM") {
    // Of a relation too, so that the type mapping says what is missing.
    if (operand.is_stream() || operand.is_relation()) return operand.element();
    return Error{ErrorCode::type_error, "expected a stream as operand {}, got {}", number, operand.text()};
  }
  if (!operand.is_tuple_stream() && !operand.is_relation())
    return Error{ErrorCode::type_error, "expected a stream of tuples as operand {}, got {}", number, operand.text()};
  return name == "GROUP" ? TypeExpr::rel(operand.element()) : operand.element();
}

}  // namespace queries
