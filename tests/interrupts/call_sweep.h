#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "interrupts/large_values.h"

namespace algebra3d::interrupts {

/// Something to be interrupted.
struct Work {
  std::string name;
  std::function<std::string(const std::atomic<bool>& flag)> run;
};

/// A call with large arguments for each overload of an operator over values that takes a type with large values.
/// Other arguments are those of an example.
std::vector<Work> calls(const Registry& registry, const LargeValues& values, const std::string& what);
/// Every aggregate over many values.
std::vector<Work> aggregations(const Registry& registry, std::size_t count);
/// Writing, reading, printing, comparing and hashing values.
std::vector<Work> value_work(const Registry& registry, const LargeValues& values, const std::string& what);

}  // namespace algebra3d::interrupts
