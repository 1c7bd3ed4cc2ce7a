#include "algebra3d/repair/detail/work_limits.h"
#include "algebra3d/arrangement/operand.h"

#include <cstddef>
#include <cstdint>

namespace algebra3d {

ArrangementOptions work_limits(const RepairOptions& options) {
  // Beyond 2^63 the conversion would be undefined.
  const auto count = [](double number) { return number < 0x1p63 ? static_cast<std::size_t>(number) : SIZE_MAX; };
  return {Closure::together, count(options.work_limit * 1e6), count(options.work_limit * 1e3)};
}

}  // namespace algebra3d
