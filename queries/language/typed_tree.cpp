#include "queries/language/typed_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <deque>
#include <memory_resource>
#include <utility>

#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/language/column_expression.h"
#include "queries/streams/value_operators.h"

namespace queries {
namespace {

using algebra3d::Registry;
using algebra3d::ResolvedCall;

Result<std::vector<Datum>> evaluate_all(const std::vector<TypedPtr>& nodes, const Frame* frame, Context& context) {
  std::vector<Datum> values;
  values.reserve(nodes.size());
  for (const TypedPtr& node : nodes) {
    A3D_ASSIGN(Datum value, node->evaluate(frame, context));
    values.push_back(std::move(value));
  }
  return values;
}

/// A node that gives a value, and makes a Datum of it only for those who ask for one.
class ValueNode : public TypedNode {
 public:
  using TypedNode::TypedNode;
  Result<Datum> evaluate(const Frame* frame, Context& context) const final {
    A3D_ASSIGN(Value value, evaluate_value(frame, context));
    return Datum{std::move(value)};
  }
  Result<Value> evaluate_value(const Frame* frame, Context& context) const override = 0;
};

class ConstantNode : public TypedNode {
 public:
  ConstantNode(TypeExpr type, Datum value, SourcePlace place)
      : TypedNode(std::move(type), std::move(place)), value_(std::move(value)) {}
  Result<Datum> evaluate(const Frame*, Context&) const override { return value_; }
  Result<Value> evaluate_value(const Frame*, Context&) const override { return value_.value(); }
  const Datum* find(const Frame*) const override { return &value_; }
  bool is_always_defined() const override { return defined_value() != nullptr; }
  bool never_fails() const override { return true; }
  NodeView view() const override { return ConstantView{defined_value()}; }

 private:
  const Value* defined_value() const {
    const auto* value = std::get_if<Value>(&value_.content);
    return value != nullptr && value->is_defined() ? value : nullptr;
  }

  Datum value_;
};

class FoldedNode final : public ConstantNode {
 public:
  using ConstantNode::ConstantNode;
  std::string how() const override { return "computed once"; }
};

class UndefinedNode final : public ValueNode {
 public:
  UndefinedNode(TypeExpr type, Value value, std::string reason, SourcePlace place)
      : ValueNode(std::move(type), std::move(place)), value_(std::move(value)), reason_(std::move(reason)) {}
  Result<Value> evaluate_value(const Frame*, Context& context) const override {
    context.diagnostics.report_undefined(reason_);
    return value_;
  }
  bool never_fails() const override { return true; }
  NodeView view() const override { return ConstantView{nullptr}; }

 private:
  Value value_;
  std::string reason_;
};

class ObjectNode final : public TypedNode {
 public:
  ObjectNode(TypeExpr type, std::string name, ObjectSource& objects, SourcePlace place)
      : TypedNode(std::move(type), std::move(place)), name_(std::move(name)), objects_(objects) {}
  Result<Datum> evaluate(const Frame*, Context&) const override {
    auto value = objects_.value_of(name_);
    if (!value) return std::move(value).error().at(place());
    return value;
  }
  NodeView view() const override { return ObjectView{name_}; }

 private:
  std::string name_;
  ObjectSource& objects_;
};

class ParameterNode final : public TypedNode {
 public:
  ParameterNode(TypeExpr type, std::size_t level, std::size_t index, SourcePlace place)
      : TypedNode(std::move(type), std::move(place)), level_(level), index_(index) {}
  Result<Datum> evaluate(const Frame* frame, Context&) const override { return *find(frame); }
  Result<Value> evaluate_value(const Frame* frame, Context&) const override { return find(frame)->value(); }
  const Datum* find(const Frame* frame) const override {
    for (std::size_t level = 0; level < level_; ++level) frame = frame->outer;
    return &frame->arguments[index_];
  }
  bool never_fails() const override { return true; }
  NodeView view() const override { return ParameterView{level_, index_}; }

 private:
  std::size_t level_;
  std::size_t index_;
};

class AttributeNode final : public ValueNode {
 public:
  AttributeNode(TypeExpr type, TypedPtr tuple, std::size_t index, SourcePlace place)
      : ValueNode(std::move(type), std::move(place)), tuple_(std::move(tuple)), index_(index) {}
  Result<Value> evaluate_value(const Frame* frame, Context& context) const override {
    if (const Datum* const tuple = tuple_->find(frame)) return tuple->tuple()->attributes[index_];
    A3D_ASSIGN(const Datum tuple, tuple_->evaluate(frame, context));
    return tuple.tuple()->attributes[index_];
  }
  bool never_fails() const override { return tuple_->never_fails(); }
  NodeView view() const override { return AttributeView{*tuple_, index_}; }

 private:
  TypedPtr tuple_;
  std::size_t index_;
};

/// The evaluated arguments of a call, on the stack if they are few: calls are made once per tuple.
class Arguments {
 public:
  Result<std::span<Value>> evaluate(const std::vector<TypedPtr>& nodes, const Frame* frame, Context& context) {
    values_.reserve(nodes.size());
    for (const TypedPtr& node : nodes) {
      A3D_ASSIGN(Value value, node->evaluate_value(frame, context));
      values_.push_back(std::move(value));
    }
    return std::span<Value>(values_);
  }

 private:
  static constexpr std::size_t kOnStack = 4;

  alignas(Value) std::array<std::byte, kOnStack * sizeof(Value)> memory_;
  std::pmr::monotonic_buffer_resource resource_{memory_.data(), memory_.size()};
  std::pmr::vector<Value> values_{&resource_};
};

class ValueCallNode final : public ValueNode {
 public:
  ValueCallNode(ResolvedCall call, std::vector<TypedPtr> arguments, SourcePlace place)
      : ValueNode(call.overload->result_type(), std::move(place)), call_(call), arguments_(std::move(arguments)) {}
  Result<Value> evaluate_value(const Frame* frame, Context& context) const override {
    Arguments arguments;
    A3D_ASSIGN(const std::span<Value> values, arguments.evaluate(arguments_, frame, context));
    auto value = Registry::call(call_, values, context);
    if (!value) return std::move(value).error().at(place());
    return value;
  }
  bool is_always_defined() const override {
    if (!call_.overload->is_total) return false;
    for (std::size_t place = 0; place < arguments_.size(); ++place)
      if (!call_.overload->parameters[place].accepts_undefined && !arguments_[place]->is_always_defined()) return false;
    return true;
  }
  bool never_fails() const override {
    return call_.overload->never_fails && call_.op->is_pure_in(*call_.overload) &&
           std::ranges::all_of(arguments_, [](const TypedPtr& argument) { return argument->never_fails(); });
  }
  NodeView view() const override { return ValueCallView{call_, arguments_}; }

 private:
  ResolvedCall call_;
  std::vector<TypedPtr> arguments_;
};

/// `and` or `or` whose second operand is not evaluated where the first one decides, with which it gives no notes
/// either.
class ShortCircuitNode final : public ValueNode {
 public:
  ShortCircuitNode(bool decisive, ResolvedCall call, TypedPtr first, TypedPtr second, SourcePlace place)
      : ValueNode("bool", std::move(place)),
        decisive_(decisive),
        call_(call),
        operands_{std::move(first), std::move(second)} {}
  Result<Value> evaluate_value(const Frame* frame, Context& context) const override {
    A3D_ASSIGN(const Value first, operands_[0]->evaluate_value(frame, context));
    if (first.is_defined() && first.get<bool>() == decisive_) return first;
    A3D_ASSIGN(const Value second, operands_[1]->evaluate_value(frame, context));
    if (first.is_defined()) return second;
    std::array<Value, 2> operands{first, second};
    return Registry::call(call_, operands, context);
  }
  bool is_always_defined() const override {
    return operands_[0]->is_always_defined() && operands_[1]->is_always_defined();
  }
  bool never_fails() const override { return operands_[0]->never_fails() && operands_[1]->never_fails(); }
  NodeView view() const override { return ValueCallView{call_, operands_}; }

 private:
  bool decisive_;
  ResolvedCall call_;
  std::array<TypedPtr, 2> operands_;
};

class TableCallNode final : public TypedNode {
 public:
  TableCallNode(ResolvedCall call, std::vector<TypedPtr> arguments, SourcePlace place)
      : TypedNode(call.overload->result_type(), std::move(place)), call_(call), arguments_(std::move(arguments)) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override {
    Arguments arguments;
    A3D_ASSIGN(const std::span<Value> values, arguments.evaluate(arguments_, frame, context));
    auto rows = Registry::rows(call_, values, context);
    if (!rows) return std::move(rows).error().at(place());
    return stream_of(std::move(rows).value(), *call_.overload, context);
  }
  bool gives_one_tuple() const override { return call_.overload->has_one_row; }

 private:
  ResolvedCall call_;
  std::vector<TypedPtr> arguments_;
};

class StreamCallNode final : public TypedNode {
 public:
  StreamCallNode(const algebra3d::Operator& op, BoundOperator bound, std::vector<TypedPtr> arguments, SourcePlace place)
      : TypedNode(bound.type, std::move(place)), op_(op), bound_(std::move(bound)), arguments_(std::move(arguments)) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override {
    if (op_.changes_relations) A3D_TRY(context.check_changing(op_.name + " changes a relation"));
    A3D_ASSIGN(std::vector<Datum> values, evaluate_all(arguments_, frame, context));
    auto result = bound_.run(std::move(values), context);
    if (!result) return std::move(result).error().at(place());
    return result;
  }
  bool gives_one_tuple() const override { return op_.gives_one_tuple; }
  NodeView view() const override { return StreamCallView{op_, bound_, arguments_}; }
  std::string how() const override { return bound_.how; }

 private:
  const algebra3d::Operator& op_;
  BoundOperator bound_;
  std::vector<TypedPtr> arguments_;
};

class ListNode final : public TypedNode {
 public:
  ListNode(std::vector<TypedPtr> elements, SourcePlace place)
      : TypedNode("list", std::move(place)), elements_(std::move(elements)) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override {
    A3D_ASSIGN(std::vector<Datum> values, evaluate_all(elements_, frame, context));
    return Datum{DatumList(std::move(values))};
  }
  NodeView view() const override { return ListView{elements_}; }

 private:
  std::vector<TypedPtr> elements_;
};

class FunctionNode final : public TypedNode {
 public:
  FunctionNode(TypeExpr type, TypedPtr body, NestedList written, int height, SourcePlace place)
      : TypedNode(std::move(type), std::move(place)),
        body_(std::move(body)),
        written_(std::move(written)),
        height_(height) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override;
  NodeView view() const override { return FunctionView{*body_, written_, height_}; }
  const TypedNode& body() const { return *body_; }
  const NestedList& written() const { return written_; }
  int height() const { return height_; }

 private:
  TypedPtr body_;
  NestedList written_;
  int height_;
};

thread_local int used_call_levels = 0;

// A function that calls itself, perhaps through others, must end in an error and not at the end of the stack.
class CallLevels {
 public:
  explicit CallLevels(int levels) : levels_(levels) { used_call_levels += levels_; }
  ~CallLevels() { used_call_levels -= levels_; }
  CallLevels(const CallLevels&) = delete;
  CallLevels& operator=(const CallLevels&) = delete;
  static bool are_used_up() { return used_call_levels > kMaxCallLevels; }

 private:
  int levels_;
};

// A function with a copy of the frames around it, so that it may be called after the outer calls have returned.
class Closure final : public Function {
 public:
  Closure(std::shared_ptr<const FunctionNode> node, const Frame* outer, Context& context)
      : node_(std::move(node)), context_(context) {
    for (const Frame* frame = outer; frame != nullptr; frame = frame->outer)
      copies_.emplace_back(frame->arguments.begin(), frame->arguments.end());
    for (std::size_t level = copies_.size(); level-- > 0;)
      frames_.push_back({copies_[level], frames_.empty() ? nullptr : &frames_.back()});
  }
  Result<Datum> call(std::span<const Datum> arguments) const override {
    const CallLevels levels(node_->height());
    A3D_TRY(check_call());
    const Frame frame = frame_of(arguments);
    return node_->body().evaluate(&frame, context_);
  }
  Result<Value> call_for_value(std::span<const Datum> arguments) const override {
    const CallLevels levels(node_->height());
    A3D_TRY(check_call());
    const Frame frame = frame_of(arguments);
    return node_->body().evaluate_value(&frame, context_);
  }
  std::shared_ptr<ColumnFunction> in_columns(std::size_t left_count) const override {
    return column_function(node_->body(), left_count, frame_of({}).outer, context_);
  }
  NestedList to_nested() const override { return node_->written(); }

 private:
  Frame frame_of(std::span<const Datum> arguments) const {
    return {arguments, frames_.empty() ? nullptr : &frames_.back()};
  }
  // Functions may call each other for ever without an operator that asks.
  Status check_call() const {
    if (!CallLevels::are_used_up()) return context_.check_cancelled();
    return Error(ErrorCode::limit_exceeded, "functions call each other more than {} levels deep; does one call itself?",
                 kMaxCallLevels)
        .at(node_->place());
  }

  std::shared_ptr<const FunctionNode> node_;
  std::vector<std::vector<Datum>> copies_;
  std::deque<Frame> frames_;  // a deque: frames point to each other
  Context& context_;
};

Result<Datum> FunctionNode::evaluate(const Frame* frame, Context& context) const {
  auto self = std::static_pointer_cast<const FunctionNode>(shared_from_this());
  return Datum{std::shared_ptr<const Function>(std::make_shared<Closure>(std::move(self), frame, context))};
}

class FunctionCallNode final : public TypedNode {
 public:
  FunctionCallNode(TypedPtr function, std::vector<TypedPtr> arguments, SourcePlace place)
      : TypedNode(function->type().function_result(), std::move(place)),
        function_(std::move(function)),
        arguments_(std::move(arguments)) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override {
    A3D_ASSIGN(const Datum function, function_->evaluate(frame, context));
    A3D_ASSIGN(const std::vector<Datum> values, evaluate_all(arguments_, frame, context));
    return function.function().call(values);
  }

 private:
  TypedPtr function_;
  std::vector<TypedPtr> arguments_;
};

class ConversionNode final : public ValueNode {
 public:
  ConversionNode(TypedPtr argument, const algebra3d::Type& to)
      : ValueNode(to.term(), argument->place()), argument_(std::move(argument)), to_(to) {}
  Result<Value> evaluate_value(const Frame* frame, Context& context) const override {
    A3D_ASSIGN(const Value value, argument_->evaluate_value(frame, context));
    return algebra3d::converted(value, to_);
  }
  bool is_always_defined() const override { return argument_->is_always_defined(); }
  bool never_fails() const override { return argument_->never_fails(); }
  NodeView view() const override { return ConversionView{*argument_, to_}; }

 private:
  TypedPtr argument_;
  const algebra3d::Type& to_;
};

}  // namespace

Result<Value> TypedNode::evaluate_value(const Frame* frame, Context& context) const {
  A3D_ASSIGN(Datum datum, evaluate(frame, context));
  return std::get<Value>(std::move(datum.content));
}

TypedPtr make_constant(TypeExpr type, Datum value, SourcePlace place) {
  return std::make_shared<ConstantNode>(std::move(type), std::move(value), std::move(place));
}

TypedPtr make_folded(Value value, SourcePlace place) {
  TypeExpr type = value.type().term();
  return std::make_shared<FoldedNode>(std::move(type), Datum{std::move(value)}, std::move(place));
}

TypedPtr make_undefined(TypeExpr type, Value value, std::string reason, SourcePlace place) {
  return std::make_shared<UndefinedNode>(std::move(type), std::move(value), std::move(reason), std::move(place));
}

TypedPtr make_object(TypeExpr type, std::string name, ObjectSource& objects, SourcePlace place) {
  return std::make_shared<ObjectNode>(std::move(type), std::move(name), objects, std::move(place));
}

TypedPtr make_parameter(TypeExpr type, std::size_t level, std::size_t index, SourcePlace place) {
  return std::make_shared<ParameterNode>(std::move(type), level, index, std::move(place));
}

TypedPtr make_attribute(TypeExpr type, TypedPtr tuple, std::size_t index, SourcePlace place) {
  return std::make_shared<AttributeNode>(std::move(type), std::move(tuple), index, std::move(place));
}

TypedPtr make_value_call(ResolvedCall call, std::vector<TypedPtr> arguments, SourcePlace place) {
  if (call.overload->kind() == algebra3d::OperatorKind::table)
    return std::make_shared<TableCallNode>(call, std::move(arguments), std::move(place));
  const bool is_and = call.op->name == "and";
  if ((is_and || call.op->name == "or") && (arguments[1]->is_always_defined() || arguments[1]->never_fails()))
    return std::make_shared<ShortCircuitNode>(!is_and, call, std::move(arguments[0]), std::move(arguments[1]),
                                              std::move(place));
  return std::make_shared<ValueCallNode>(call, std::move(arguments), std::move(place));
}

TypedPtr make_stream_call(const algebra3d::Operator& op, BoundOperator bound, std::vector<TypedPtr> arguments,
                          SourcePlace place) {
  return std::make_shared<StreamCallNode>(op, std::move(bound), std::move(arguments), std::move(place));
}

TypedPtr make_list(std::vector<TypedPtr> elements, SourcePlace place) {
  return std::make_shared<ListNode>(std::move(elements), std::move(place));
}

TypedPtr make_function(TypeExpr type, TypedPtr body, NestedList written, int height, SourcePlace place) {
  return std::make_shared<FunctionNode>(std::move(type), std::move(body), std::move(written), height, std::move(place));
}

TypedPtr make_function_call(TypedPtr function, std::vector<TypedPtr> arguments, SourcePlace place) {
  return std::make_shared<FunctionCallNode>(std::move(function), std::move(arguments), std::move(place));
}

TypedPtr make_conversion(TypedPtr argument, const algebra3d::Type& type) {
  return std::make_shared<ConversionNode>(std::move(argument), type);
}

}  // namespace queries
