#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/propagate.h"
#include "queries/streams/batch.h"
#include "queries/streams/stream_operator.h"

namespace queries {

using algebra3d::Context;

/// The type to which values are converted (registry/conversion.h); null: no conversion.
using Conversion = const algebra3d::Type*;

/// Checks of argument types for the type mappings of stream operators, with the errors "OP: expected ..., got ...".
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
  /// Checks that a function has exactly these parameters. Implicit functions have them always.
  Status takes(const TypeExpr& function, const std::vector<TypeExpr>& parameters) const;
  /// Checks that the function at `position` has these parameters and this result type.
  Status function(std::size_t position, const std::vector<TypeExpr>& parameters, std::string_view result) const;
  Status type(std::size_t position, std::string_view wanted) const;
  /// Index of the attribute that `names[which]` of the argument names.
  Result<std::size_t> attribute(std::size_t position, const TypeExpr& tuple, std::size_t which = 0) const;
  Result<std::size_t> attribute_named(const std::string& name, const TypeExpr& tuple) const;
  /// Indices of all the attributes that the argument names.
  Result<std::vector<std::size_t>> attributes(std::size_t position, const TypeExpr& tuple) const;
  /// Indices of the attributes that the argument names; error for a duplicate.
  Result<std::vector<std::size_t>> distinct_or_no_attributes(std::size_t position, const TypeExpr& tuple) const;
  /// Indices of the attributes that the argument names; error for a duplicate, or if it names none.
  Result<std::vector<std::size_t>> distinct_attributes(std::size_t position, const TypeExpr& tuple) const;
  /// Index of the only attribute of type tid.
  Result<std::size_t> id_attribute(const TypeExpr& tuple) const;
  /// Checks that the argument at `position` is a tuple id: a tid or an int.
  Status id_argument(std::size_t position) const;
  /// The conversion of the argument at `position` to `wanted`; error if there is none.
  Result<Conversion> conversion(std::size_t position, const TypeExpr& wanted) const;
  /// Checks that the argument at `position` is a string or a text.
  Status characters(std::size_t position) const;
  /// The concatenation of two tuple types. Error for a duplicate name.
  Result<TypeExpr> concatenated(const TypeExpr& left, const TypeExpr& right) const;
  /// `tuple` with an attribute TID of type tid at its end.
  Result<TypeExpr> with_id(const TypeExpr& tuple) const;
  /// `tuple` extended by the attributes of the function list at `position`, whose functions take one `parameter` each.
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

/// True for a type of values: neither stream, relation, tuple nor function.
bool is_value_type(const TypeExpr& type);

/// The tuple type of the attributes at these indices.
TypeExpr projected(const TypeExpr& tuple, const std::vector<std::size_t>& indices);

/// The words of a plan for the attributes that are read: "reads K, X"; empty for all.
std::string text_of_read(const TypeExpr& tuple, const std::vector<bool>& read);

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

/// A stream of the tuples of a stream or relation operand.
Result<TupleStreamPtr> tuples_of(const Datum& operand);
/// Calls `visit(batch)` for all tuples in batches until the end or an error. Interruptible.
template <typename Visit>
Status for_each_batch(TupleStream& stream, const Context& context, Visit visit) {
  BatchReader batches(stream);
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const Batch* const batch, batches.next(kBatchTuples));
    if (batch == nullptr) return {};
    A3D_TRY(visit(*batch));
  }
}
/// Calls `visit(tuple)` for each tuple until the end or an error. Interruptible.
template <typename Visit>
Status for_each_tuple(TupleStream& stream, const Context& context, Visit visit) {
  if (stream.has_batches())
    return for_each_batch(stream, context, [&](const Batch& batch) -> Status {
      for (std::size_t i = 0; i < batch.rows.count; ++i) A3D_TRY(visit(tuple_of(batch, batch.rows[i])));
      return {};
    });
  for (std::uint32_t step = 1;; ++step) {
    A3D_ASSIGN(const TuplePtr tuple, stream.next());
    if (tuple == nullptr) return {};
    if (step % 1024 == 0) A3D_TRY(context.check_cancelled());
    A3D_TRY(visit(tuple));
  }
}
/// The concatenation of two tuples, without an id.
TuplePtr concatenated(const Tuple& left, const Tuple& right);
/// The conversion from type `given` to type `wanted`, or nothing if there is none.
std::optional<Conversion> conversion_to(const TypeExpr& wanted, const TypeExpr& given);
/// Converts a loaded value.
Value converted(const Value& value, Conversion conversion);
/// Loads a value and converts it. Errors: those of loading.
Result<Value> loaded_as(const Value& value, Conversion conversion);
/// Whether values of the two types can be compared: the types are equal, or strings and texts.
bool are_comparable(const TypeExpr& a, const TypeExpr& b);
/// The value of type tid.
Value id_value(TupleId id);
/// The tuple id in a defined value of type tid or int; 0 if it is not an id.
TupleId id_of(const Value& value);
/// True for a defined TRUE.
bool is_true(const Value& value);
/// Applies the functions of a `functions` place to `argument` and appends the results to `attributes`.
Status append_results(const DatumList& functions, const Datum& argument, std::vector<Value>& attributes);

}  // namespace queries
