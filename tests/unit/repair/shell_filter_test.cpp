#include "algebra3d/kernel/repair/detail/shell_filter.h"

#include <atomic>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

RepairOptions options_with(bool keeps_cavities, double smallest) {
  RepairOptions options;
  options.keeps_cavities = keeps_cavities;
  options.smallest_shell = smallest;
  return options;
}

/// Skins of an onion from outside in, as lengths of cubes about the middle (9 9 9); every other one is a cavity.
TriangleSoup onion(const std::vector<int>& sizes) {
  TriangleSoup soup;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const TriangleSoup skin = shifted(scaled(cube_soup(-0.5, 0.5), sizes[i]), {9, 9, 9});
    soup = joined(std::move(soup), i % 2 == 0 ? skin : turned(skin));
  }
  return soup;
}

TEST(ShellFilter, of_onions_are_what_the_options_leave) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const bool keeps_cavities = chance.one_in(2);
    const int smallest = chance.below(7);
    const RepairOptions options = options_with(keeps_cavities, smallest * smallest * smallest);
    TriangleSoup soup;
    Rational expected(0);
    std::uint64_t cavity_count = 0, small_count = 0;
    for (int n = chance.between(1, 3); n > 0; --n) {
      std::vector<int> sizes;
      for (int size = 8; size > 0; --size)
        if (chance.one_in(2)) sizes.push_back(size);
      if (sizes.empty()) sizes.push_back(4);
      soup = joined(std::move(soup), shifted(onion(sizes), {20.0 * n, 0, 0}));
      // A body that lies in a filled cavity goes with it, whatever its size.
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        const Rational volume(sizes[i] * sizes[i] * sizes[i]);
        const bool is_small = sizes[i] < smallest, is_cavity = i % 2 != 0;
        small_count += is_small ? 1 : 0;
        cavity_count += !is_small && is_cavity && !keeps_cavities ? 1 : 0;
        if (is_small || (!keeps_cavities && i > 0)) continue;
        expected = is_cavity ? expected - volume : expected + volume;
      }
    }
    TriangleMesh mesh = mesh_of(soup);
    ASSERT_TRUE(prove_volume(mesh)->is_valid());
    RepairReport report;
    const auto kept = filter_shells(mesh, options, report);
    ASSERT_TRUE(kept.ok());
    expect_valid_volume(*kept);
    EXPECT_EQ(solids::exact_volume_of(*kept), expected);
    EXPECT_EQ(count_of(report, RepairStep::cavities), cavity_count);
    EXPECT_EQ(count_of(report, RepairStep::small_shells), small_count);
    if (cavity_count + small_count == 0) {
      EXPECT_EQ(soup_of(*kept).triangles, soup_of(mesh).triangles);
    }
  }
}

TEST(ShellFilter, of_exactly_the_least_volume_stays) {
  const TriangleMesh mesh = solids::cube(0, 2);
  for (const double smallest : {0.0, 7.0, 8.0, std::nextafter(8.0, 9.0)}) {
    RepairReport report;
    const auto kept = filter_shells(mesh, options_with(true, smallest), report);
    EXPECT_EQ(kept->is_empty(), smallest > 8);
    EXPECT_EQ(count_of(report, RepairStep::small_shells), smallest > 8 ? 1U : 0U);
  }
}

TEST(ShellFilter, of_the_empty_solid_are_none) {
  RepairReport report;
  EXPECT_TRUE(filter_shells({}, options_with(false, 1), report)->is_empty());
  EXPECT_TRUE(report.is_empty());
}

TEST(ShellFilter, ends_when_asked_to) {
  const std::atomic<bool> cancel = true;
  RepairReport report;
  const auto kept = filter_shells(mesh_of(onion({8, 4})), options_with(false, 0), report, &cancel);
  ASSERT_FALSE(kept.ok());
  EXPECT_EQ(kept.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
