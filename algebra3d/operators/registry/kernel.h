#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/value_column.h"

namespace algebra3d {

/// A call of a kernel: a scalar operator on many rows at once.
struct KernelCall {
  std::span<const ValueColumn* const> arguments;  ///< of exactly the parameter types
  SelectedRows rows;
  ValueColumn& result;  ///< of the result type, with room for all rows
  /// Takes the reason of each undefined result that is not due to an undefined argument, in the order of rows.
  const std::function<void(const Undefined&)>& report;
};
/// Calls an operator for each of the selected rows, with the results, undefined values and reasons of Registry::call.
using Kernel = void (*)(const KernelCall& call);

/// The outcome of an operator that computes reals and whose result is not finite.
inline Undefined not_finite() {
  return {"the result is not a finite number"};
}

namespace detail {

template <typename T>
struct ContentOfResult {
  using Type = T;
};
template <typename T>
struct ContentOfResult<Maybe<T>> {
  using Type = T;
};

/// The kernel of a C++ function of values that stand in columns.
template <auto Function, typename Return, typename... Parameters>
struct KernelMaker {
  using Content = typename ContentOfResult<Return>::Type;
  static constexpr bool kExists = InColumn<Content> && sizeof...(Parameters) > 0 &&
                                  (InColumn<std::remove_cvref_t<Parameters>> && ...);

  static void run(const KernelCall& call) { run(call, std::index_sequence_for<Parameters...>()); }

 private:
  template <std::size_t... Place>
  static void run(const KernelCall& call, std::index_sequence<Place...> /*places*/) {
    const std::tuple arrays{call.arguments[Place]->template data<std::remove_cvref_t<Parameters>>()...};
    auto* const results = call.result.data<Content>();
    const auto compute = [&](std::size_t row) { put(call, results, row, Function(std::get<Place>(arrays)[row]...)); };
    if (!(call.arguments[Place]->has_undefined() || ...)) return call.rows.for_each(compute);
    call.rows.for_each([&](std::size_t row) {
      if ((call.arguments[Place]->is_defined(row) && ...))
        compute(row);
      else
        call.result.set_undefined(row);
    });
  }

  template <typename Results>
  static void put(const KernelCall& call, Results* results, std::size_t row, Content content) {
    if constexpr (std::is_same_v<Content, double>)
      if (!std::isfinite(content)) return put_undefined(call, row, not_finite());
    if constexpr (std::is_same_v<Content, bool>)
      results[row] = content ? 1 : 0;
    else
      results[row] = std::move(content);
  }
  template <typename Results>
  static void put(const KernelCall& call, Results* results, std::size_t row, Maybe<Content> content) {
    if (content) [[likely]]
      put(call, results, row, *std::move(content));
    else
      put_undefined(call, row, Undefined{content.reason()});
  }
  static void put_undefined(const KernelCall& call, std::size_t row, const Undefined& undefined) {
    call.report(undefined);
    call.result.set_undefined(row);
  }
};

}  // namespace detail

/// The kernel of a C++ function; null if a parameter or the result does not stand in columns.
template <auto Function, typename Return, typename... Parameters>
constexpr Kernel kernel_of() {
  using Maker = detail::KernelMaker<Function, Return, Parameters...>;
  if constexpr (Maker::kExists)
    return &Maker::run;
  else
    return nullptr;
}

}  // namespace algebra3d
