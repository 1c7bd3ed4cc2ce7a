#pragma once

#include <cstdint>

namespace algebra3d {

/// Codes the corners of faces, one after the other, relative to the lowest point that no corner so far has: 0 is that
/// point, e the point e before it, and a number beyond is that point itself, which is greater than any such e. Codes
/// are small where points are numbered in the order of their first use. Encoder and decoder make the same steps.
class CornerCode {
 public:
  std::uint64_t encode(std::uint32_t point) {
    const std::uint64_t code = point <= next_ ? next_ - point : point;
    if (point == next_) ++next_;
    return code;
  }
  std::uint64_t decode(std::uint64_t code) {
    const std::uint64_t point = code <= next_ ? next_ - code : code;
    if (code == 0) ++next_;
    return point;
  }

 private:
  std::uint64_t next_ = 0;
};

}  // namespace algebra3d
