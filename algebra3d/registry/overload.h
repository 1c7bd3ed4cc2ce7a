#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "algebra3d/registry/operator.h"

namespace algebra3d {

/// A parameter for which only box and count of the argument are needed: the operator then reads no geometry.
template <typename T>
struct HeaderOf {
  GeometryHeader header;
};

namespace detail {

// How a C++ parameter takes a Value.
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
struct ArgumentOf<std::optional<T>> {
  static constexpr bool kAcceptsUndefined = true;
  static constexpr bool kNeedsContent = ArgumentOf<T>::kNeedsContent;
  static const Type& type() { return ArgumentOf<T>::type(); }
  static std::optional<T> take(const Value& value) {
    if (!value.is_defined()) return std::nullopt;
    return ArgumentOf<T>::take(value);
  }
};

// What a C++ result means: the database type, whether it is a stream, and the outcome.
template <typename T>
struct ResultOf {
  using Content = T;
  static constexpr bool kIsStream = false;
  static constexpr bool kIsTotal = !std::is_same_v<T, double>;
  static Result<Outcome> outcome(T result) {
    if constexpr (std::is_same_v<T, double>)
      if (!std::isfinite(result)) return Outcome(Undefined{"the result is no finite number"});
    return Outcome(Value::of<T>(std::move(result)));
  }
};

template <typename T>
struct ResultOf<Maybe<T>> {
  using Content = typename ResultOf<T>::Content;
  static constexpr bool kIsStream = ResultOf<T>::kIsStream;
  static constexpr bool kIsTotal = false;
  static Result<Outcome> outcome(Maybe<T> result) {
    if (!result) return Outcome(Undefined{result.reason()});
    return ResultOf<T>::outcome(std::move(result).value());
  }
};

template <typename T>
struct ResultOf<Result<T>> {
  using Content = typename ResultOf<T>::Content;
  static constexpr bool kIsStream = ResultOf<T>::kIsStream;
  static constexpr bool kIsTotal = false;
  static Result<Outcome> outcome(Result<T> result) {
    if (!result) return std::move(result).error();
    return ResultOf<T>::outcome(std::move(result).value());
  }
};

template <typename T>
struct ResultOf<std::vector<T>> {
  using Content = T;
  static constexpr bool kIsStream = true;
  static constexpr bool kIsTotal = false;
  static Result<Outcome> outcome(std::vector<T> result) {
    std::vector<Value> values;
    values.reserve(result.size());
    for (T& element : result) values.push_back(Value::of<T>(std::move(element)));
    return Outcome(std::move(values));
  }
};

template <auto Function, bool kTakesContext, typename Return, typename... Parameters>
struct OverloadMaker {
  using Results = ResultOf<std::remove_cvref_t<Return>>;

  template <typename P>
  using Argument = ArgumentOf<std::remove_cvref_t<P>>;

  template <std::size_t... Index>
  static Result<Outcome> call([[maybe_unused]] std::span<const Value> given, Context& context,
                              std::index_sequence<Index...> places) {
    if (((Argument<Parameters>::kNeedsContent && given[Index].is_deferred()) || ...))
      return call_loaded(given, context, places);
    if constexpr (kTakesContext)
      return Results::outcome(Function(context, Argument<Parameters>::take(given[Index])...));
    else
      return Results::outcome(Function(Argument<Parameters>::take(given[Index])...));
  }

  template <std::size_t... Index>
  static Result<Outcome> call_loaded(std::span<const Value> given, Context& context,
                                     std::index_sequence<Index...> places) {
    std::vector<Value> values(given.begin(), given.end());
    Status loading;
    ((loading.ok() && Argument<Parameters>::kNeedsContent ? load(values[Index], loading) : void()), ...);
    if (!loading) return std::move(loading).error();
    return call(values, context, places);
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
    overload.result = &TypeOf<typename Results::Content>::type();
    overload.result_is_stream = Results::kIsStream;
    overload.is_total = Results::kIsTotal;
    overload.function = [](std::span<const Value> values, Context& context) {
      return call(values, context, std::index_sequence_for<Parameters...>());
    };
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

/// The overload that calls `Function`, with one name per parameter for people. Parameters are read off the function:
/// `const T&` or T (a defined value), `std::optional<T>` (undefined too), `HeaderOf<T>` (box and count, no geometry),
/// each perhaps after a leading `Context&`. It returns T, `Maybe<T>`, `Result<...>` of these, or `std::vector<T>` (a
/// stream). A real that is not finite becomes undefined.
template <auto Function, typename... Names>
Overload overload(Names... names) {
  using Signature = detail::SignatureOf<Function, decltype(Function)>;
  static_assert(sizeof...(Names) == Signature::kParameters, "one name per parameter");
  return Signature::make({std::string_view(names)...});
}

/// The same overload, said to be symmetric in its two operands.
inline Overload symmetric(Overload overload) {
  overload.is_symmetric = true;
  return overload;
}

}  // namespace algebra3d
