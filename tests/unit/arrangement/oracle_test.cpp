// Set operations against CGAL's Nef polyhedra over GMP rationals, whose regularised operations are exact and share
// neither code nor method with ours: the same exact volumes for all results, and the same sets of points for those
// that CGAL can take back as polyhedra.
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <string>

#include "support/rounds.h"
#include "unit/arrangement/micro_cases.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

using Kernel = CGAL::Cartesian<CGAL::Gmpq>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

// ---- to CGAL

CGAL::Gmpq number(const Rational& value) {
  return CGAL::Gmpq(value.text());
}

/// Some triangles of a mesh as a polyhedron.
class ShellBuilder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  ShellBuilder(const TriangleMesh& mesh, const std::vector<TriangleMesh::Triangle>& triangles, bool is_turned)
      : mesh_(mesh), triangles_(triangles), is_turned_(is_turned) {}

  void operator()(Polyhedron::HalfedgeDS& target) override {
    std::map<std::uint32_t, std::size_t> numbers;
    for (const auto& triangle : triangles_)
      for (const std::uint32_t corner : triangle) numbers.try_emplace(corner, 0);
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(target);
    builder.begin_surface(numbers.size(), triangles_.size());
    std::size_t next = 0;
    for (auto& [vertex, place] : numbers) {
      const RationalVec3 p = mesh_.point(VertexId(vertex)).rational();
      builder.add_vertex({number(p.x), number(p.y), number(p.z)});
      place = next++;
    }
    for (const auto& [a, b, c] : triangles_) {
      const std::array<std::size_t, 3> face{numbers[a], numbers[is_turned_ ? c : b], numbers[is_turned_ ? b : c]};
      builder.add_facet(face.begin(), face.end());
    }
    builder.end_surface();
  }

 private:
  const TriangleMesh& mesh_;
  const std::vector<TriangleMesh::Triangle>& triangles_;
  bool is_turned_;
};

/// The triangles of each connected part, where the mesh is manifold.
std::vector<std::vector<TriangleMesh::Triangle>> shells_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertex_count());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b, c] : triangles_of(mesh)) root[find(a)] = root[find(b)] = find(c);
  std::map<std::uint32_t, std::vector<TriangleMesh::Triangle>> shells;
  for (const auto& triangle : triangles_of(mesh)) shells[find(triangle[0])].push_back(triangle);
  std::vector<std::vector<TriangleMesh::Triangle>> result;
  for (auto& [vertex, shell] : shells) result.push_back(std::move(shell));
  return result;
}

bool is_manifold(const TriangleMesh& mesh) {
  return mesh.nonmanifold_edge_count() == 0 && mesh.nonmanifold_vertices().empty();
}

/// What is within an odd number of shells of a manifold mesh.
Nef nef_of(const TriangleMesh& mesh) {
  Nef result(Nef::EMPTY);
  for (const auto& shell : shells_of(mesh)) {
    Polyhedron polyhedron;
    ShellBuilder builder(mesh, shell, exact_volume(mesh.points(), shell).value().sign() < 0);
    polyhedron.delegate(builder);
    result = result.symmetric_difference(Nef(polyhedron));
  }
  return result.regularization();
}

// ---- from CGAL

/// Twice the vector area of the polygon that a cycle bounds.
Kernel::Vector_3 doubled_area(Nef::SHalfedge_around_facet_const_circulator at) {
  const auto begin = at;
  Kernel::Vector_3 sum(0, 0, 0);
  CGAL_For_all(at, begin) {
    const auto p = at->source()->source()->point() - CGAL::ORIGIN;
    const auto q = at->twin()->source()->twin()->source()->point() - CGAL::ORIGIN;
    sum = sum + CGAL::cross_product(p, q);
  }
  return sum;
}

/// Six times the exact volume: by the divergence theorem over the facets that face the inside.
CGAL::Gmpq sixfold_volume(const Nef& nef) {
  CGAL::Gmpq sum = 0;
  for (auto facet = nef.halffacets_begin(); facet != nef.halffacets_end(); ++facet) {
    if (!facet->incident_volume()->mark() || facet->twin()->incident_volume()->mark()) continue;
    Kernel::Vector_3 area(0, 0, 0);
    for (auto cycle = facet->facet_cycles_begin(); cycle != facet->facet_cycles_end(); ++cycle)
      if (cycle.is_shalfedge()) area = area + doubled_area(Nef::SHalfedge_const_handle(cycle));
    sum += (facet->plane().point() - CGAL::ORIGIN) * area;
  }
  return CGAL::abs(sum);
}

void expect_same(const TriangleMesh& ours, const Nef& oracle, int& compared_sets, const char* what) {
  EXPECT_EQ(number(exact_volume_of(ours)) * 6, sixfold_volume(oracle)) << what;
  if (!is_manifold(ours)) return;
  EXPECT_TRUE(nef_of(ours) == oracle) << what;
  ++compared_sets;
}

/// All four operations; adds the number of results whose sets of points were compared.
void compare_operations(const TriangleMesh& a, const TriangleMesh& b, int& compared_sets) {
  SetOperations engine;
  const Nef nef_a = nef_of(a), nef_b = nef_of(b);
  EXPECT_EQ(number(exact_volume_of(a)) * 6, sixfold_volume(nef_a));
  expect_same(engine.unite(a, b), nef_a.join(nef_b).regularization(), compared_sets, "A + B");
  expect_same(engine.intersect(a, b), nef_a.intersection(nef_b).regularization(), compared_sets, "A * B");
  expect_same(engine.subtract(a, b), nef_a.difference(nef_b).regularization(), compared_sets, "A - B");
  expect_same(engine.subtract(b, a), nef_b.difference(nef_a).regularization(), compared_sets, "B - A");
  EXPECT_EQ(engine.complaints(), "");
}

class NefOracle : public testing::TestWithParam<MicroCase> {};
INSTANTIATE_TEST_SUITE_P(set_operations, NefOracle, testing::ValuesIn(micro_cases()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(NefOracle, agrees_on_the_micro_cases) {
  const MicroCase& micro = GetParam();
  if (!is_manifold(micro.a) || !is_manifold(micro.b)) return;
  int compared_sets = 0;
  compare_operations(micro.a, micro.b, compared_sets);
  EXPECT_GE(compared_sets, 3);
}

class NefOracleFamilies : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(set_operations, NefOracleFamilies,
                         testing::Values(Family::grid_boxes, Family::grid_tetrahedra, Family::common_corners,
                                         Family::rotated_cubes, Family::extrusions),
                         [](const auto& each) { return std::to_string(static_cast<int>(each.param)); });

// Each pair is the first two solids of a seed of that family; the frame of the seed takes part.
TEST_P(NefOracleFamilies, agree_on_random_pairs) {
  const int pairs = rounds(2);
  int pair_count = 0, compared_sets = 0;
  for (std::uint64_t seed = 1; pair_count < pairs; ++seed) {
    SetOperations engine;
    RandomSolids random(seed, engine);
    if (random.family() != GetParam()) continue;
    ++pair_count;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleMesh a = random.plain(), b = random.plain();
    compare_operations(a, b, compared_sets);
  }
  EXPECT_GE(compared_sets, pairs);
}

}  // namespace
}  // namespace algebra3d::solids
