#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/streams/datum.h"
#include "queries/streams/stream_operator.h"

namespace queries {

using algebra3d::Context;

/// The arguments of the functions that are being called, innermost first. It is on the stack of the call; a closure
/// that outlives the call copies it.
struct Frame {
  std::span<const Datum> arguments;
  const Frame* outer = nullptr;
};

class TypedNode;
using TypedPtr = std::shared_ptr<const TypedNode>;

// Views of nodes of the typed tree, for rewrites: the kind of a node, and its parts. All pointers and references are
// valid as long as the node.

/// `value`: null if it is undefined, or no value.
struct ConstantView {
  const Value* value;
};
struct ObjectView {
  const std::string& name;
};
/// Argument `index` of the function `level` levels outward.
struct ParameterView {
  std::size_t level, index;
};
struct AttributeView {
  const TypedNode& tuple;
  std::size_t index;
};
struct ConversionView {
  const TypedNode& argument;
  const algebra3d::Type& to;
};
struct ValueCallView {
  const algebra3d::ResolvedCall& call;
  std::span<const TypedPtr> arguments;
};
struct StreamCallView {
  const algebra3d::Operator& op;
  const BoundOperator& bound;
  std::span<const TypedPtr> arguments;
};
struct FunctionView {
  const TypedNode& body;
  const NestedList& written;  ///< the nested-list form
  int height;                 ///< evaluation depth of one call
};
struct ListView {
  std::span<const TypedPtr> elements;
};
/// monostate: none of these.
using NodeView = std::variant<std::monostate, ConstantView, ObjectView, ParameterView, AttributeView, ConversionView,
                              ValueCallView, StreamCallView, FunctionView, ListView>;

/// A checked expression: it has a type and evaluates without type errors. Immutable; shared by its closures. The nodes
/// of stream operators are the logical plan of a query, which rewriting.h changes.
class TypedNode : public std::enable_shared_from_this<TypedNode> {
 public:
  virtual ~TypedNode() = default;
  TypedNode(const TypedNode&) = delete;
  TypedNode& operator=(const TypedNode&) = delete;

  const TypeExpr& type() const { return type_; }
  const SourcePlace& place() const { return place_; }
  virtual Result<Datum> evaluate(const Frame* frame, Context& context) const = 0;
  /// Evaluates an expression whose result is a value, without wrapping it in a Datum: faster for expressions per tuple.
  virtual Result<Value> evaluate_value(const Frame* frame, Context& context) const;
  /// The result if it exists already, without evaluation; else null. Valid as long as the frame.
  virtual const Datum* find(const Frame* /*frame*/) const { return nullptr; }
  /// True if the value is defined for all arguments.
  virtual bool is_always_defined() const { return false; }
  /// True if the evaluation has no effect and ends in no error, whatever the arguments; exhausted memory and
  /// interruptions do not count.
  virtual bool never_fails() const { return false; }
  /// True for a stream of at most one tuple.
  virtual bool gives_one_tuple() const { return false; }

  virtual NodeView view() const { return {}; }
  /// How an operator works, for people, if that is not as its description says.
  virtual std::string how() const { return {}; }
  /// `other`, counted and timed as this node is if it is; to put it in the place of this one. `estimate`: the number of
  /// tuples that are expected, if it is known.
  virtual TypedPtr replaced_by(TypedPtr other, std::optional<std::uint64_t> estimate) const {
    static_cast<void>(estimate);
    return other;
  }
  /// As `replaced_by`, for a node that gives as many tuples as this one.
  virtual TypedPtr renewed(TypedPtr other) const { return other; }
  /// The node in columns, counted and timed as this node is if it is.
  virtual std::shared_ptr<ColumnFunction> measured(std::shared_ptr<ColumnFunction> columns) const { return columns; }
  /// The node without the counter and clock that `explain` puts around it.
  virtual TypedPtr unmeasured() const { return shared_from_this(); }

 protected:
  TypedNode(TypeExpr type, SourcePlace place) : type_(std::move(type)), place_(std::move(place)) {}

 private:
  TypeExpr type_;
  SourcePlace place_;
};

/// The objects of the database by name, for the checker and the evaluation.
class ObjectSource {
 public:
  virtual ~ObjectSource() = default;
  ObjectSource() = default;
  ObjectSource(const ObjectSource&) = delete;
  ObjectSource& operator=(const ObjectSource&) = delete;
  /// The type of an object, or nothing if there is none.
  virtual Result<std::optional<TypeExpr>> type_of(const std::string& name) = 0;
  /// The value of an existing object. Errors: not_evaluable for an object that never got a value.
  virtual Result<Datum> value_of(const std::string& name) = 0;
  /// The type that a name stands for, or nothing.
  virtual Result<std::optional<TypeExpr>> named_type(const std::string& name) = 0;
  /// An index that follows a relation.
  struct IndexName {
    std::string name;
    std::string attribute;  ///< of the relation
    TypeExpr type;
  };
  /// The indexes that follow a relation, by name.
  virtual Result<std::vector<IndexName>> indexes_of(const std::string& /*relation*/) {
    return std::vector<IndexName>();
  }
  /// An index as it is now; `value_of` may give one that was read before a change of the statement.
  virtual Result<Datum> current_index(const std::string& name) { return value_of(name); }
  /// Whether plans are rewritten (rewriting.h).
  virtual bool rewrites_plans() const { return true; }
  /// False if there can be no objects, because no database is open.
  virtual bool is_open() const { return true; }
  /// Names of all objects, for suggestions.
  virtual std::vector<std::string> names() = 0;
};

// The kinds of nodes, made by the checker.

TypedPtr make_constant(TypeExpr type, Datum value, SourcePlace place);
/// A constant that was computed from constants.
TypedPtr make_folded(Value value, SourcePlace place);
/// An undefined constant, whose reason is reported at each evaluation.
TypedPtr make_undefined(TypeExpr type, Value value, std::string reason, SourcePlace place);
TypedPtr make_object(TypeExpr type, std::string name, ObjectSource& objects, SourcePlace place);
/// Argument `index` of the function `level` levels outward.
TypedPtr make_parameter(TypeExpr type, std::size_t level, std::size_t index, SourcePlace place);
/// Attribute of a tuple.
TypedPtr make_attribute(TypeExpr type, TypedPtr tuple, std::size_t index, SourcePlace place);
TypedPtr make_value_call(algebra3d::ResolvedCall call, std::vector<TypedPtr> arguments, SourcePlace place);
/// `arguments` holds one node per place; a list of functions is a list node.
TypedPtr make_stream_call(const algebra3d::Operator& op, BoundOperator bound, std::vector<TypedPtr> arguments,
                          SourcePlace place);
TypedPtr make_list(std::vector<TypedPtr> elements, SourcePlace place);
/// Maximum depth of evaluation in nested function calls; beyond it: error limit_exceeded.
inline constexpr int kMaxCallLevels = 2000;
/// `type` is `(map P... R)`; `written` is the nested-list form; `height` the evaluation depth of one call.
TypedPtr make_function(TypeExpr type, TypedPtr body, NestedList written, int height, SourcePlace place);
TypedPtr make_function_call(TypedPtr function, std::vector<TypedPtr> arguments, SourcePlace place);
/// Converts an int where a real is expected.
TypedPtr make_conversion(TypedPtr argument, const algebra3d::Type& type);

}  // namespace queries
