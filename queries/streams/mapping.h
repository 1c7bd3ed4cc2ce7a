#pragma once

#include <span>
#include <string>
#include <string_view>

#include "queries/streams/stream_operator.h"

namespace queries {

using algebra3d::Context;

/// The type that values become which are accepted in its place (registry/conversion.h); null: they stay as they are.
using Conversion = const algebra3d::Type*;

/// What type mappings of stream operators have in common: the checks, and the errors "OP: expected ..., got ...".
/// Positions count operands first, then the places in the brackets.
class MappingCheck {
 public:
  MappingCheck(std::string_view op, std::span<const ArgumentType> arguments) : op_(op), arguments_(arguments) {}

  /// The tuple type of a stream of tuples.
  Result<TypeExpr> stream(std::size_t position) const;
  /// The tuple type of a relation.
  Result<TypeExpr> relation(std::size_t position) const;
  /// The tuple type of a stream of tuples or of a relation.
  Result<TypeExpr> stream_or_relation(std::size_t position) const;
  /// The element type of a stream of tuples or of values.
  Result<TypeExpr> any_stream(std::size_t position) const;
  /// A function of exactly these parameters. Implicit functions are; explicit ones and objects may be others.
  Status takes(const TypeExpr& function, const std::vector<TypeExpr>& parameters) const;
  /// The function at `position` takes these parameters and gives that type.
  Status function(std::size_t position, const std::vector<TypeExpr>& parameters, std::string_view result) const;
  Status type(std::size_t position, std::string_view wanted) const;
  /// Index of the attribute that `names[which]` of the argument names.
  Result<std::size_t> attribute(std::size_t position, const TypeExpr& tuple, std::size_t which = 0) const;
  Result<std::size_t> attribute_named(const std::string& name, const TypeExpr& tuple) const;
  /// Indices of all the attributes that the argument names.
  Result<std::vector<std::size_t>> attributes(std::size_t position, const TypeExpr& tuple) const;
  /// The same, each of them once.
  Result<std::vector<std::size_t>> distinct_or_no_attributes(std::size_t position, const TypeExpr& tuple) const;
  /// The same, and at least one.
  Result<std::vector<std::size_t>> distinct_attributes(std::size_t position, const TypeExpr& tuple) const;
  /// Index of the only attribute of type tid.
  Result<std::size_t> id_attribute(const TypeExpr& tuple) const;
  /// The value at `position` is an id of a tuple: a tid, or an int that stands for one.
  Status id_argument(std::size_t position) const;
  /// The value at `position` is of that type or can be converted to it.
  Result<Conversion> conversion(std::size_t position, const TypeExpr& wanted) const;
  /// The value at `position` is a string or a text.
  Status characters(std::size_t position) const;
  /// Both tuples side by side. Error if a name occurs twice.
  Result<TypeExpr> concatenated(const TypeExpr& left, const TypeExpr& right) const;
  /// `tuple` with an attribute TID of type tid at its end.
  Result<TypeExpr> with_id(const TypeExpr& tuple) const;
  /// `tuple` with the attributes that the function list at `position` makes, each of one `parameter`.
  Result<TypeExpr> extended(const TypeExpr& tuple, std::size_t position, const TypeExpr& parameter) const;
  Status argument_count(std::size_t least, std::size_t most) const;

  Error expected(std::string_view what, const TypeExpr& got) const;
  Error error(std::string_view text) const;
  std::size_t count() const { return arguments_.size(); }
  const ArgumentType& operator[](std::size_t position) const { return arguments_[position]; }

 private:
  std::string op_;
  std::span<const ArgumentType> arguments_;
};

/// A type whose instances are values: neither stream, relation, tuple nor function.
bool is_value_type(const TypeExpr& type);

/// The attributes at these positions.
TypeExpr projected(const TypeExpr& tuple, const std::vector<std::size_t>& indices);

/// The undefined value of a value type.
Value undefined_of(const TypeExpr& type);

/// A stream whose `next` is a function object.
template <typename Next>
TupleStreamPtr make_stream(Next next) {
  class Stream final : public TupleStream {
   public:
    explicit Stream(Next function) : function_(std::move(function)) {}
    Result<TuplePtr> next() override { return function_(); }

   private:
    Next function_;
  };
  return std::make_shared<Stream>(std::move(next));
}
template <typename Next>
ValueStreamPtr make_value_stream(Next next) {
  class Stream final : public ValueStream {
   public:
    explicit Stream(Next function) : function_(std::move(function)) {}
    Result<std::optional<Value>> next() override { return function_(); }

   private:
    Next function_;
  };
  return std::make_shared<Stream>(std::move(next));
}

/// The tuples of a stream or relation operand.
Result<TupleStreamPtr> tuples_of(const Datum& operand);
/// Calls `visit(tuple)` for each tuple until the end or an error. Interruptible.
template <typename Visit>
Status for_each_tuple(TupleStream& stream, const Context& context, Visit visit) {
  for (std::uint32_t step = 1;; ++step) {
    ASSIGN_OR_RETURN(const TuplePtr tuple, stream.next());
    if (tuple == nullptr) return {};
    if (step % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
    RETURN_IF_ERROR(visit(tuple));
  }
}
/// The attributes of both, without an id.
TuplePtr concatenated(const Tuple& left, const Tuple& right);
/// The conversion that makes values of one type what another one is, or nothing if there is none.
std::optional<Conversion> conversion_to(const TypeExpr& wanted, const TypeExpr& given);
/// The value after the conversion.
Value converted(const Value& value, Conversion conversion);
/// The same of a value that may not be loaded yet. Errors: those of loading.
Result<Value> loaded_as(const Value& value, Conversion conversion);
/// Whether values of the two types are compared: those of one type, and strings and texts.
bool are_comparable(const TypeExpr& a, const TypeExpr& b);
/// The value of type tid.
Value id_value(TupleId id);
/// The id that a defined value of type tid or int holds; 0 for none.
TupleId id_of(const Value& value);
/// Calls a function of one tuple that gives a value.
Result<Value> call_on(const Function& function, const TuplePtr& tuple);
/// True if the predicate gives a defined TRUE.
bool is_true(const Value& value);
/// The list of functions of a `functions` place, applied to the tuple; appended to `attributes`.
Status append_results(const DatumList& functions, const Datum& argument, std::vector<Value>& attributes);

}  // namespace queries
