#include "algebra3d/autorefinement/valid_parts.h"

#include <atomic>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

TriangleSoup soup_of_parts(const ValidParts& parts) {
  TriangleSoup soup;
  for (const Operand& operand : parts.operands()) soup = joined(std::move(soup), soup_of(*operand.mesh));
  return soup;
}

bool has_area(const SoupTriangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]) != Vec3{};
}

TEST(ValidParts, are_valid_and_together_all_faces_with_an_area) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = seed % 2 == 0 ? soup_of(solids::box({0, 0, 0}, {4, 2, 3})) : TriangleSoup();
    for (int n = chance.between(1, 40); n > 0; --n)
      soup.triangles.push_back({chance.grid_point(4), chance.grid_point(4), chance.grid_point(4)});
    const TriangleMesh mesh = mesh_of(soup);
    const auto parts = ValidParts::make(mesh);
    ASSERT_TRUE(parts.ok());
    TriangleSoup expected = soup;
    std::erase_if(expected.triangles, [](const SoupTriangle& t) { return !has_area(t); });
    EXPECT_EQ(in_order(soup_of_parts(*parts)), in_order(expected));
    std::size_t single_count = 0;
    for (const Operand& part : parts->operands()) {
      EXPECT_EQ(prove_surface(*part.mesh)->text(), "");
      EXPECT_EQ(part.mesh->nonmanifold_edge_count(), 0U);
      single_count += part.mesh->face_count() == 1 ? 1 : 0;
    }
    EXPECT_LE(parts->lone_faces().size(), single_count);
    EXPECT_GE(parts->lone_faces().size() + 1, parts->operands().size());
    for (const FaceId face : parts->lone_faces()) EXPECT_TRUE(has_area(soup.triangles[face.index()]));
  }
}

TEST(ValidParts, of_what_is_valid_is_one) {
  const TriangleMesh torus = samples::torus(12, 8);
  const auto parts = ValidParts::make(torus);
  ASSERT_EQ(parts->operands().size(), 1U);
  EXPECT_TRUE(parts->lone_faces().empty());
  EXPECT_EQ(soup_of_parts(*parts).triangles, soup_of(torus).triangles);
  EXPECT_TRUE(ValidParts::make({})->operands().empty());
}

TEST(ValidParts, faces_that_are_named_are_parts_by_themselves) {
  const TriangleMesh torus = samples::torus(12, 8);
  std::vector<bool> are_alone(torus.face_count());
  are_alone[3] = are_alone[100] = true;
  const auto parts = ValidParts::make(torus, are_alone);
  EXPECT_EQ(parts->operands().size(), 3U);
  EXPECT_EQ(parts->lone_faces(), (std::vector<FaceId>{FaceId(3), FaceId(100)}));
  EXPECT_EQ(in_order(soup_of_parts(*parts)), in_order(soup_of(torus)));
}

TEST(ValidParts, faces_at_edges_of_many_are_alone) {
  TriangleSoup soup;
  const Vec3 low{0, 0, 0}, high{0, 0, 1};
  for (const Vec3& tip : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, -1, 0}}) soup.triangles.push_back({low, high, tip});
  const auto parts = ValidParts::make(mesh_of(soup));
  EXPECT_EQ(parts->operands().size(), 3U);
}

TEST(ValidParts, stay_valid_when_moved) {
  const TriangleMesh mesh = mesh_of(joined(cube_soup(0, 2), cube_soup(1, 3)));
  auto made = ValidParts::make(mesh);
  const TriangleSoup before = soup_of_parts(*made);
  const ValidParts moved = std::move(made).value();
  EXPECT_EQ(soup_of_parts(moved).triangles, before.triangles);
  EXPECT_GT(moved.operands().size(), 1U);
}

TEST(ValidParts, ends_when_asked_to) {
  const std::atomic<bool> cancel = true;
  const auto parts = ValidParts::make(samples::torus(40, 40), &cancel);
  ASSERT_FALSE(parts.ok());
  EXPECT_EQ(parts.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
