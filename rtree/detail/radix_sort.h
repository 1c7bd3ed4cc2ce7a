#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rtree/detail/storage.h"

namespace rtree {

/// An entry during bulk loading: where it lies on the curve, and its index in the input.
struct Place {
  std::uint32_t code;  ///< of 30 bits
  std::uint32_t index;
};

/// Sorts by code; equal codes keep their order. `buffer` is as long as `places`. In parallel if there are many. Cost:
/// linear.
void radix_sort(std::span<Place> places, std::span<Place> buffer);

}  // namespace rtree
