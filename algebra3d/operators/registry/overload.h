#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"

namespace algebra3d {

/// A parameter of which only box and count are needed, so that its geometry is not loaded.
template <typename T>
struct HeaderOf {
  GeometryHeader header;
};

/// A parameter whose geometry is loaded when it is asked for: box and count may be enough.
template <typename T>
class OnDemand {
 public:
  explicit OnDemand(const Value& value) : value_(&value) {}

  GeometryHeader header() const { return value_->header(); }
  /// The value. Errors: those of loading.
  Result<T> load() const {
    if (!value_->is_deferred()) return value_->get<T>();
    A3D_ASSIGN(const Value loaded, value_->loaded());
    return loaded.template get<T>();
  }
  /// Blocks of its faces (DeferredValue::face_blocks); null if it has none. Errors: those of loading.
  Result<std::shared_ptr<const FaceBlocks>> face_blocks() const {
    if (!value_->is_deferred()) return std::shared_ptr<const FaceBlocks>();
    return value_->deferred()->face_blocks();
  }
  /// The value, perhaps deferred, for who needs it after the call.
  const Value& value() const { return *value_; }

 private:
  const Value* value_;
};

namespace detail {

// The conversion of a Value to a C++ parameter.
template <typename T>
struct ArgumentOf {
  static constexpr bool kAcceptsUndefined = false;
  static constexpr bool kNeedsContent = true;
  static const Type& type() { return TypeOf<T>::type(); }
  static const T& take(const Value& value) { return value.get<T>(); }
};

template <typename T>
struct ArgumentOf<HeaderOf<T>> {
  static constexpr bool kAcceptsUndefined = false;
  static constexpr bool kNeedsContent = false;
  static const Type& type() { return TypeOf<T>::type(); }
  static HeaderOf<T> take(const Value& value) { return {value.header()}; }
};

template <typename T>
struct ArgumentOf<OnDemand<T>> {
  static constexpr bool kAcceptsUndefined = false;
  static constexpr bool kNeedsContent = false;
  static const Type& type() { return TypeOf<T>::type(); }
  static OnDemand<T> take(const Value& value) { return OnDemand<T>(value); }
};

template <typename T>
struct ArgumentOf<std::optional<T>> {
  static constexpr bool kAcceptsUndefined = true;
  static constexpr bool kNeedsContent = ArgumentOf<T>::kNeedsContent;
  static const Type& type() { return ArgumentOf<T>::type(); }
  static std::optional<T> take(const Value& value) {
    if (!value.is_defined()) return std::nullopt;
    return ArgumentOf<T>::take(value);
  }
};

// The conversion of a C++ result: its database type or columns, and its outcome.
template <typename T>
struct ResultOf {
  using Content = T;
  using Returned = Outcome;
  static constexpr bool kIsTable = false;
  static constexpr bool kIsTotal = !std::is_same_v<T, double>;
  static constexpr bool kNeverFails = true;
  static void describe(Overload& overload) { overload.result = &TypeOf<T>::type(); }
  static Result<Outcome> outcome(T result) {
    if constexpr (std::is_same_v<T, double>)
      if (!std::isfinite(result)) return Outcome(not_finite());
    return Outcome(Value::of<T>(std::move(result)));
  }
};

// A table; the names of its columns are those of `table<...>`.
template <typename... T>
struct ResultOf<Rows<T...>> {
  using Returned = TableOutcome;
  static constexpr bool kIsTable = true;
  static constexpr bool kIsTotal = false;
  static constexpr bool kNeverFails = false;  // a row may fail
  static void describe(Overload& overload) {
    for (const Type* type : Rows<T...>::types()) overload.columns.push_back({"", type});
  }
  static Result<TableOutcome> outcome(Rows<T...> rows) { return TableOutcome(std::move(rows).source()); }
};

template <typename T>
struct ResultOf<Elements<T>> : ResultOf<Rows<T>> {
  static void describe(Overload& overload) {
    overload.columns = {{"Elem", &TypeOf<T>::type()}};
    overload.gives_elements = true;
  }
};

template <typename T>
struct ResultOf<std::vector<T>> : ResultOf<Elements<T>> {
  static Result<TableOutcome> outcome(std::vector<T> result) {
    using Elements = Elements<T>;
    auto next = [elements = std::move(result), position = std::size_t{0}](Context&) mutable {
      using Next = Result<std::optional<typename Elements::Cells>>;
      return position == elements.size() ? Next(std::nullopt) : Next(std::tuple(std::move(elements[position++])));
    };
    return ResultOf<Elements>::outcome(Elements(std::move(next)));
  }
};

// One row, for functions that return several numbers.
template <typename... T>
struct ResultOf<std::tuple<T...>> : ResultOf<Rows<T...>> {
  static void describe(Overload& overload) {
    ResultOf<Rows<T...>>::describe(overload);
    overload.has_one_row = true;
  }
  static Result<TableOutcome> outcome(std::tuple<T...> row) {
    return ResultOf<Rows<T...>>::outcome(Rows<T...>(std::vector{std::move(row)}));
  }
};

// One row or none.
template <typename... T>
struct ResultOf<std::optional<std::tuple<T...>>> : ResultOf<std::tuple<T...>> {
  static Result<TableOutcome> outcome(std::optional<std::tuple<T...>> row) {
    std::vector<std::tuple<T...>> rows;
    if (row) rows.push_back(*std::move(row));
    return ResultOf<Rows<T...>>::outcome(Rows<T...>(std::move(rows)));
  }
};

template <typename T>
struct ResultOf<Maybe<T>> : ResultOf<T> {
  using Returned = typename ResultOf<T>::Returned;
  static constexpr bool kIsTotal = false;
  static Result<Returned> outcome(Maybe<T> result) {
    if (!result) return Returned(Undefined{result.reason()});
    return ResultOf<T>::outcome(std::move(result).value());
  }
};

template <typename T>
struct ResultOf<Result<T>> : ResultOf<T> {
  using Returned = typename ResultOf<T>::Returned;
  static constexpr bool kIsTotal = false;
  static constexpr bool kNeverFails = false;
  static Result<Returned> outcome(Result<T> result) {
    if (!result) return std::move(result).error();
    return ResultOf<T>::outcome(std::move(result).value());
  }
};

template <auto Function, bool kTakesContext, typename Return, typename... Parameters>
struct OverloadMaker {
  using Results = ResultOf<std::remove_cvref_t<Return>>;
  using Returned = typename Results::Returned;

  template <typename P>
  using Argument = ArgumentOf<std::remove_cvref_t<P>>;

  template <std::size_t... Index>
  static Result<Returned> call([[maybe_unused]] std::span<const Value> given, Context& context,
                               std::index_sequence<Index...> places) {
    if (((Argument<Parameters>::kNeedsContent && given[Index].is_deferred()) || ...))
      return call_loaded(given, context, places);
    if constexpr (kTakesContext)
      return Results::outcome(Function(context, Argument<Parameters>::take(given[Index])...));
    else
      return Results::outcome(Function(Argument<Parameters>::take(given[Index])...));
  }

  template <std::size_t... Index>
  static Result<Returned> call_loaded(std::span<const Value> given, Context& context,
                                      std::index_sequence<Index...> places) {
    std::vector<Value> values(given.begin(), given.end());
    Status loading;
    ((loading.ok() && Argument<Parameters>::kNeedsContent ? load(values[Index], loading) : void()), ...);
    if (!loading) return std::move(loading).error();
    return call(values, context, places);
  }

  /// Whether an argument may be deferred, and is loaded before the call.
  template <typename P>
  static bool may_load() {
    return Argument<P>::kNeedsContent && Argument<P>::type().is_large();
  }

  static void load(Value& value, Status& status) {
    if (!value.is_deferred()) return;
    auto loaded = value.loaded();
    if (loaded)
      value = std::move(loaded).value();
    else
      status = std::move(loaded).error();
  }

  static Overload make([[maybe_unused]] std::array<std::string_view, sizeof...(Parameters)> names) {
    Overload overload;
    [[maybe_unused]] std::size_t place = 0;
    (overload.parameters.push_back(
         {std::string(names[place++]), &Argument<Parameters>::type(), Argument<Parameters>::kAcceptsUndefined}),
     ...);
    Results::describe(overload);
    overload.is_total = Results::kIsTotal;
    overload.never_fails = Results::kNeverFails && (!may_load<Parameters>() && ...);
    const auto implementation = [](std::span<const Value> values, Context& context) {
      return call(values, context, std::index_sequence_for<Parameters...>());
    };
    if constexpr (Results::kIsTable) {
      overload.rows = implementation;
    } else {
      overload.function = implementation;
      if constexpr (!kTakesContext && Results::kNeverFails)
        overload.kernel = kernel_of<Function, Return, Parameters...>();
    }
    return overload;
  }
};

template <auto Function, typename Signature>
struct SignatureOf;

template <auto Function, typename Return, typename... Parameters>
struct SignatureOf<Function, Return (*)(Parameters...)> : OverloadMaker<Function, false, Return, Parameters...> {
  static constexpr std::size_t kParameters = sizeof...(Parameters);
};

template <auto Function, typename Return, typename... Parameters>
struct SignatureOf<Function, Return (*)(Context&, Parameters...)>
    : OverloadMaker<Function, true, Return, Parameters...> {
  static constexpr std::size_t kParameters = sizeof...(Parameters);
};

}  // namespace detail

/// The overload that calls `Function`, with one name per parameter for people. Parameters are deduced from the
/// function: `const T&` or T (a defined value), `std::optional<T>` (undefined too), `HeaderOf<T>` (box and count, no
/// geometry), `OnDemand<T>` (geometry when asked for), each perhaps after a leading `Context&`. It returns T,
/// `Maybe<T>`, `Result<...>` of these, or `std::vector<T>` or Elements<T> (a table of one column, Elem). A real that is
/// not finite becomes undefined.
template <auto Function, typename... Names>
Overload overload(Names... names) {
  using Signature = detail::SignatureOf<Function, decltype(Function)>;
  static_assert(sizeof...(Names) == Signature::kParameters, "one name per parameter");
  return Signature::make({std::string_view(names)...});
}

/// The overload of a table operator that calls `Function`, with the names of its columns and one name per parameter.
/// The function returns Rows<T...>, `std::tuple<T...>` (one row), an optional of that (one row or none), or Maybe or
/// Result of these.
template <auto Function, typename... Names>
Overload table(std::initializer_list<std::string_view> columns, Names... names) {
  Overload made = overload<Function>(names...);
  assert(made.columns.size() == columns.size() && !made.gives_elements);
  std::size_t place = 0;
  for (const std::string_view name : columns) made.columns[place++].name = name;
  return made;
}

/// Marks an overload as symmetric in its two operands.
inline Overload symmetric(Overload overload) {
  overload.is_symmetric = true;
  return overload;
}

/// Marks an overload of an operator on files as one that takes their content instead.
inline Overload without_files(Overload overload, Cost cost) {
  overload.is_without_files = true;
  overload.cost = cost;
  return overload;
}

}  // namespace algebra3d
