#pragma once

#include <cfenv>

namespace algebra3d {

/// Sets the rounding mode of this thread to nearest until the end of the scope, and then to what it was: error bounds
/// of filters and roundings of results rely on it. Cost: some nanoseconds.
class NearestRounding {
 public:
  NearestRounding() : before_(std::fegetround()) {
    if (before_ != FE_TONEAREST) std::fesetround(FE_TONEAREST);
  }
  ~NearestRounding() {
    if (before_ != FE_TONEAREST) std::fesetround(before_);
  }
  NearestRounding(const NearestRounding&) = delete;
  NearestRounding& operator=(const NearestRounding&) = delete;

 private:
  int before_;
};

}  // namespace algebra3d
