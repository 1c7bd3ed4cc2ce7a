#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"

namespace algebra3d {

namespace detail {

// The argument type of a state's `step`.
template <typename Step>
struct ArgumentOfStep;
template <typename State, typename Return, typename Argument, typename... Rest>
struct ArgumentOfStep<Return (State::*)(Argument, Rest...)> {
  using Type = std::remove_cvref_t<Argument>;
  /// void: the step takes no context and does not fail.
  using Returned = std::conditional_t<sizeof...(Rest) == 0, Return, Status>;
};

template <typename State>
class TypedAggregateState final : public AggregateState {
 public:
  using Argument = typename ArgumentOfStep<decltype(&State::step)>::Type;
  using StepResult = typename ArgumentOfStep<decltype(&State::step)>::Returned;

  Status step(const Value& value, Context& context) override {
    const auto& content = value.get<Argument>();
    if constexpr (std::is_invocable_v<decltype(&State::step), State&, const Argument&, Context&>)
      return status_of([&] { return state_.step(content, context); });
    else
      return status_of([&] { return state_.step(content); });
  }
  Status step_rows(const ValueColumn& column, SelectedRows rows, Context& context) override {
    if constexpr (InColumn<Argument> && std::is_same_v<StepResult, void>) {
      const auto* const values = column.data<Argument>();
      rows.for_each([&](std::size_t row) {
        if (column.is_defined(row)) state_.step(values[row]);
      });
      return {};
    } else {
      return AggregateState::step_rows(column, rows, context);
    }
  }
  Status combine(AggregateState& later, Context& context) override {
    State& other = static_cast<TypedAggregateState&>(later).state_;
    if constexpr (std::is_invocable_v<decltype(&State::combine), State&, State&&, Context&>)
      return status_of([&] { return state_.combine(std::move(other), context); });
    else
      return status_of([&] { return state_.combine(std::move(other)); });
  }
  Result<Outcome> finish(Context& context) override {
    if constexpr (std::is_invocable_v<decltype(&State::finish), State&, Context&>)
      return ResultOf<decltype(state_.finish(context))>::outcome(state_.finish(context));
    else
      return ResultOf<decltype(state_.finish())>::outcome(state_.finish());
  }

  static constexpr bool kHasParts = requires { State::kHasParts; };
  bool keeps_values() const override {
    return requires {
      State::kKeepsValues;
    };
  }

 private:
  template <typename Call>
  static Status status_of(Call call) {
    if constexpr (std::is_void_v<decltype(call())>)
      return call(), Status();
    else
      return call();
  }

  State state_;
};

template <typename Finish>
struct ResultOfFinish;
template <typename State, typename Return, typename... Rest>
struct ResultOfFinish<Return (State::*)(Rest...)> {
  using Type = Return;
};
template <typename State, typename Return, typename... Rest>
struct ResultOfFinish<Return (State::*)(Rest...) const> {
  using Type = Return;
};

}  // namespace detail

/// The overload of an aggregate with the state `State`, a default-constructible class with
///
///     void step(const T& value);            // takes one more defined value
///     void combine(State&& later);          // takes what `later` took, as if its values came after this one's
///     R finish();                           // the result of all; called once, at the end
///
/// and, if it keeps all values until the end, a constant kKeepsValues; if `step` of results of parts of the values, all
/// of them, gives the result of the values, and undefined for a part says that it has none, a constant kHasParts.
/// Each may take a `Context&` as well; `step` and `combine` may return a Status, R is T, Maybe<T> or Result of these.
/// The combined result must not depend on the division of the input into consecutive parts.
template <typename State>
Overload aggregate(std::string_view parameter) {
  using Typed = detail::TypedAggregateState<State>;
  using Returned = typename detail::ResultOfFinish<decltype(&State::finish)>::Type;
  Overload overload;
  overload.parameters = {{std::string(parameter), &TypeOf<typename Typed::Argument>::type(), true}};
  overload.result = &TypeOf<typename detail::ResultOf<Returned>::Content>::type();
  if constexpr (Typed::kHasParts) overload.part = overload.result;
  overload.start = []() -> std::unique_ptr<AggregateState> { return std::make_unique<Typed>(); };
  return overload;
}

/// One run of an aggregate over values: what a host calls. If the context takes failed calls, it keeps the values: all
/// that the state keeps anyway, of others some megabytes. Errors of all members: those of the aggregate; internal for
/// an exception that it throws.
class Aggregation {
 public:
  /// `call` must be an aggregate, resolved for the type of the values.
  explicit Aggregation(const ResolvedCall& call) : call_(call), state_(call.overload->start()) {}

  /// Adds a value. Undefined values are left out; `finish` reports their number if the description says so.
  Status step(const Value& value, Context& context);
  /// Adds the values of a column, of exactly the type of the call, at these rows, in their order. Values that it takes
  /// so are not kept for a report of a failure.
  Status step_rows(const ValueColumn& column, SelectedRows rows, Context& context);
  /// Adds the values of `later`, a run of the same overload, after those of this run.
  Status combine(Aggregation& later, Context& context);
  /// Returns the result; called once. Reports the reason if it is undefined.
  Result<Value> finish(Context& context);

  /// The result of a run for another process, which adds it to a run of the same overload in place of the values.
  struct Part {
    Value result;  ///< of the type Overload::part, which must not be null; undefined if there was no value
    std::uint64_t undefined_count = 0;
  };
  /// Called once, in place of `finish`.
  Result<Part> finish_part(Context& context);
  Status step_part(const Part& part, Context& context);

 private:
  /// The defined values so far, for a report of a failure; none once they are too many.
  struct Taken {
    std::vector<Value> values = {};
    std::size_t bytes = 0;
    bool is_whole = true;
  };

  void keep(const Value& value, const Context& context);
  void keep(const Taken& later);
  void forget_if_too_many();
  void note_failure(const Error& error, Context& context) const;

  ResolvedCall call_;
  std::unique_ptr<AggregateState> state_;
  std::uint64_t undefined_count_ = 0;
  Taken taken_;
};

}  // namespace algebra3d
