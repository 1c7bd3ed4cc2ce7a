#include "queries/language/column_expression.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "queries/language/index_condition.h"

namespace queries {
namespace {

using algebra3d::KernelCall;
using algebra3d::ResolvedCall;
using algebra3d::Type;
using algebra3d::TypeOf;

using ColumnResult = Result<const ValueColumn*>;

class AttributeColumn final : public ColumnFunction {
 public:
  explicit AttributeColumn(std::size_t index) : index_(index) {}
  ColumnResult evaluate(const Batch& batch, SelectedRows /*rows*/) override { return batch.columns[index_]; }

 private:
  std::size_t index_;
};

/// A value that is the same for all tuples. It is evaluated when the first tuple needs it, and once.
class SameColumn final : public ColumnFunction {
 public:
  SameColumn(const TypedNode& node, const Type& type, const Frame* outer, Context& context)
      : node_(node), outer_(outer), context_(context), column_(type) {}

  ColumnResult evaluate(const Batch& batch, SelectedRows rows) override {
    if (rows.count == 0 || batch.size <= filled_) return &column_;
    if (!value_) {
      const Frame frame{{}, outer_};
      A3D_ASSIGN(value_, node_.evaluate_value(&frame, context_));
    }
    column_.restart(batch.size);
    for (std::size_t row = 0; row < batch.size; ++row) column_.set(row, *value_);
    filled_ = batch.size;
    return &column_;
  }

 private:
  const TypedNode& node_;
  const Frame* outer_;
  Context& context_;
  std::optional<Value> value_;
  ValueColumn column_;
  std::size_t filled_ = 0;
};

/// Ints as reals.
class RealColumn final : public ColumnFunction {
 public:
  explicit RealColumn(ColumnFunctionPtr argument) : argument_(std::move(argument)), result_(TypeOf<double>::type()) {}

  ColumnResult evaluate(const Batch& batch, SelectedRows rows) override {
    A3D_ASSIGN(const ValueColumn* const argument, argument_->evaluate(batch, rows));
    result_.restart(batch.size);
    if (rows.count == 0) return &result_;
    const auto* const from = argument->data<std::int64_t>();
    auto* const to = result_.data<double>();
    rows.for_each([&](std::size_t row) {
      if (argument->is_defined(row))
        to[row] = static_cast<double>(from[row]);
      else
        result_.set_undefined(row);
    });
    return &result_;
  }

 private:
  ColumnFunctionPtr argument_;
  ValueColumn result_;
};

class CalledColumn final : public ColumnFunction {
 public:
  CalledColumn(const ResolvedCall& call, std::vector<ColumnFunctionPtr> arguments, Context& context)
      : call_(call),
        arguments_(std::move(arguments)),
        columns_(arguments_.size()),
        result_(*call.overload->result),
        report_([this, &context](const algebra3d::Undefined& undefined) {
          algebra3d::report_undefined(call_, undefined, context);
        }) {}

  ColumnResult evaluate(const Batch& batch, SelectedRows rows) override {
    for (std::size_t place = 0; place < arguments_.size(); ++place) {
      A3D_ASSIGN(columns_[place], arguments_[place]->evaluate(batch, rows));
    }
    result_.restart(batch.size);
    if (rows.count == 0) return &result_;
    A3D_TRY(algebra3d::as_interrupted([&]() -> Status {
      algebra3d::poll_interruption();
      call_.overload->kernel(KernelCall{columns_, rows, result_, report_});
      return {};
    }));
    return &result_;
  }

 private:
  ResolvedCall call_;
  std::vector<ColumnFunctionPtr> arguments_;
  std::vector<const ValueColumn*> columns_;
  ValueColumn result_;
  std::function<void(const algebra3d::Undefined&)> report_;
};

/// `and` or `or`: the second operand is evaluated only for rows that the first does not decide, as in the tree.
class DecidedColumn final : public ColumnFunction {
 public:
  DecidedColumn(bool decisive, ColumnFunctionPtr first, ColumnFunctionPtr second)
      : decisive_(decisive), operands_{std::move(first), std::move(second)}, result_(TypeOf<bool>::type()) {}

  ColumnResult evaluate(const Batch& batch, SelectedRows rows) override {
    A3D_ASSIGN(const ValueColumn* const first, operands_[0]->evaluate(batch, rows));
    result_.restart(batch.size);
    if (rows.count == 0) return &result_;
    auto* const results = result_.data<bool>();
    const auto* const values = first->data<bool>();
    open_.clear();
    rows.for_each([&](std::size_t row) {
      results[row] = decisive_ ? 1 : 0;
      if (!first->is_defined(row) || (values[row] != 0) != decisive_) open_.push_back(static_cast<std::uint32_t>(row));
    });
    if (open_.empty()) return &result_;
    A3D_ASSIGN(const ValueColumn* const second, operands_[1]->evaluate(batch, {open_.data(), open_.size()}));
    const auto* const others = second->data<bool>();
    for (const std::uint32_t row : open_) {
      if (second->is_defined(row) && (others[row] != 0) == decisive_) continue;
      if (first->is_defined(row) && second->is_defined(row))
        results[row] = decisive_ ? 0 : 1;
      else
        result_.set_undefined(row);
    }
    return &result_;
  }

 private:
  bool decisive_;
  std::array<ColumnFunctionPtr, 2> operands_;
  ValueColumn result_;
  std::vector<std::uint32_t> open_;
};

class ColumnCompiler {
 public:
  ColumnCompiler(std::size_t left_count, const Frame* outer, Context& context)
      : left_count_(left_count), outer_(outer), context_(context) {}

  ColumnFunctionPtr compile(const TypedNode& node) {
    ColumnFunctionPtr function = compile_plain(node);
    return function == nullptr ? nullptr : node.measured(std::move(function));
  }

 private:
  ColumnFunctionPtr compile_plain(const TypedNode& node) {
    if (is_same_for_all_tuples(node)) {
      const Type* const type = type_in_columns(node.type());
      return type == nullptr ? nullptr : std::make_shared<SameColumn>(node, *type, outer_, context_);
    }
    return std::visit([&](const auto& view) { return compile_view(view); }, node.view());
  }
  ColumnFunctionPtr compile_view(const AttributeView& use) {
    const NodeView tuple = use.tuple.view();
    const auto* parameter = std::get_if<ParameterView>(&tuple);
    if (parameter == nullptr || parameter->level != 0) return nullptr;
    return std::make_shared<AttributeColumn>(parameter->index * left_count_ + use.index);
  }
  ColumnFunctionPtr compile_view(const ConversionView& conversion) {
    return converted(conversion.argument, conversion.to);
  }
  ColumnFunctionPtr compile_view(const ValueCallView& view) {
    const algebra3d::Overload& overload = *view.call.overload;
    const std::string& name = view.call.op->name;
    if (name == "and" || name == "or") {
      ColumnFunctionPtr first = compile(*view.arguments[0]);
      ColumnFunctionPtr second = first == nullptr ? nullptr : compile(*view.arguments[1]);
      return second == nullptr ? nullptr
                               : std::make_shared<DecidedColumn>(name == "or", std::move(first), std::move(second));
    }
    if (overload.kernel == nullptr || !view.call.op->is_pure_in(overload)) return nullptr;
    std::vector<ColumnFunctionPtr> arguments;
    for (std::size_t place = 0; place < view.arguments.size(); ++place) {
      arguments.push_back(converted(*view.arguments[place], *overload.parameters[place].type));
      if (arguments.back() == nullptr) return nullptr;
    }
    return std::make_shared<CalledColumn>(view.call, std::move(arguments), context_);
  }
  template <typename Other>
  ColumnFunctionPtr compile_view(const Other& /*view*/) {
    return nullptr;
  }

  /// An expression as values of a type.
  ColumnFunctionPtr converted(const TypedNode& node, const Type& to) {
    ColumnFunctionPtr function = compile(node);
    if (function == nullptr || node.type() == to.term()) return function;
    const bool is_real = &to == &TypeOf<double>::type() && node.type().is("int");
    return is_real ? std::make_shared<RealColumn>(std::move(function)) : nullptr;
  }

  std::size_t left_count_;
  const Frame* outer_;
  Context& context_;
};

}  // namespace

ColumnFunctionPtr column_function(const TypedNode& body, std::size_t left_count, const Frame* outer, Context& context) {
  return ColumnCompiler(left_count, outer, context).compile(body);
}

}  // namespace queries
