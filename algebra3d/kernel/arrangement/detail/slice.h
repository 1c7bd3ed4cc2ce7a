#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace algebra3d::arrangement {

/// A run of consecutive elements of a vector that is known from the context: from `first` up to `last`, without that.
struct Slice {
  std::uint32_t first = 0, last = 0;

  /// The elements of `values` from the one at `first` on to the end.
  template <typename T>
  static Slice from(std::size_t first, const std::vector<T>& values) {
    return between(first, values.size());
  }
  static Slice between(std::size_t first, std::size_t last) {
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
  }
  std::size_t size() const { return last - first; }
  template <typename T>
  std::span<const T> of(const std::vector<T>& values) const {
    return std::span(values).subspan(first, size());
  }

  friend bool operator==(const Slice&, const Slice&) = default;
};

}  // namespace algebra3d::arrangement
