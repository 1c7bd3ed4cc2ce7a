// The laws of set algebra on random solids: 43 checks in each round, with operands of one family (random_solids.h) and
// equality as sets of points; each result on the way is proved valid, and is minimal if its operands are.
//
// A failure says its seed; with ALGEBRA3D_FIRST_SEED=N it is repeated first. Millions of checks over night:
// scripts/nightly-laws, which makes an optimised build that keeps assertions.
#include <gtest/gtest.h>

#include <unistd.h>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <string>

#include "support/rounds.h"
#include "unit/arrangement/laws.h"

namespace algebra3d::solids {
namespace {

volatile std::sig_atomic_t seed_now = 0;

/// An assertion that fails within the engine says nothing of the operands.
void say_seed(int signal) {
  char text[80];
  const int length = std::snprintf(text, sizeof text, "ALGEBRA3D_FIRST_SEED=%ld\n", static_cast<long>(seed_now));
  if (write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) _exit(2);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

TEST(LawsOfSetAlgebra, hold_for_random_solids) {
  const std::uint64_t first = first_seed(), count = rounds(10U);
  std::size_t checks = 0;
  const auto previous = std::signal(SIGABRT, say_seed);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    seed_now = static_cast<std::sig_atomic_t>(seed);
    LawTrial trial(seed);
    trial.run();
    checks += trial.check_count();
    // Go on: the next seed may fail in a smaller case.
    EXPECT_EQ(trial.findings(), "") << "ALGEBRA3D_FIRST_SEED=" << seed;
  }
  std::signal(SIGABRT, previous);
  RecordProperty("checks", std::to_string(checks));
  EXPECT_EQ(checks, 43 * count);
}

// Here results of operations touch their own edges with a corner, where nothing else is near, and are operands again.
TEST(LawsOfSetAlgebra, hold_where_operands_touch_their_own_edges) {
  for (const std::uint64_t seed : {20262515, 20264305}) {
    LawTrial trial(seed);
    trial.run();
    EXPECT_EQ(trial.findings(), "") << seed;
  }
}

}  // namespace
}  // namespace algebra3d::solids
