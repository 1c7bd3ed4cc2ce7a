#include "algebra3d/kernel/validity/report.h"

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

TEST(validity_report, without_defects_is_valid_and_says_nothing) {
  const ValidityReport report;
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.text(), "");
}

TEST(validity_report, names_kinds_counts_and_first_places_in_one_line) {
  ValidityReport report;
  report.add({Defect::intersecting_triangles, FaceId(4), FaceId(17), {0.5, 0, 0}});
  report.add({Defect::boundary_edge, FaceId(30), FaceId(), {9, 9, 9}});
  report.add({Defect::boundary_edge, FaceId(12), FaceId(), {1, 2, 3}});
  EXPECT_EQ(report.text(),
            "2 boundary edges (first at triangle 12, near (1.0 2.0 3.0)); "
            "1 intersecting pair (first triangles 4 and 17, near (0.5 0.0 0.0))");
}

TEST(validity_report, says_when_counting_ended_early) {
  ValidityReport report;
  report.add({Defect::intersecting_triangles, FaceId(4), FaceId(17), {0.5, 0, 0}});
  report.is_cut_short = true;
  EXPECT_EQ(report.text(), "at least 1 intersecting pair (first triangles 4 and 17, near (0.5 0.0 0.0))");
}

TEST(validity_report, keeps_the_first_examples_of_each_kind_whatever_the_order) {
  const std::array<std::array<std::uint32_t, 6>, 3> orders{
      {{0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}, {3, 0, 5, 1, 4, 2}}};
  for (const auto& order : orders) {
    ValidityReport report;
    for (const std::uint32_t face : order) {
      report.add({Defect::wrong_winding, FaceId(face), FaceId(), {}});
      report.add({Defect::degenerate_triangle, FaceId(face), FaceId(), {}});
    }
    ASSERT_EQ(report.examples.size(), 2 * ValidityReport::kExamplesPerKind);
    for (std::uint32_t i = 0; i < 6; ++i) {
      EXPECT_EQ(report.examples[i].first, FaceId(i % 3));
      EXPECT_EQ(report.examples[i].kind, i < 3 ? Defect::degenerate_triangle : Defect::wrong_winding);
    }
    EXPECT_EQ(report.count(Defect::wrong_winding), 6U);
    EXPECT_EQ(report.total(), 12U);
  }
}

}  // namespace
}  // namespace algebra3d
