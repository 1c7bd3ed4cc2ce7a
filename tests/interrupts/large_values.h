#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d::interrupts {

/// Large values of the types that have such: two of each that meet, with about `size` triangles, points or segments.
class LargeValues {
 public:
  enum class Coordinates : bool { doubles, fractions };

  LargeValues(std::size_t size, Coordinates coordinates);

  /// The value of a type for the argument with this number; null if there is none.
  const Value* find(const Type& type, std::size_t argument) const;

 private:
  std::map<std::string, std::vector<Value>, std::less<>> values_;
};

/// Many small values, for aggregates: bodies in a row of which neighbours overlap, and the like; empty for other types.
std::vector<Value> many_values(const Type& type, std::size_t count);

}  // namespace algebra3d::interrupts
