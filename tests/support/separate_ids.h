#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace algebra3d {

template <typename A, typename B>
concept AreCompared = requires(A a, B b) {
  a == b;
};

/// Neither can be made from the other, be assigned to it, or be compared with it.
template <typename A, typename B>
constexpr bool kAreApart = !std::is_constructible_v<A, B> && !std::is_constructible_v<B, A> &&
                           !std::is_assignable_v<A&, B> && !std::is_assignable_v<B&, A> && !AreCompared<A, B>;

/// Becomes an integer, or one becomes it, only where this is written out.
template <typename Id, typename Integer>
constexpr bool kIsNoInteger =
    !std::is_convertible_v<Id, Integer> && !std::is_convertible_v<Integer, Id> &&
    !std::is_constructible_v<Integer, Id> && !std::is_assignable_v<Id&, Integer> && !AreCompared<Id, Integer>;

/// Checks at compile time that no id passes for another one or for an integer, and that it costs no more than one.
template <typename Id, typename... Others>
constexpr void check_pairs() {
  static_assert((kAreApart<Id, Others> && ...));
  static_assert(kIsNoInteger<Id, std::uint32_t> && kIsNoInteger<Id, int> && kIsNoInteger<Id, std::size_t>);
  static_assert(sizeof(Id) == sizeof(std::uint32_t) && std::is_trivially_copyable_v<Id>);
  static_assert(Id().is_none());
  if constexpr (sizeof...(Others) > 0) check_pairs<Others...>();
}

}  // namespace algebra3d
