#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/streams/datum.h"
#include "queries/streams/stream_operator.h"

namespace queries {

using algebra3d::Context;

/// The arguments of the functions that are being called, innermost first. Lives on the stack of the call; a closure
/// that outlives the call takes a copy.
struct Frame {
  std::span<const Datum> arguments;
  const Frame* outer = nullptr;
};

/// A checked expression: it has a type, and evaluates without type errors. Immutable, shared by the closures that it
/// makes.
class TypedNode : public std::enable_shared_from_this<TypedNode> {
 public:
  virtual ~TypedNode() = default;
  TypedNode(const TypedNode&) = delete;
  TypedNode& operator=(const TypedNode&) = delete;

  const TypeExpr& type() const { return type_; }
  const SourcePlace& place() const { return place_; }
  virtual Result<Datum> evaluate(const Frame* frame, Context& context) const = 0;
  /// The same for an expression that gives a value: most do, once per tuple, and so without the Datum around it.
  virtual Result<Value> evaluate_value(const Frame* frame, Context& context) const;
  /// What it evaluates to, if that lies there already, else null. Valid as long as the frame.
  virtual const Datum* find(const Frame* /*frame*/) const { return nullptr; }
  /// True if it is known to give a defined value, whatever it is evaluated with.
  virtual bool is_always_defined() const { return false; }

 protected:
  TypedNode(TypeExpr type, SourcePlace place) : type_(std::move(type)), place_(std::move(place)) {}

 private:
  TypeExpr type_;
  SourcePlace place_;
};
using TypedPtr = std::shared_ptr<const TypedNode>;

/// What the checker and the evaluation know of the database: objects by name.
class ObjectSource {
 public:
  virtual ~ObjectSource() = default;
  ObjectSource() = default;
  ObjectSource(const ObjectSource&) = delete;
  ObjectSource& operator=(const ObjectSource&) = delete;
  /// The type of an object, or nothing if there is none of that name.
  virtual Result<std::optional<TypeExpr>> type_of(const std::string& name) = 0;
  /// The value of an existing object. Errors: not_evaluable for one that was created and never given a value.
  virtual Result<Datum> value_of(const std::string& name) = 0;
  /// The type that a name stands for, or nothing.
  virtual Result<std::optional<TypeExpr>> named_type(const std::string& name) = 0;
  /// Names of all objects, for suggestions.
  virtual std::vector<std::string> names() = 0;
};

// The kinds of nodes, made by the checker.

TypedPtr make_constant(TypeExpr type, Datum value, SourcePlace place);
TypedPtr make_object(TypeExpr type, std::string name, ObjectSource& objects, SourcePlace place);
/// Argument `index` of the function `level` levels out.
TypedPtr make_parameter(TypeExpr type, std::size_t level, std::size_t index, SourcePlace place);
/// Attribute of a tuple.
TypedPtr make_attribute(TypeExpr type, TypedPtr tuple, std::size_t index, SourcePlace place);
TypedPtr make_value_call(algebra3d::ResolvedCall call, std::vector<TypedPtr> arguments, SourcePlace place);
/// `arguments` holds one node per place; a list of functions is a list node.
TypedPtr make_stream_call(Plan plan, std::vector<TypedPtr> arguments, SourcePlace place);
TypedPtr make_list(std::vector<TypedPtr> elements, SourcePlace place);
/// Levels of evaluation that function calls within function calls may take together; beyond: error limit_exceeded.
inline constexpr int kMaxCallLevels = 2000;
/// `type` is `(map P... R)`; `written` its nested-list form; `height` the levels that one call takes.
TypedPtr make_function(TypeExpr type, TypedPtr body, NestedList written, int height, SourcePlace place);
TypedPtr make_function_call(TypedPtr function, std::vector<TypedPtr> arguments, SourcePlace place);
/// An int where a real is expected.
TypedPtr make_conversion(TypedPtr argument, const algebra3d::Type& type);

}  // namespace queries
