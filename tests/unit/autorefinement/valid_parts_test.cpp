#include "algebra3d/kernel/autorefinement/valid_parts.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

std::pair<Vec3, Vec3> ends_of(const TriangleMesh& mesh, HalfedgeId h) {
  return std::minmax({mesh.point(mesh.origin(h)).approx, mesh.point(mesh.target(h)).approx});
}

TriangleSoup soup_of_parts(const ValidParts& parts) {
  TriangleSoup soup;
  for (const Operand& operand : parts.operands()) soup = joined(std::move(soup), soup_of(*operand.mesh));
  return soup;
}

bool has_area(const SoupTriangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]) != Vec3{};
}

/// The edges of the parts, each as two points, and how many parts have it.
std::map<std::pair<Vec3, Vec3>, int> counts_of_edges(const ValidParts& parts) {
  std::map<std::pair<Vec3, Vec3>, int> counts;
  for (const Operand& part : parts.operands())
    for (const HalfedgeId h : edges(*part.mesh)) ++counts[ends_of(*part.mesh, h)];
  return counts;
}

/// Faces of a part alternate around its non-manifold edges, unless another part touches it there.
void expect_simple_edges(const ValidParts& parts) {
  const auto counts = counts_of_edges(parts);
  for (const Operand& part : parts.operands())
    for (std::size_t n = 0; n < part.mesh->nonmanifold_edge_count(); ++n) {
      const auto edge = part.mesh->nonmanifold_edge(n);
      if (counts.at(ends_of(*part.mesh, edge.front())) > 1) continue;
      EXPECT_TRUE(is_balanced(*part.mesh, edge));
      EXPECT_EQ(order_around(*part.mesh, edge), EdgeOrder::alternating);
    }
}

/// Parts of the mesh of a soup are valid, and together all of its faces with an area.
void expect_right(const ValidParts& parts, const TriangleSoup& soup) {
  TriangleSoup expected = soup;
  std::erase_if(expected.triangles, [](const SoupTriangle& t) { return !has_area(t); });
  EXPECT_EQ(in_order(soup_of_parts(parts)), in_order(expected));
  std::size_t single_count = 0;
  for (const Operand& part : parts.operands()) {
    EXPECT_EQ(prove_surface(*part.mesh)->text(), "");
    single_count += part.mesh->face_count() == 1 ? 1 : 0;
  }
  EXPECT_LE(parts.lone_faces().size(), single_count);
  EXPECT_TRUE(std::ranges::is_sorted(parts.lone_faces()));
  for (const FaceId face : parts.lone_faces()) EXPECT_TRUE(has_area(soup.triangles[face.index()]));
}

TEST(ValidParts, are_valid_and_together_all_faces_with_an_area) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = seed % 2 == 0 ? soup_of(solids::box({0, 0, 0}, {4, 2, 3})) : TriangleSoup();
    for (int n = chance.between(1, 40); n > 0; --n)
      soup.triangles.push_back({chance.grid_point(4), chance.grid_point(4), chance.grid_point(4)});
    const TriangleMesh mesh = mesh_of(soup);
    const auto parts = ValidParts::make(mesh), in_sheets = ValidParts::in_sheets(mesh);
    ASSERT_TRUE(parts.ok() && in_sheets.ok());
    expect_right(*parts, soup);
    for (const Operand& part : parts->operands()) EXPECT_EQ(part.mesh->nonmanifold_edge_count(), 0U);
    EXPECT_GE(parts->lone_faces().size() + 1, parts->operands().size());
    expect_right(*in_sheets, soup);
    expect_simple_edges(*in_sheets);
  }
}

// Two boxes with an edge in common, around which four faces alternate.
TEST(ValidParts, in_sheets_keep_edges_of_solids) {
  const TriangleSoup two =
      joined(soup_of(solids::box({0, 0, 0}, {1, 1, 1})), soup_of(solids::box({1, 1, 0}, {2, 2, 1})));
  const TriangleMesh mesh = mesh_of(two);
  ASSERT_EQ(mesh.nonmanifold_edge_count(), 1U);
  EXPECT_EQ(ValidParts::make(mesh)->lone_faces().size(), 4U);
  const auto parts = ValidParts::in_sheets(mesh);
  expect_right(*parts, two);
  EXPECT_TRUE(parts->lone_faces().empty());
  EXPECT_EQ(parts->operands().size(), 1U);
}

/// A surface of faces with an edge in common, to tips that run along it in one direction or the other.
TriangleSoup fan(const std::vector<std::pair<Vec3, bool>>& tips) {
  TriangleSoup soup;
  for (const auto& [tip, is_turned] : tips) {
    const SoupTriangle face{Vec3{0, 0, 0}, Vec3{0, 0, 1}, tip};
    soup.triangles.push_back(is_turned ? turned(face) : face);
  }
  return soup;
}

// Around the edge two faces run up and then two down, so winding numbers differ around it.
TEST(ValidParts, in_sheets_part_faces_at_other_edges) {
  const TriangleSoup mixed =
      fan({{Vec3{1, 0, 0}, false}, {Vec3{0, 1, 0}, false}, {Vec3{-1, 0, 0}, true}, {Vec3{0, -1, 0}, true}});
  const auto parts = ValidParts::in_sheets(mesh_of(mixed));
  expect_right(*parts, mixed);
  EXPECT_EQ(parts->operands().size(), 2U);
  const TriangleSoup alternating =
      fan({{Vec3{1, 0, 0}, false}, {Vec3{0, 1, 0}, true}, {Vec3{-1, 0, 0}, false}, {Vec3{0, -1, 0}, true}});
  EXPECT_EQ(ValidParts::in_sheets(mesh_of(alternating))->operands().size(), 1U);
  const TriangleSoup unbalanced = fan({{Vec3{1, 0, 0}, false}, {Vec3{0, 1, 0}, true}, {Vec3{-1, 0, 0}, false}});
  EXPECT_EQ(ValidParts::in_sheets(mesh_of(unbalanced))->operands().size(), 2U);
}

// Two faces that run up along such an edge are connected elsewhere: these two are alone, and nothing else.
TEST(ValidParts, in_sheets_leave_few_faces_alone) {
  const Vec3 origin{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, below{1, 1, -2};
  TriangleSoup soup = fan({{x, false}, {y, false}, {Vec3{-1, 0, 0}, true}, {Vec3{0, -1, 0}, true}});
  for (const SoupTriangle& t : {SoupTriangle{origin, x, below}, {below, x, y}, {below, y, z}})
    soup.triangles.push_back(t);
  const auto parts = ValidParts::in_sheets(mesh_of(soup));
  expect_right(*parts, soup);
  EXPECT_EQ(parts->lone_faces(), (std::vector<FaceId>{FaceId(0), FaceId(1)}));
  EXPECT_EQ(parts->operands().size(), 2U + 2U);
}

// Ten copies of a box, of which eight are a sheet each, and the faces of the other two are parts of their own.
TEST(ValidParts, in_sheets_are_eight_at_most) {
  TriangleSoup copies;
  for (int i = 0; i < 10; ++i) copies = joined(std::move(copies), soup_of(solids::box({0, 0, 0}, {1, 2, 3})));
  const auto parts = ValidParts::in_sheets(mesh_of(copies));
  expect_right(*parts, copies);
  EXPECT_EQ(parts->lone_faces().size(), 24U);
  EXPECT_EQ(parts->operands().size(), 8U + 24U);
}

TEST(ValidParts, in_sheets_end_when_they_are_cancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(ValidParts::in_sheets(samples::torus(12, 8), &cancel).error().code, ErrorCode::interrupted);
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
