#include "queries/language/filter_placement.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/estimates.h"
#include "queries/language/index_condition.h"
#include "queries/language/plan_views.h"
#include "queries/streams/batch.h"

namespace queries {
namespace {

/// Where the attributes of a stream come from: by attribute the one of an input; nothing if it is made.
using Origins = std::vector<std::optional<std::size_t>>;

/// Writes conditions on the tuples of a stream as ones on the tuples of its input.
class ConditionMove {
 public:
  ConditionMove(Origins origins, TypeExpr input) : origins_(std::move(origins)), input_(std::move(input)) {}

  /// The condition on the input; null if it is on something else as well.
  TypedPtr moved(const TypedPtr& condition) const {
    if (is_same_for_all_tuples(*condition)) return condition;
    TypedPtr result = std::visit([&](const auto& view) { return moved_view(*condition, view); }, condition->view());
    return result == nullptr ? nullptr : condition->renewed(std::move(result));
  }

 private:
  TypedPtr moved_view(const TypedNode& node, const AttributeView& use) const {
    const auto tuple = view_as<ParameterView>(use.tuple);
    if (!tuple || tuple->level != 0 || tuple->index != 0 || !origins_[use.index]) return nullptr;
    return make_attribute(node.type(), make_parameter(input_, 0, 0, use.tuple.place()), *origins_[use.index],
                          node.place());
  }
  TypedPtr moved_view(const TypedNode& /*node*/, const ConversionView& conversion) const {
    TypedPtr argument = moved(conversion.argument.shared_from_this());
    return argument == nullptr ? nullptr : make_conversion(std::move(argument), conversion.to);
  }
  TypedPtr moved_view(const TypedNode& node, const ValueCallView& view) const {
    if (!view.call.op->is_pure_in(*view.call.overload)) return nullptr;
    std::vector<TypedPtr> arguments;
    for (const TypedPtr& argument : view.arguments) {
      arguments.push_back(moved(argument));
      if (arguments.back() == nullptr) return nullptr;
    }
    return make_value_call(view.call, std::move(arguments), node.place());
  }
  template <typename Other>
  TypedPtr moved_view(const TypedNode& /*node*/, const Other& /*view*/) const {
    return nullptr;
  }

  Origins origins_;
  TypeExpr input_;
};

/// Answers for each kind of node whether its evaluation can neither note anything nor fail.
struct NotesNothing {
  bool operator()(const ConstantView& constant) const { return constant.value != nullptr; }
  bool operator()(const AttributeView& use) const { return view_as<ParameterView>(use.tuple).has_value(); }
  bool operator()(const ConversionView& conversion) const { return notes_nothing(conversion.argument); }
  bool operator()(const ValueCallView& view) const {
    constexpr std::array<std::string_view, 11> kOperators{
        "=", "#", "<", "<=", ">", ">=", "and", "or", "not", "isdefined", "between"};
    return std::ranges::find(kOperators, view.call.op->name) != kOperators.end() &&
           std::ranges::all_of(view.arguments, [](const TypedPtr& each) { return notes_nothing(*each); });
  }
  template <typename Other>
  bool operator()(const Other& /*view*/) const {
    return false;
  }

  /// Values of large types are loaded, which can fail.
  static bool notes_nothing(const TypedNode& node) {
    return type_in_columns(node.type()) != nullptr && std::visit(NotesNothing(), node.view());
  }
};

/// Answers for each kind of node whether its evaluation may do more than give a result: write files, change relations.
struct HasEffects {
  bool operator()(const ConstantView& /*constant*/) const { return false; }
  bool operator()(const ObjectView& /*object*/) const { return false; }
  bool operator()(const ParameterView& /*parameter*/) const { return false; }
  bool operator()(const AttributeView& use) const { return has_effects(use.tuple); }
  bool operator()(const ConversionView& conversion) const { return has_effects(conversion.argument); }
  bool operator()(const ValueCallView& view) const {
    return view.call.op->writes_files_in(*view.call.overload) || any_has_effects(view.arguments);
  }
  bool operator()(const StreamCallView& view) const { return !view.op.is_pure || any_has_effects(view.arguments); }
  bool operator()(const FunctionView& function) const { return has_effects(function.body); }
  bool operator()(const ListView& list) const { return any_has_effects(list.elements); }
  bool operator()(const std::monostate& /*unknown*/) const { return true; }

  static bool has_effects(const TypedNode& node) { return std::visit(HasEffects(), node.view()); }
  static bool any_has_effects(std::span<const TypedPtr> nodes) {
    return std::ranges::any_of(nodes, [](const TypedPtr& each) { return has_effects(*each); });
  }
};

/// The conjunction of conditions, made by calls of `and` as in `predicate`.
TypedPtr conjunction(const TypedNode& predicate, const std::vector<TypedPtr>& conditions) {
  TypedPtr result = conditions.front();
  for (std::size_t i = 1; i < conditions.size(); ++i) {
    const auto both = view_as<ValueCallView>(predicate);
    result = make_value_call(both->call, {result, conditions[i]}, predicate.place());
  }
  return result;
}

/// The conditions of a filter that stay, and those that are asked of an input of the operator below.
struct Division {
  std::vector<TypedPtr> staying, moving;
};

/// `only_silent`: conditions that may note something stay.
Division divided(const std::vector<TypedPtr>& conditions, const ConditionMove& move, bool only_silent) {
  Division result;
  for (const TypedPtr& condition : conditions) {
    const bool may_move = (result.staying.empty() && !only_silent) || NotesNothing::notes_nothing(*condition);
    TypedPtr moved = may_move ? move.moved(condition) : nullptr;
    if (moved != nullptr)
      result.moving.push_back(std::move(moved));
    else
      result.staying.push_back(condition);
  }
  return result;
}

/// A function with another body.
TypedPtr function_of(const TypeExpr& tuple, TypedPtr body, const TypedNode& like) {
  const auto view = view_as<FunctionView>(like);
  return make_function(TypeExpr::map({tuple}, TypeExpr("bool")), std::move(body), view->written, view->height,
                       like.place());
}

/// An operator that hands its input on.
BoundOperator handing_on(const TypeExpr& stream) {
  AttributeSources sources;
  for (std::size_t index = 0; index < stream.element().attributes().size(); ++index) sources.push_back({false, index});
  return {stream, [](std::vector<Datum> given, Context&) -> Result<Datum> { return std::move(given[0]); },
          MakesTuples{std::move(sources)}};
}

class FilterPlacement {
 public:
  FilterPlacement(const algebra3d::Operator& op, BoundOperator& bound, std::vector<TypedPtr>& arguments,
                  const RewriteContext& rewriting)
      : op_(op), bound_(bound), arguments_(arguments), rewriting_(rewriting) {}

  /// Moves conditions to the input at `place` of the operator below.
  Status move_to(std::size_t place, Origins origins, bool only_silent) {
    const auto function = view_as<FunctionView>(*arguments_[1]);
    const auto below = view_as<StreamCallView>(*arguments_[0]);
    if (!function || !below) return {};
    const TypeExpr input = below->arguments[place]->type();
    const ConditionMove move(std::move(origins), input.element());
    const Division division = divided(conjuncts(function->body), move, only_silent);
    if (division.moving.empty()) return {};
    BoundOperator filter = bound_;
    filter.type = input;
    filter.how.clear();
    TypedPtr condition = division.staying.empty() ? move.moved(function->body.shared_from_this())
                                                  : conjunction(function->body, division.moving);
    std::vector<TypedPtr> arguments{below->arguments[place],
                                    function_of(input.element(), std::move(condition), *arguments_[1])};
    A3D_TRY(rewrite(op_, filter, arguments, rewriting_));
    note(below->op.name, filter.how);
    std::vector<TypedPtr> inputs(below->arguments.begin(), below->arguments.end());
    inputs[place] = make_stream_call(op_, std::move(filter), std::move(arguments), arguments_[0]->place());
    const TypeExpr tuple = arguments_[0]->type().element();
    arguments_[0] = with_estimate(with_arguments(arguments_[0], *below, below->bound, std::move(inputs)), rewriting_);
    if (division.staying.empty())
      bound_ = handing_on(bound_.type);
    else
      arguments_[1] =
          arguments_[1]->renewed(function_of(tuple, conjunction(function->body, division.staying), *arguments_[1]));
    bound_.how = how_;
    return {};
  }

  bool is_done() const { return !std::holds_alternative<SelectsElements>(bound_.role); }

 private:
  void note(const std::string& below, const std::string& how) {
    how_ += (how_.empty() ? "moved below " : " and below ") + below;
    if (!how.empty()) how_ += ", " + how;
  }

  const algebra3d::Operator& op_;
  BoundOperator& bound_;
  std::vector<TypedPtr>& arguments_;
  const RewriteContext& rewriting_;
  std::string how_;
};

Origins origins_of(const MakesTuples& making) {
  Origins origins;
  for (const AttributeSource& source : making.sources)
    origins.push_back(source.is_made ? std::nullopt : std::optional(source.index));
  return origins;
}

/// The attributes from `first` on, `count` of them, of `all`.
Origins range_of(std::size_t all, std::size_t first, std::size_t count) {
  Origins origins(all);
  for (std::size_t index = 0; index < count; ++index) origins[first + index] = index;
  return origins;
}

}  // namespace

Status move_conditions_down(const algebra3d::Operator& op, BoundOperator& bound, std::vector<TypedPtr>& arguments,
                            const RewriteContext& rewriting) {
  if (!std::holds_alternative<SelectsElements>(bound.role)) return {};
  const auto below = view_as<StreamCallView>(*arguments[0]);
  if (!below || !arguments[0]->type().is_tuple_stream()) return {};
  FilterPlacement placement(op, bound, arguments, rewriting);
  const std::size_t count = attribute_count(*arguments[0]);
  if (const auto* making = std::get_if<MakesTuples>(&below->bound.role)) {
    // Functions with effects are called for all tuples.
    if (HasEffects::any_has_effects(below->arguments.subspan(1))) return {};
    return placement.move_to(0, origins_of(*making), false);
  }
  if (const auto* sort = std::get_if<SortsTuples>(&below->bound.role); sort != nullptr && sort->left_out)
    return placement.move_to(0, range_of(count, 0, count), false);
  const auto* pairs = std::get_if<PairsTuples>(&below->bound.role);
  if (pairs == nullptr) return {};
  const std::size_t left = pairs->left_count;
  A3D_TRY(placement.move_to(0, range_of(count, 0, left), true));
  return placement.is_done() ? Status() : placement.move_to(1, range_of(count, left, count - left), true);
}

}  // namespace queries
