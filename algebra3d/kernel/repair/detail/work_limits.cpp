#include "algebra3d/kernel/repair/detail/work_limits.h"
#include "algebra3d/kernel/arrangement/operand.h"

#include <cstddef>
#include <cstdint>

namespace algebra3d {

namespace {

/// Beyond 2^63 the conversion would be undefined.
std::size_t count(double number) {
  return number < 0x1p63 ? static_cast<std::size_t>(number) : SIZE_MAX;
}

}  // namespace

ArrangementOptions work_limits(const RepairOptions& options) {
  return {Closure::together, count(options.work_limit * 1e6), count(options.work_limit * 1e3)};
}

std::uint64_t exact_work_limit(const RepairOptions& options) {
  return count(options.work_limit * 1e6);
}

}  // namespace algebra3d
