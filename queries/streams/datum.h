#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TypeExpr;
using algebra3d::Value;

/// Identifies a tuple within its relation; positive, never reused while the relation exists. 0: the tuple is not
/// stored.
using TupleId = std::int64_t;

/// A row: one value per attribute of its tuple type. Immutable once shared. Large attributes may be deferred.
struct Tuple {
  std::vector<Value> attributes;
  TupleId id = 0;
};
using TuplePtr = std::shared_ptr<const Tuple>;

/// A condition on an attribute of a number type that a reader of tuples sets: it does without those whose value is not
/// in these bounds, which are included, or is undefined.
struct AttributeBounds {
  std::size_t attribute = 0;
  std::optional<Value> low, high;  ///< defined; missing: infinite
};

/// A number that a stream knows about its work so far, for `explain`.
struct StageCount {
  std::string what;
  std::uint64_t count = 0;
};

struct Batch;  // batch.h
class ColumnFunction;

/// A stream of tuples that the consumer pulls one by one or, if the stream has them, in batches. Used by one thread;
/// ends with the first null.
class TupleStream {
 public:
  virtual ~TupleStream() = default;
  TupleStream() = default;
  TupleStream(const TupleStream&) = delete;
  TupleStream& operator=(const TupleStream&) = delete;
  /// The next tuple, or null at the end.
  virtual Result<TuplePtr> next() = 0;
  /// Whether it makes columns without making tuples first. Then a consumer may call `next_batch`, and never `next`.
  virtual bool has_batches() const { return false; }
  /// The next tuples, one at least and `most` at most, or null at the end; valid until the next call. The consumer
  /// wants them all: for as many tuples as it might leave, it asks later.
  virtual Result<const Batch*> next_batch(std::size_t most);
  /// The number of all its tuples, if it is known before they are made.
  virtual std::optional<std::uint64_t> known_count() const { return std::nullopt; }
  /// The numbers of its stages, such as the pairs that a join has examined; by default none.
  virtual std::vector<StageCount> stages() const { return {}; }
};
using TupleStreamPtr = std::shared_ptr<TupleStream>;

/// A stream of values that the consumer pulls one by one, like TupleStream.
class ValueStream {
 public:
  virtual ~ValueStream() = default;
  ValueStream() = default;
  ValueStream(const ValueStream&) = delete;
  ValueStream& operator=(const ValueStream&) = delete;
  /// The next value, or nothing at the end.
  virtual Result<std::optional<Value>> next() = 0;
};
using ValueStreamPtr = std::shared_ptr<ValueStream>;

class Relation;      // relation.h
class SpatialIndex;  // spatial_index.h
class OrderedIndex;  // ordered_index.h
class Function;      // below

/// The result of an expression: a value, or an object that exists only while a statement runs (stream, relation, index,
/// function). A list is the value of a list argument (names, several functions).
struct Datum;
using DatumList = std::vector<Datum>;
struct Datum {
  std::variant<Value, TuplePtr, TupleStreamPtr, ValueStreamPtr, std::shared_ptr<Relation>,
               std::shared_ptr<SpatialIndex>, std::shared_ptr<OrderedIndex>, std::shared_ptr<const Function>, DatumList>
      content;

  const Value& value() const { return std::get<Value>(content); }
  const TuplePtr& tuple() const { return std::get<TuplePtr>(content); }
  const TupleStreamPtr& tuples() const { return std::get<TupleStreamPtr>(content); }
  const ValueStreamPtr& values() const { return std::get<ValueStreamPtr>(content); }
  const std::shared_ptr<Relation>& relation() const { return std::get<std::shared_ptr<Relation>>(content); }
  const std::shared_ptr<SpatialIndex>& index() const { return std::get<std::shared_ptr<SpatialIndex>>(content); }
  const std::shared_ptr<OrderedIndex>& ordered_index() const {
    return std::get<std::shared_ptr<OrderedIndex>>(content);
  }
  const Function& function() const { return *std::get<std::shared_ptr<const Function>>(content); }
  const std::shared_ptr<const Function>& function_ptr() const {
    return std::get<std::shared_ptr<const Function>>(content);
  }
  const DatumList& list() const { return std::get<DatumList>(content); }
};

/// A typed function of the language with everything that it refers to. Can be called any number of times.
class Function {
 public:
  virtual ~Function() = default;
  Function() = default;
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;
  virtual Result<Datum> call(std::span<const Datum> arguments) const = 0;
  /// Calls a function whose result is a value.
  virtual Result<Value> call_for_value(std::span<const Datum> arguments) const {
    auto result = call(arguments);
    if (!result) return std::move(result).error();
    return std::get<Value>(std::move(result->content));
  }
  /// The function in columns; null if it is not made for them. Its parameter is the tuple, or it has two: of a joined
  /// tuple the first `left_count` attributes and the others. Valid as long as the function.
  virtual std::shared_ptr<ColumnFunction> in_columns(std::size_t left_count) const {
    static_cast<void>(left_count);
    return nullptr;
  }
  /// The nested-list form `(fun (p T) ... body)`, from which the function can be made again.
  virtual algebra3d::NestedList to_nested() const = 0;
};

}  // namespace queries
