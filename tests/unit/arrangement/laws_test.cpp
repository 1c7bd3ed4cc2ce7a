// The laws of set algebra on random solids: 43 checks in each round, with operands of one family (random_solids.h) and
// equality as sets of points; each result on the way is proved valid, and is minimal if its operands are.
//
// ALGEBRA3D_LAW_ROUNDS says how many rounds, ALGEBRA3D_LAW_SEED which seed is the first (default: 1). A failure says
// its seed; ALGEBRA3D_LAW_ROUNDS=1 ALGEBRA3D_LAW_SEED=N repeats it. The default takes some 20 seconds with sanitizers.
// Millions of checks over night: scripts/nightly-laws, which makes an optimised build that keeps assertions.
#include <gtest/gtest.h>

#include <unistd.h>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "unit/arrangement/laws.h"

namespace algebra3d::solids {
namespace {

volatile std::sig_atomic_t seed_now = 0;

/// An assertion that fails within the engine says nothing of the operands.
void say_seed(int signal) {
  char text[80];
  const int length = std::snprintf(text, sizeof text, "ALGEBRA3D_LAW_SEED=%ld\n", static_cast<long>(seed_now));
  if (write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) _exit(2);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::uint64_t setting(const char* name, std::uint64_t usual) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::strtoull(value, nullptr, 10) : usual;
}

TEST(LawsOfSetAlgebra, hold_for_random_solids) {
  const std::uint64_t first = setting("ALGEBRA3D_LAW_SEED", 1), rounds = setting("ALGEBRA3D_LAW_ROUNDS", 40);
  std::size_t checks = 0;
  const auto previous = std::signal(SIGABRT, say_seed);
  for (std::uint64_t seed = first; seed < first + rounds; ++seed) {
    seed_now = static_cast<std::sig_atomic_t>(seed);
    LawTrial trial(seed);
    trial.run();
    checks += trial.check_count();
    // Go on: the next seed may fail in a smaller case.
    EXPECT_EQ(trial.findings(), "") << "ALGEBRA3D_LAW_SEED=" << seed;
  }
  std::signal(SIGABRT, previous);
  RecordProperty("checks", std::to_string(checks));
  EXPECT_EQ(checks, 43 * rounds);
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
