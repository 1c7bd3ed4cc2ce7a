#include "algebra3d/kernel/repair/detail/dangling_sheets.h"

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using samples::MeshMaker;

/// How many triangles go, of those of a maker.
std::size_t dropped(const MeshMaker& maker, std::size_t left) {
  IndexedSoup indexed = indexed_soup(soup_of(maker.mesh()));
  RepairReport report;
  drop_dangling_sheets(indexed, report);
  EXPECT_EQ(indexed.triangles.size(), left);
  const RepairEntry* const entry = report.find(RepairStep::dangling_sheets);
  return entry == nullptr ? 0 : entry->count;
}

MeshMaker cube() {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1});
  return maker;
}

TEST(DanglingSheets, a_triangle_on_an_edge_of_a_closed_surface_is_dropped) {
  EXPECT_EQ(dropped(cube().triangle({0, 0, 0}, {1, 0, 0}, {0, -1, -1}), 12), 1U);
}

TEST(DanglingSheets, of_several_triangles_go_as_a_whole) {
  EXPECT_EQ(dropped(cube().quad({0, 0, 0}, {1, 0, 0}, {1, -1, -1}, {0, -1, -1}), 12), 2U);
}

TEST(DanglingSheets, what_hung_on_a_dangling_sheet_alone_is_left_as_a_sheet) {
  // Of three walls at the far edge of the first one, that and the one that runs the same way can go; the other one
  // hangs on nothing then.
  EXPECT_EQ(dropped(cube()
                        .quad({0, 0, 0}, {1, 0, 0}, {1, -1, -1}, {0, -1, -1})
                        .quad({0, -1, -1}, {1, -1, -1}, {1, -2, -1}, {0, -2, -1})
                        .quad({1, -1, -1}, {0, -1, -1}, {0, -1, -2}, {1, -1, -2}),
                    14),
            4U);
}

TEST(DanglingSheets, triangles_round_a_hole_are_none) {
  MeshMaker open;
  open.box({0, 0, 0}, {1, 1, 1});
  open.drop();
  EXPECT_EQ(dropped(open, 11), 0U);
}

TEST(DanglingSheets, walls_that_end_nowhere_in_the_open_are_none) {
  EXPECT_EQ(dropped(MeshMaker().box({0, 0, 0}, {1, 1, 1}).quad({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}), 14), 0U);
}

TEST(DanglingSheets, sheets_that_hang_on_nothing_are_none) {
  EXPECT_EQ(dropped(MeshMaker().quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), 2), 0U);
}

}  // namespace
}  // namespace algebra3d::soups
