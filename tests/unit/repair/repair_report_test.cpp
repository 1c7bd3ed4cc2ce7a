#include "algebra3d/kernel/repair/repair_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

TEST(RepairReport, of_nothing_is_empty) {
  const RepairReport report;
  EXPECT_TRUE(report.is_empty());
  EXPECT_EQ(report.text(), "triangles linked anew where more than two meet; nothing moved, added or left out");
  EXPECT_EQ(report.deviation(), 0);
  EXPECT_EQ(report.find(RepairStep::holes), nullptr);
}

TEST(RepairReport, counts_by_step_with_the_first_place_and_the_largest_distance) {
  RepairReport report;
  report.add(RepairStep::holes, {1, 2, 3}, 0.5);
  report.add(RepairStep::gaps, {4, 5, 6}, 0.25);
  report.add(RepairStep::holes, {7, 8, 9}, 2);
  report.add(RepairStep::holes, {7, 8, 9}, 1);
  report.add(RepairStep::duplicate_triangles, {0, 0, 1});
  const RepairEntry* holes = report.find(RepairStep::holes);
  ASSERT_NE(holes, nullptr);
  EXPECT_EQ(holes->count, 3U);
  EXPECT_EQ(holes->where, (Vec3{1, 2, 3}));
  EXPECT_EQ(holes->largest, 2);
  EXPECT_EQ(report.deviation(), 2);
  EXPECT_EQ(report.find(RepairStep::open_holes), nullptr);
  EXPECT_FALSE(report.is_empty());
  EXPECT_EQ(
      report.text(),
      "1 duplicate triangle dropped (near (0 0 1)), 1 vertex moved across a gap (near (4 5 6)), 3 holes closed (near "
      "(1 2 3)); at most 2 from the triangles");
}

TEST(RepairReport, places_are_short) {
  const Vec3 place = short_place({1.0 / 3, -1e-9, 1234.56789012}, 95);
  EXPECT_EQ(place, (Vec3{0.3333, 0, 1234.5679}));
  EXPECT_FALSE(std::signbit(place.y));
  EXPECT_EQ(short_place({512345.6789, 0.75, 1}, 1e6), (Vec3{512346, 1, 1}));
  EXPECT_EQ(short_place({0.1234567, 2, 3}, 0), (Vec3{0.1234567, 2, 3}));
  EXPECT_EQ(short_place({1.23456789e-7, 0, 0}, 1e-6), (Vec3{1.2346e-7, 0, 0}));
}

TEST(RepairReport, says_what_was_left_out_and_added) {
  RepairReport report;
  report.size = 10;
  report.amounts = RepairAmounts{16, {2, 10, 9, {0, 0, 10}}, {}, {1, 0.25, 0.5, {}}, 0};
  EXPECT_EQ(report.text(),
            "left out: 2 triangles, area 10 (62.5 %), up to 9 from the solid (near (0 0 10)); added: area 0.25 (1.56 "
            "%), up to 0.5 "
            "from the triangles");
  EXPECT_EQ(percent_text(0.99994), "99.994 %");
  EXPECT_EQ(percent_text(0.9999999999), "99.99999999 %");
  EXPECT_EQ(percent_text(1), "100 %");
  using Texts = std::pair<std::string, std::string>;
  EXPECT_EQ(percents_above_limit(0.5, 0.4999), (Texts{"50 %", "49.99 %"}));
  EXPECT_EQ(percents_above_limit(0.50004, 0.5), (Texts{"50.004 %", "50 %"}));
  EXPECT_EQ(percents_above_limit(0.533333, 0.5332), (Texts{"53.33 %", "53.32 %"}));
}

TEST(RepairReport, amounts_beyond_the_range_of_doubles) {
  RepairReport report;
  const double infinite = std::numeric_limits<double>::infinity();
  report.amounts = RepairAmounts{{16, 1100}, {2, {10, 1100}, infinite, {}}, {}, {1, {0.25, -1100}, 0.5, {}}, 0};
  EXPECT_EQ(
      report.text(),
      "left out: 2 triangles, area beyond the range of doubles (62.5 %), up to beyond the range of doubles from the "
      "solid (near (0 0 0)); added: area beyond the range of doubles (0 %), up to 0.5 from the triangles");
  EXPECT_EQ(Amount(0.25, -1070).in_doubles(), 0x1p-1072);
  EXPECT_EQ(Amount(1.5, 1023).in_doubles(), 0x1.8p1023);
  EXPECT_EQ(Amount(0, 5000).in_doubles(), 0.0);
  EXPECT_EQ(Amount(2, 5000).ratio_to({8, 4999}), 0.5);
  EXPECT_EQ(Amount::nearest(Rational(-3)).in_doubles(), -3.0);
  const Rational large(0x1p1000);
  EXPECT_EQ(Amount::nearest(large * large * Rational(3)).ratio_to({1, 2000}), 3);
  EXPECT_EQ(Amount::nearest(Rational(3) / large / large).ratio_to({1, -2000}), 3);
}

TEST(RepairReport, holes_that_the_solid_does_not_have_are_not_told) {
  RepairReport report;
  report.add(HoleCover{{1, 0, 0}, 3, {}});
  report.add(HoleCover{{2, 0, 0}, 1, {}});
  report.drop_missing_covers({false, true});
  ASSERT_NE(report.find(RepairStep::holes), nullptr);
  EXPECT_EQ(report.find(RepairStep::holes)->count, 1U);
  EXPECT_EQ(report.find(RepairStep::holes)->where, (Vec3{2, 0, 0}));
  EXPECT_EQ(report.deviation(), 1);
  report.drop_missing_covers({false});
  EXPECT_TRUE(report.is_empty());
}

TEST(RepairReport, entries_are_in_the_order_of_the_steps_however_they_come) {
  for (std::size_t first = 0; first < kRepairSteps; ++first) {
    RepairReport report;
    for (std::size_t i = 0; i < kRepairSteps; ++i)
      for (std::size_t n = 0; n <= i; ++n) report.add(static_cast<RepairStep>((first + 7 * i) % kRepairSteps), {});
    ASSERT_EQ(report.entries.size(), kRepairSteps);
    for (std::size_t i = 0; i < kRepairSteps; ++i) {
      const auto step = static_cast<RepairStep>((first + 7 * i) % kRepairSteps);
      EXPECT_EQ(report.find(step)->count, i + 1);
      EXPECT_EQ(report.entries[static_cast<std::size_t>(step)].step, step);
    }
  }
}

TEST(RepairReport, names_and_wordings_are_all_different) {
  std::set<std::string> names, texts;
  for (std::size_t i = 0; i < kRepairSteps; ++i) {
    names.emplace(name_of(static_cast<RepairStep>(i)));
    RepairReport report;
    report.add(static_cast<RepairStep>(i), {});
    texts.insert(report.text());
    report.add(static_cast<RepairStep>(i), {});
    texts.insert(report.text());
  }
  EXPECT_EQ(names.size(), kRepairSteps);
  EXPECT_FALSE(names.contains(""));
  EXPECT_EQ(texts.size(), 2 * kRepairSteps);
  EXPECT_EQ(name_of(RepairStep::gaps), "gaps");
}

}  // namespace
}  // namespace algebra3d
