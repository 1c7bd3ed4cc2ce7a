#include "algebra3d/kernel/repair/detail/space_cells.h"

#include <set>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/cell_classification.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

std::set<CellId> cells_of(const TriangleMesh& surface, SpaceCells& cells) {
  std::set<CellId> result{cells.unbounded_cell()};
  for (const FaceId face : faces(surface)) {
    result.insert(cells.cell(FaceSide::front(face)));
    result.insert(cells.cell(FaceSide::back(face)));
  }
  return result;
}

std::size_t cell_count(const TriangleSoup& soup) {
  const TriangleMesh surface = mesh_of(soup);
  SpaceCells cells(surface);
  EXPECT_TRUE(cells.find({}).ok());
  return cells_of(surface, cells).size();
}

/// Two cubes side by side, with one wall between them.
TriangleSoup two_rooms() {
  TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0}));
  std::vector<SoupTriangle> kept;
  std::size_t walls = 0;
  for (const SoupTriangle& t : soup.triangles) {
    const bool is_between = t[0].x == 2 && t[1].x == 2 && t[2].x == 2;
    if (!is_between || ++walls <= 2) kept.push_back(t);
  }
  soup.triangles = kept;
  return soup;
}

TEST(FaceSide, is_numbered_with_its_face) {
  EXPECT_EQ(FaceSide::front(FaceId(3)).index(), 6U);
  EXPECT_EQ(FaceSide::back(FaceId(3)).index(), 7U);
  EXPECT_EQ(FaceSide::of(FaceId(3), true).index(), 6U);
}

TEST(SpaceCells, of_a_cube_are_its_inside_and_the_unbounded_one) {
  const TriangleMesh cube = solids::cube(0, 2);
  SpaceCells cells(cube);
  ASSERT_TRUE(cells.find({}).ok());
  for (const FaceId face : faces(cube)) {
    EXPECT_EQ(cells.cell(FaceSide::front(face)), cells.unbounded_cell());
    EXPECT_NE(cells.cell(FaceSide::back(face)), cells.unbounded_cell());
  }
  EXPECT_EQ(cells_of(cube, cells).size(), 2U);
}

TEST(SpaceCells, are_joined_across_components) {
  EXPECT_EQ(cell_count(joined(cube_soup(0, 4), cube_soup(1, 3))), 3U);
  EXPECT_EQ(cell_count(joined(cube_soup(0, 4), turned(cube_soup(1, 3)))), 3U);
  EXPECT_EQ(cell_count(joined(cube_soup(0, 1), cube_soup(2, 3))), 3U);
  EXPECT_EQ(cell_count(joined(joined(cube_soup(0, 6), cube_soup(1, 5)), cube_soup(2, 4))), 4U);
}

TEST(SpaceCells, are_separated_by_interfaces) {
  EXPECT_EQ(cell_count(two_rooms()), 3U);
}

TEST(SpaceCells, go_around_open_patches) {
  EXPECT_EQ(cell_count(wall_of_squares()), 1U);
  TriangleSoup open = cube_soup(0, 1);
  open.triangles.pop_back();
  EXPECT_EQ(cell_count(open), 1U);
  EXPECT_EQ(cell_count({}), 1U);
}

/// What the classification says of the bounded cells.
std::map<CellId, bool> classified(const TriangleSoup& soup, const TriangleMesh& surface, SpaceCells& cells) {
  const IndexedSoup indexed = indexed_soup(soup);
  const auto result = classify_cells(surface, cells, GeneralizedWindingNumbers(indexed), {}, 1e9);
  EXPECT_TRUE(result.ok());
  return *result;
}

TEST(CellClassification, finds_the_inside_by_winding_numbers) {
  struct Example {
    TriangleSoup soup;
    std::size_t inside_count, outside_count;  // of bounded cells
  };
  for (const Example& example : {Example{cube_soup(0, 2), 1, 0}, Example{turned(cube_soup(0, 2)), 0, 1},
                                 Example{joined(cube_soup(0, 4), cube_soup(1, 3)), 2, 0},
                                 Example{joined(cube_soup(0, 4), turned(cube_soup(1, 3))), 1, 1},
                                 Example{two_rooms(), 2, 0}, Example{wall_of_squares(), 0, 0}}) {
    const TriangleMesh surface = mesh_of(example.soup);
    SpaceCells cells(surface);
    ASSERT_TRUE(cells.find({}).ok());
    std::size_t inside_count = 0, outside_count = 0;
    for (const auto& [cell, is_inside] : classified(example.soup, surface, cells))
      ++(is_inside ? inside_count : outside_count);
    EXPECT_EQ(inside_count, example.inside_count);
    EXPECT_EQ(outside_count, example.outside_count);
  }
}

TEST(CellClassification, ends_at_the_limit) {
  const TriangleSoup soup = cube_soup(0, 2);
  const TriangleMesh surface = mesh_of(soup);
  SpaceCells cells(surface);
  ASSERT_TRUE(cells.find({}).ok());
  const IndexedSoup indexed = indexed_soup(soup);
  const GeneralizedWindingNumbers numbers(indexed);
  // Twelve faces, each seen from twelve points.
  EXPECT_TRUE(classify_cells(surface, cells, numbers, {}, 144).ok());
  const auto refused = classify_cells(surface, cells, numbers, {}, 143);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::limit_exceeded);
}

}  // namespace
}  // namespace algebra3d::soups
