#include <atomic>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {
namespace {

bool in_any(const WindingVector& windings) {
  return windings[0] > 0;
}

/// The stage that runs to its end once it has begun.
constexpr const char* kLastStage = "building the result";

/// Runs with a monitor that hears everything, and is asked to stop when it hears the n-th report.
class Listener {
 public:
  explicit Listener(std::size_t stop_at = SIZE_MAX)
      : report_([this, stop_at](const std::string& how_far) {
          heard_.push_back(how_far);
          if (heard_.size() == stop_at) cancel_ = true;
        }) {}

  Monitor monitor() const { return {&cancel_, &report_}; }
  const std::vector<std::string>& heard() const { return heard_; }

 private:
  std::atomic<bool> cancel_ = false;
  std::vector<std::string> heard_;
  Monitor::Report report_;
};

TEST(Monitor, hears_every_stage_and_growing_percents) {
  const TriangleMesh a = geodesic_sphere(12), b = rotated(a, {1, 2, 3}, 0.4);
  const std::vector<Operand> operands{{&a, 0}, {&b, 0}};
  const Listener run;
  ASSERT_TRUE(combine_solids(operands, in_any, run.monitor()).ok());
  std::vector<std::string> stages;
  int percent = 0;
  for (const std::string& text : run.heard()) {
    const std::size_t comma = text.find(',');
    if (stages.empty() || stages.back() != text.substr(0, comma)) {
      stages.push_back(text.substr(0, comma));
      percent = 0;
    }
    if (comma == std::string::npos) continue;
    const int now = std::stoi(text.substr(comma + 1));
    EXPECT_GT(now, percent) << text;
    EXPECT_LE(now, 100) << text;
    percent = now;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"finding near triangles", "finding contacts", "finding crossings",
                                              "separating inside from outside", kLastStage}));
  EXPECT_GT(run.heard().size(), stages.size());
}

TEST(Monitor, stops_solids_in_every_stage_but_the_last) {
  const TriangleMesh a = geodesic_sphere(12), b = rotated(a, {1, 2, 3}, 0.4);
  const std::vector<Operand> operands{{&a, 0}, {&b, 0}};
  const Listener whole;
  ASSERT_TRUE(combine_solids(operands, in_any, whole.monitor()).ok());
  for (std::size_t n = 1; n < whole.heard().size(); n += n < 3 ? 1 : 7) {
    const Listener run(n);
    const auto result = combine_solids(operands, in_any, run.monitor());
    // How often a stage reports depends on the threads: a run may reach its last stage, or end, before its n-th report.
    if (run.heard().size() < n || run.heard().back() == kLastStage) continue;
    ASSERT_FALSE(result.ok()) << run.heard().back();
    EXPECT_EQ(result.error().code, ErrorCode::interrupted);
  }
}

TEST(Monitor, stops_surfaces) {
  const TriangleMesh a = geodesic_sphere(20), b = rotated(a, {1, 2, 3}, 0.4);
  for (std::size_t n = 1; n <= 3; ++n) {
    const Listener run(n);
    const auto result = combine_surfaces({&a, 0}, {&b, 0}, SurfaceRule::either, run.monitor());
    ASSERT_FALSE(result.ok()) << n;
    EXPECT_EQ(result.error().code, ErrorCode::interrupted);
  }
}

}  // namespace
}  // namespace algebra3d::solids
