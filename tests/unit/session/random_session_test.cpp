// Random commands, run by a session and by a model that keeps relations in plain vectors: every answer is compared.
// ALGEBRA3D_RANDOM_SECONDS says how long (default: 5), ALGEBRA3D_RANDOM_SEED where it begins (default: 1).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "unit/session/random_changes.h"
#include "unit/session/random_queries.h"

namespace queries {
namespace {

/// Every step as often as its weight says.
std::vector<void (*)(RandomDriver&)> steps() {
  std::vector<void (*)(RandomDriver&)> all;
  const auto add = [&](const RandomStep& step) {
    all.insert(all.end(), static_cast<std::size_t>(step.weight), step.run);
  };
  std::ranges::for_each(random_changes::kSteps, add);
  std::ranges::for_each(random_queries::kSteps, add);
  return all;
}

int setting(const char* name, int usual) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::atoi(value) : usual;
}

TEST(RandomSession, gives_the_answers_of_the_model) {
  constexpr int kSteps = 150;
  const auto all = steps();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(setting("ALGEBRA3D_RANDOM_SECONDS", 5));
  auto seed = static_cast<unsigned>(setting("ALGEBRA3D_RANDOM_SEED", 1));
  int count = 0;
  do {
    SCOPED_TRACE(fmt::format("ALGEBRA3D_RANDOM_SEED={}", seed));
    RandomDriver driver(seed++);
    for (int step = 0; step < kSteps && !driver.has_failed(); ++step, ++count)
      all[static_cast<std::size_t>(driver.below(static_cast<int>(all.size())))](driver);
    ASSERT_FALSE(driver.has_failed());
  } while (std::chrono::steady_clock::now() < end);
  RecordProperty("steps", count);
}

}  // namespace
}  // namespace queries
