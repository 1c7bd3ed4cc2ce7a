#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <variant>
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

struct BoundOperator;

struct SortKey {
  std::size_t attribute = 0;
  bool is_descending = false;
};

/// Two attributes that an equi-join compares.
struct JoinKeys {
  std::size_t left = 0;
  std::size_t right = 0;
};

// The roles of operators: what an operator does with its operands, as far as rewrites of plans use it
// (queries/language/rewriting.h). Functions of a role make operators that may stand in its place there: they give the
// same tuples in the same order.

/// The value of an attribute of the tuple at place 0.
struct ReadsAttribute {
  std::size_t index = 0;
};
/// All tuples of the relation at place 0.
struct ScansRelation {
  /// Reads only some attributes, by their places: the others are undefined.
  std::function<BoundOperator(std::vector<bool> read)> of_attributes;
  /// May leave out tuples that are not within all bounds.
  std::function<BoundOperator(std::vector<AttributeBounds> bounds)> within;
};
/// Tuples of a relation that are found otherwise.
struct FindsTuples {
  /// Reads only some attributes, by their places: the others are undefined.
  std::function<BoundOperator(std::vector<bool> read)> of_attributes;
};
/// The tuples of the streams that the function at place 1 gives for those of the stream at place 0, one after the
/// other.
struct ChainsStreams {};
/// The tuples of the stream at place 0, which are of the relation at place 1, changed there, perhaps by the functions
/// at place 2.
struct ChangesTuples {
  /// Takes tuples that are known to be of the relation, of which it needs the ids and what the functions read. Null if
  /// it does already.
  std::function<BoundOperator()> of_own = {};
};
/// The relation of the tuples of the stream at place 0.
struct CollectsTuples {};
/// The elements of the stream at place 0 for which the function at place 1 gives TRUE.
struct SelectsElements {};
/// Some tuples of the stream at place 0, chosen by these attributes.
struct SelectsByAttributes {
  std::vector<std::size_t> indices;
};
/// The first elements of the stream at place 0, as many as the int at place 1 says.
struct TakesFirst {};
/// The last elements of the stream at place 0, as many as the int at place 1 says, in their order or the last one
/// first.
struct TakesLast {};
/// The number of elements of the stream or relation at place 0.
struct CountsElements {};
/// The aggregate of an attribute of the stream at place 0.
struct AggregatesAttribute {
  algebra3d::ResolvedCall call;
  std::size_t attribute = 0;
};
/// A result that depends on these attributes of the stream at place 0 alone.
struct UsesAttributes {
  std::vector<std::size_t> indices;
};
/// Where an attribute of a new tuple comes from.
struct AttributeSource {
  bool is_made = false;   ///< by a function; else it is one of the old tuple
  std::size_t index = 0;  ///< of the attribute or, in their list, of the function
};
using AttributeSources = std::vector<AttributeSource>;
/// A tuple with other attributes or names for each tuple of the stream at place 0.
struct MakesTuples {
  AttributeSources sources;
};
/// The tuples of the stream at place 0, sorted.
struct SortsTuples {
  std::vector<SortKey> order;
  /// Gives them as they come, since the operator above does without their order.
  std::function<BoundOperator()> left_out;
  /// Gives only the first tuples, this many.
  std::function<BoundOperator(std::size_t count)> of_first;
  std::optional<std::size_t> most = {};  ///< that it gives
};
/// An aggregate of a group of tuples; without a call the number of tuples.
struct GroupAggregate {
  std::optional<algebra3d::ResolvedCall> call;
  std::size_t attribute = 0;
};
/// A tuple for each run of tuples with equal keys in the stream at place 0, made by the functions at place 2.
struct GroupsTuples {
  std::vector<std::size_t> keys;
  /// Takes tuples in any order, and gives the groups in this one, which is of the keys.
  std::function<BoundOperator(std::vector<SortKey> order, std::vector<GroupAggregate> aggregates)> hashed;
};
/// The tuples of the stream at place 0 without those that equal their predecessor.
struct RemovesDuplicates {
  /// Takes tuples in any order, and gives the different ones in this one, which is of all attributes.
  std::function<BoundOperator(std::vector<SortKey> order)> hashed;
};
/// Pairs of tuples of the streams at places 0 and 1: the attributes of both.
struct PairsTuples {
  std::size_t left_count = 0;         ///< attributes of the first tuple
  bool has_predicate = false;         ///< at place 2: a function of both tuples that selects pairs
  std::optional<JoinKeys> keys = {};  ///< that it compares
  /// Leaves out pairs, all or some, whose keys differ or are undefined. The keys are of one type. Null if it compares
  /// keys already.
  std::function<BoundOperator(JoinKeys keys)> with_equal = {};
  /// Makes only some of the joined attributes, by their places: the others are undefined. Null if it makes all.
  std::function<BoundOperator(std::vector<bool> read)> of_attributes = {};
};
using OperatorRole = std::variant<std::monostate, ReadsAttribute, ScansRelation, FindsTuples, ChainsStreams,
                                  ChangesTuples, CollectsTuples, SelectsElements, SelectsByAttributes, TakesFirst,
                                  TakesLast, CountsElements, AggregatesAttribute, UsesAttributes, MakesTuples,
                                  SortsTuples, GroupsTuples, RemovesDuplicates, PairsTuples>;

/// An operator bound to the types of its arguments: the type of the result, and the function that computes it.
/// `arguments` holds per place: the evaluated expression (operands, `_`), a Function (`fun`), a list of Functions
/// (`functions`), or an empty list (name places).
struct BoundOperator {
  TypeExpr type;
  std::function<Result<Datum>(std::vector<Datum> arguments, algebra3d::Context& context)> run;
  OperatorRole role = {};
  std::string how = {};  ///< how it works, for people, if that is not as its description says
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
