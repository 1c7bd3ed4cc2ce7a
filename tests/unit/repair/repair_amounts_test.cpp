// Amounts of repairs, compared with what is known of boxes and sheets by formulas.
#include "algebra3d/kernel/repair/detail/repair_amounts.h"

#include <cmath>

#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

RepairAmounts amounts_of(const TriangleSoup& soup) {
  const SolidFromSoup made = repaired(soup, with(&RepairOptions::most_dropped, 1));
  if (!made.repair || !made.repair->amounts) return {};
  return *made.repair->amounts;
}

TEST(RepairAmounts, of_a_sheet_that_stands_on_a_box) {
  // [0,1]^3, and {0.5}x[0,1]x[1,11] in any number of copies that look either way.
  TriangleSoup sheet;
  sheet.triangles = {{Vec3{0.5, 0, 1}, Vec3{0.5, 1, 1}, Vec3{0.5, 1, 11}},
                     {Vec3{0.5, 0, 1}, Vec3{0.5, 1, 11}, Vec3{0.5, 0, 11}}};
  TriangleSoup otherwise;
  otherwise.triangles = {{Vec3{0.5, 0, 1}, Vec3{0.5, 0, 11}, Vec3{0.5, 1, 1}},
                         {Vec3{0.5, 1, 1}, Vec3{0.5, 0, 11}, Vec3{0.5, 1, 11}}};
  const TriangleSoup box = cube_soup(0, 1);
  for (const TriangleSoup& sheets : {sheet, joined(sheet, turned(sheet)), joined(sheet, otherwise)}) {
    const RepairAmounts amounts = amounts_of(joined(box, sheets));
    EXPECT_NEAR(value_of(amounts.area_seen), 16, 1e-9);
    EXPECT_NEAR(value_of(amounts.left_out.area), 10, 1e-9);
    EXPECT_EQ(amounts.left_out.triangle_count, sheets.triangles.size());
    EXPECT_GE(amounts.left_out.distance, 10 * (1 - 1e-12));
    EXPECT_LE(amounts.left_out.distance, 10 * 1.011);
    EXPECT_EQ(value_of(amounts.inside.area), 0);
    EXPECT_EQ(value_of(amounts.added.area), 0);
  }
}

TEST(RepairAmounts, do_not_depend_on_the_unit) {
  for (const double unit : {1e-300, 1e-200, 1e-150, 1e-30, 1.0, 1e30, 1e150, 1e200, 1e300}) {
    SCOPED_TRACE(unit);
    const TriangleSoup soup =
        joined(box_soup({0, 0, 0}, {unit, unit, unit}), wall_at(unit / 2, -unit, -unit, 2 * unit, 2 * unit));
    const RepairAmounts amounts = amounts_of(soup);
    EXPECT_NEAR(amounts.left_out_part(), 8.0 / 15, 1e-9);
    EXPECT_NEAR(amounts.left_out.distance / unit, std::sqrt(2), 0.016);
  }
}

TEST(RepairAmounts, beyond_the_range_of_doubles_are_no_numbers) {
  for (const double unit : {1e-200, 1e200}) {
    SCOPED_TRACE(unit);
    const SolidFromSoup made =
        repaired(joined(box_soup({0, 0, 0}, {unit, unit, unit}), wall_at(unit / 2, -unit, -unit, 2 * unit, 2 * unit)));
    EXPECT_EQ(made.area_seen->in_doubles(), std::nullopt);
    EXPECT_EQ(made.volume->in_doubles(), std::nullopt);
    EXPECT_NE(made.status().find("area beyond the range of doubles (53.3 %), up to 1.4"), std::string::npos)
        << made.status();
  }
  const SolidFromSoup box = repaired(box_soup({0, 0, 0}, {1e-150, 1e-150, 1e-150}));
  EXPECT_NEAR(value_of(*box.area_seen) / 6e-300, 1, 1e-12);
  EXPECT_EQ(box.volume->in_doubles(), std::nullopt);
}

TEST(RepairAmounts, the_limit_acts_at_every_scale) {
  for (const double unit : {1e-300, 1e-200, 1e-80, 1.0, 1e80, 1e200, 1e300}) {
    SCOPED_TRACE(unit);
    const auto made = solid_from_soup(
        joined(box_soup({0, 0, 0}, {unit, unit, unit}), wall_at(2 * unit, 0, 0, 100 * unit, 100 * unit)));
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->reason.find("the solid would leave out 99.94 % of the area seen, up to 1"), 0U) << made->reason;
  }
}

TEST(RepairAmounts, of_boxes_that_overlap_count_what_is_inside) {
  // [0,2]^3 and [1,3]^3: three unit squares of each are within the other.
  const RepairAmounts amounts = amounts_of(joined(cube_soup(0, 2), cube_soup(1, 3)));
  EXPECT_NEAR(value_of(amounts.area_seen), 48, 1e-9);
  EXPECT_NEAR(value_of(amounts.inside.area), 6, 1e-9);
  EXPECT_EQ(amounts.left_out.triangle_count, 0U);
  EXPECT_EQ(amounts.added.triangle_count, 0U);
}

TEST(RepairAmounts, of_a_lid_that_was_added) {
  TriangleSoup open = cube_soup(0, 2);
  std::erase_if(open.triangles, [](const SoupTriangle& t) { return t[0].z == 2 && t[1].z == 2 && t[2].z == 2; });
  const RepairAmounts amounts = amounts_of(open);
  EXPECT_NEAR(value_of(amounts.area_seen), 20, 1e-9);
  EXPECT_NEAR(value_of(amounts.added.area), 4, 1e-9);
  // The middle of the lid is 1 from its rim.
  EXPECT_GE(amounts.added.distance, 1);
  EXPECT_LE(amounts.added.distance, 1.011);
}

TEST(RepairAmounts, where_more_is_gone_than_may_be_there_is_no_solid) {
  const TriangleSoup soup = joined(cube_soup(0, 1), wall_at(0.5, -1, -1, 2, 2));  // 8 of 15
  EXPECT_TRUE(solid_from_soup(soup, with(&RepairOptions::most_dropped, 0.534))->mesh);
  const auto none = solid_from_soup(soup, with(&RepairOptions::most_dropped, 0.533));
  ASSERT_TRUE(none.ok());
  EXPECT_FALSE(none->mesh);
  EXPECT_EQ(none->reason.find("the solid would leave out 53.33 % of the area seen, up to "), 0U) << none->reason;
  EXPECT_NE(none->reason.find("; at most 53.3 % may be"), std::string::npos) << none->reason;
}

TEST(RepairAmounts, where_more_is_added_than_may_be_there_is_no_solid) {
  TriangleSoup open = cube_soup(0, 2);
  std::erase_if(open.triangles, [](const SoupTriangle& t) { return t[0].z == 2 && t[1].z == 2 && t[2].z == 2; });
  const SolidFromSoup made = repaired(open, with(&RepairOptions::most_added, 0.21));  // 4 of 20
  EXPECT_EQ(made.status().find("repaired: 20 % of the area seen added; 1 hole closed (near "), 0U) << made.status();
  EXPECT_NE(made.status().find("; added: area 4 (20 %), up to "), std::string::npos) << made.status();
  const auto none = solid_from_soup(open, with(&RepairOptions::most_added, 0.19));
  ASSERT_TRUE(none.ok());
  EXPECT_FALSE(none->mesh);
  EXPECT_EQ(none->reason.find("20 % of the area seen would be added to make a solid, up to 1"), 0U) << none->reason;
  EXPECT_NE(none->reason.find("; at most 19 % may be (option added)"), std::string::npos) << none->reason;
}

}  // namespace
}  // namespace algebra3d::soups
