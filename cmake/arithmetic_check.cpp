// Proves at configure time that the compiler neither fuses nor reassociates floating-point operations, and that it
// respects the rounding mode. Prints the first violation and exits with 1.
#include <cfenv>
#include <cstdio>

namespace {

volatile double tiny = 0x1p-53;
volatile double one = 1.0;

bool products_are_rounded() {
  volatile double a = 1.0 + 0x1p-30;
  const double x = a;
  const double rounded = x * x;
  return x * x - rounded == 0.0;  // a fused multiply-add would leave the rounding error of the product
}

bool sums_are_not_reassociated() {
  const double x = one;
  const double t = tiny;
  return (x + t) - x == 0.0;
}

bool rounding_mode_is_respected() {
  std::fesetround(FE_UPWARD);
  const double up = one + tiny;
  std::fesetround(FE_DOWNWARD);
  const double down = one + tiny;
  std::fesetround(FE_TONEAREST);
  return up > 1.0 && down == 1.0;
}

int check(bool holds, const char* what) {
  if (!holds) std::printf("violated: %s\n", what);
  return holds ? 0 : 1;
}

}  // namespace

int main() {
  return check(products_are_rounded(), "products are rounded before they are added") +
         check(sums_are_not_reassociated(), "sums are not reassociated") +
         check(rounding_mode_is_respected(), "the rounding mode is respected");
}
