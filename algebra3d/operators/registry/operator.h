#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "algebra3d/operators/registry/kernel.h"
#include "algebra3d/operators/registry/rows.h"
#include "algebra3d/operators/registry/syntax_pattern.h"
#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"

namespace algebra3d {

/// The exactness of the results of an operator.
enum class Exactness : std::uint8_t {
  exact,         ///< always the exact result
  rounded_once,  ///< the exact result, rounded once to doubles
  two_ulp,       ///< within two units in the last place of the exact result
  outward,       ///< a box around the exact result, each bound the nearest double outward
  bounded,       ///< the error is at most that in the description
  reported,      ///< the error is at most that in a diagnostic
  not_numeric,   ///< nothing is computed that could be inexact
};
std::string_view describe(Exactness exactness);

/// The dependence of an operator on the frame of coordinates. Without it moved arguments yield the moved result; tests
/// repeat every such operator in another frame.
enum class FrameUse : std::uint8_t {
  none,         ///< moved arguments yield the moved result
  axes,         ///< distances or a shape depend on the axes, but not on the origin
  coordinates,  ///< coordinates are returned as numbers, or read or written in a file
};

/// The kind of an operator, by which a host provides it.
enum class OperatorKind : std::uint8_t {
  scalar,      ///< a value from values
  aggregate,   ///< a value from any number of values of one type
  table,       ///< rows with named columns, from values
  relational,  ///< from streams, relations, tuples or functions: only in the query language
};
std::string_view describe(OperatorKind kind);

/// The result of a scalar or aggregate: a value, or undefined with its reason.
using Outcome = std::variant<Value, Undefined>;
/// The result of a table operator; undefined is a table without rows, with the reason.
using TableOutcome = std::variant<RowSourcePtr, Undefined>;

/// The running state of an aggregate. Initially empty; used by one thread.
class AggregateState {
 public:
  virtual ~AggregateState() = default;
  AggregateState() = default;
  AggregateState(const AggregateState&) = delete;
  AggregateState& operator=(const AggregateState&) = delete;
  /// Adds a value: defined, loaded, of the parameter's type.
  virtual Status step(const Value& value, Context& context) = 0;
  /// Adds the defined values of a column of the parameter's type at these rows, in their order.
  virtual Status step_rows(const ValueColumn& column, SelectedRows rows, Context& context);
  /// Adds the values of `later`, a state of the same overload, after those of this state; `later` is consumed. The
  /// result must not depend on the division of the values.
  virtual Status combine(AggregateState& later, Context& context) = 0;
  /// Returns the result; called once, at the end.
  virtual Result<Outcome> finish(Context& context) = 0;
  /// Adds the values of which `part` is the result: a value of Overload::part, never called where that is null.
  virtual Status step_part(const Value& part, Context& context) { return step(part, context); }
  /// Whether it keeps all values until the end, so that who keeps them too needs hardly more memory.
  virtual bool keeps_values() const { return false; }
};

struct Parameter {
  std::string name;  ///< for people: "solid", "axis"
  const Type* type = nullptr;
  bool accepts_undefined = false;  ///< the function is called with an undefined argument too
};

/// The growth of the time of a call, for query planners of hosts and for people.
enum class Cost : std::uint8_t {
  unknown,      ///< unset; no registered operator has it
  constant,     ///< independent of sizes: numbers, boxes, what is known without the geometry
  linear,       ///< with the sizes of the arguments and the result
  sorting,      ///< as sorting them
  pairs,        ///< with the product of the sizes
  arrangement,  ///< with the sizes and the intersections: makes an exact arrangement
  file,         ///< with the size of a file that is read or written
};
std::string_view describe(Cost cost);

/// One signature of an operator over values, with its implementation: `function`, `start` or `rows`, by the operator's
/// kind. Made from C++ functions and classes by `overload<...>`, `table<...>` (overload.h) and `aggregate<...>`
/// (aggregate.h), or by hand for implementations over any type.
struct Overload {
  std::vector<Parameter> parameters;  ///< of an aggregate: one, for all its values
  const Type* result = nullptr;       ///< of a scalar or aggregate
  std::vector<Column> columns;        ///< of a table
  bool gives_elements = false;        ///< of a table of one column: its rows are plain values (see Elements)
  bool has_one_row = false;           ///< of a table: it has at most one row
  bool is_total = false;              ///< the function never returns undefined
  bool never_fails = false;           ///< the function returns no error, and loads no geometry
  bool is_symmetric = false;          ///< two parameters of one type can be exchanged without effect
  /// The type of a result for some of the values that can stand for them, of an aggregate that has such; else null.
  const Type* part = nullptr;
  bool counts_undefined = false;  ///< of an aggregate: reports how many undefined values it left out
  /// Of an operator that reads or writes files: this overload takes or gives their content, so it accesses no file, and
  /// it is pure.
  bool is_without_files = false;
  Cost cost = Cost::unknown;  ///< by default that of the operator
  /// Of a scalar. Arguments have exactly the parameter types, and are undefined only where accepted. Loads arguments as
  /// needed.
  std::function<Result<Outcome>(std::span<const Value>, Context&)> function;
  /// The kernel of a scalar that never fails: calls the function for many rows at once. May be null.
  Kernel kernel = nullptr;
  /// Of an aggregate: the state before the first value.
  std::function<std::unique_ptr<AggregateState>()> start;
  /// Of a table; arguments as for `function`. They need not outlive the call.
  std::function<Result<TableOutcome>(std::span<const Value>, Context&)> rows;

  OperatorKind kind() const;
  /// Of a table: a stream of tuples with its columns, or of values if it gives elements.
  TypeExpr result_type() const;
  /// The signature as text: "(volume3d real) -> volume3d", for an aggregate "(volume3d*) -> volume3d".
  std::string signature() const;
};

/// The implementation of an operator over streams, relations and functions. Tuples are unknown here: queries/streams
/// derives its own class with a type mapping, hosts without streams ignore it.
class StreamImplementation {
 public:
  virtual ~StreamImplementation() = default;
  StreamImplementation() = default;
  StreamImplementation(const StreamImplementation&) = delete;
  StreamImplementation& operator=(const StreamImplementation&) = delete;
};

/// A call of an operator with its result, in the notation of example_notation.h: for any host. Run as a test.
struct Example {
  std::vector<std::string> arguments;  ///< of an aggregate: the values, in their order
  std::string result;                  ///< the text of the value; of a table the list of its rows
  /// An expression in which `_` stands for the call; `result` is its value, as in "(volume _)" for an operator that
  /// returns a solid. "(count _)" is the number of rows of a table.
  std::string view = "_";
};

/// A failing call with a part of its message. Run as a test.
struct ErrorExample {
  std::vector<std::string> arguments;
  std::string message;
};

/// An example of a relational operator: a query and the exact text of its result, without the type. Run as a test.
struct QueryExample {
  std::string query;
  std::string result;
};

/// A failing query with a part of its message. Run as a test.
struct QueryError {
  std::string query;
  std::string message;
};

/// The relation of the boxes of the first two arguments that TRUE implies, so that an index of boxes finds candidates.
/// Empty values, which have none, are candidates in any case.
enum class BoxCondition : std::uint8_t {
  none,
  meet,
  first_is_inside,  ///< the second one encloses the first
  first_encloses,
  are_near,  ///< their distance is at most the third argument
};

/// A family of operators, for lists and pages.
struct Family {
  std::string name;           ///< "set operations"
  std::string doc;            ///< one sentence
  Cost cost = Cost::unknown;  ///< default for its operators
};

/// The description of an operator, from which help texts, reference pages, tests and the functions of other hosts are
/// derived. Its texts are independent of hosts.
struct Operator {
  std::string name = {};
  std::string host_name = {};  ///< in hosts with snake_case; by default derived from the name (host_name.h)
  std::string syntax = {};     ///< in the query language, see SyntaxPattern; of an aggregate it follows from its kind
  /// A postfix operator without brackets, or an infix operator, that may also be written `name(...)`. After an operand
  /// the infix operator is a call only with a comma in its parentheses.
  bool also_prefix = false;
  std::string family = {};         ///< set by the registry
  std::string doc = {};            ///< one sentence: result and unit
  std::string detail = {};         ///< domain, special cases, undefined results; may be empty
  std::string language_note = {};  ///< a note on the query language; set by Registry::add_language_note
  Exactness exactness = Exactness::not_numeric;
  FrameUse frame_use = FrameUse::none;
  Cost cost = Cost::unknown;  ///< by default that of the family
  BoxCondition boxes = BoxCondition::none;
  bool is_pure = true;  ///< no side effect, and equal results for equal arguments; so no file access (but see Overload)
  bool reads_files = false;  ///< an undefined result means that a file yields no value
  bool writes_files = false;
  bool changes_relations = false;         ///< stored ones
  std::vector<std::string> sources = {};  ///< keys of docs/references.md
  std::vector<Overload> overloads = {};   ///< none of a relational operator
  /// Factory of an operator on values of every type: makes the overload for a type that is not registered, such as one
  /// of nested relations.
  std::function<Overload(const Type&)> overload_for = nullptr;
  std::shared_ptr<const StreamImplementation> stream = nullptr;  ///< of a relational operator
  std::vector<std::string> signatures = {};  ///< of a relational operator, for people; others deduce theirs
  bool handles_undefined = false;            ///< of a relational operator; others deduce it from their parameters
  bool gives_one_tuple = false;              ///< of a relational operator: a stream of at most one tuple
  std::vector<Example> examples = {};
  std::vector<ErrorExample> errors = {};
  std::vector<QueryExample> query_examples = {};  ///< of a relational operator
  std::vector<QueryError> query_errors = {};      ///< of a relational operator

  /// The kind of its first overload; overloads of an aggregate are all aggregates.
  OperatorKind kind() const;
  bool accepts_undefined() const;
  // What an overload of this operator does.
  bool is_pure_in(const Overload& overload) const { return is_pure || overload.is_without_files; }
  bool reads_files_in(const Overload& overload) const { return reads_files && !overload.is_without_files; }
  bool writes_files_in(const Overload& overload) const { return writes_files && !overload.is_without_files; }
  Cost cost_of(const Overload& overload) const { return overload.cost == Cost::unknown ? cost : overload.cost; }
  /// All forms of the syntax: "_ rect2region, rect2region(_)".
  std::string written() const;
  std::vector<std::string> all_signatures() const;
};

}  // namespace algebra3d
