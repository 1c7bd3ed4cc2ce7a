// Relations of solids against set operations, also of solids that are results of these and have fractions: interiors
// meet if the intersection is not empty, and a solid is inside another if nothing of it is left without that one.
#include <gtest/gtest.h>

#include "algebra3d/values/spatial_relations/relation.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d {
namespace {

void expect_laws(solids::SetOperations& engine, const TriangleMesh& a, const TriangleMesh& b) {
  const Volume3d first = Volume3d::trusted(a), second = Volume3d::trusted(b);
  const auto relation = relation_of(first, second);
  ASSERT_TRUE(relation.ok());
  const Volume3d common = Volume3d::trusted(engine.intersect(a, b));
  const Volume3d rest = Volume3d::trusted(engine.subtract(a, b)), other_rest = Volume3d::trusted(engine.subtract(b, a));
  EXPECT_EQ(relation->do_interiors_meet, !common.mesh().is_empty());
  EXPECT_EQ(relation->is_first_inside, rest.mesh().is_empty());
  EXPECT_EQ(relation->is_second_inside, other_rest.mesh().is_empty());
  // What was cut apart touches along the cut, and the parts are inside the whole.
  if (!rest.mesh().is_empty() && !common.mesh().is_empty()) {
    EXPECT_FALSE(relation_of(rest, common)->do_interiors_meet);
    EXPECT_FALSE(relation_of(rest, second)->do_interiors_meet);
  }
  for (const Volume3d& part : {common, rest}) {
    EXPECT_TRUE(*is_inside(part, first));
    EXPECT_TRUE(*is_inside(part, Volume3d::trusted(engine.unite(a, b))));
  }
  EXPECT_TRUE(*is_inside(common, second));
}

TEST(SpatialRelationLaws, set_operations_agree) {
  for (int seed = 0; seed < rounds(20); ++seed) {
    SCOPED_TRACE(seed);
    solids::SetOperations engine;
    solids::RandomSolids draw(static_cast<std::uint64_t>(seed), engine);
    const TriangleMesh a = draw.operand(), b = draw.operand();
    if (a.is_empty() || b.is_empty()) continue;
    expect_laws(engine, a, b);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace algebra3d
