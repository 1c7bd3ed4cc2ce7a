#pragma once

#include <concepts>
#include <cstdint>
#include <cstdlib>

/// How much the random tests do: a landing (scripts/test) makes few rounds of each, scripts/nightly many times as many.
namespace algebra3d {

/// How many times the rounds of a landing are made: the environment variable ALGEBRA3D_EFFORT, 1 without it.
inline int effort() {
  static const int kEffort = [] {
    const char* const value = std::getenv("ALGEBRA3D_EFFORT");
    const int number = value != nullptr ? std::atoi(value) : 1;
    return number > 1 ? number : 1;
  }();
  return kEffort;
}

/// Number of rounds of a random test: `usual` in a landing, `usual` times ALGEBRA3D_EFFORT in the nightly script.
template <std::integral T>
T rounds(T usual) {
  return usual * static_cast<T>(effort());
}

/// Whether a test has its full size, or all of its choices: where a landing makes do with less, and more rounds would
/// find no more.
inline bool is_thorough() {
  return effort() > 1;
}

/// The first seed of the tests that count seeds upwards: ALGEBRA3D_FIRST_SEED, 1 without it.
inline std::uint64_t first_seed() {
  const char* const value = std::getenv("ALGEBRA3D_FIRST_SEED");
  return value != nullptr ? std::strtoull(value, nullptr, 10) : 1;
}

}  // namespace algebra3d
