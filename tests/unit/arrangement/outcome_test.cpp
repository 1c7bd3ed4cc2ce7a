// What `solid` and `faces` do if a selection is none that a classification gives: an error, no broken mesh.
#include "algebra3d/arrangement/outcome.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "algebra3d/arrangement/candidates.h"
#include "algebra3d/arrangement/facet_contacts.h"
#include "algebra3d/arrangement/overlay.h"
#include "unit/arrangement/solids.h"

namespace algebra3d::arrangement {
namespace {

TEST(Outcome, faces_that_are_not_bounded_all_round_are_an_error) {
  const TriangleMesh a = solids::cube(0, 4), b = solids::cube(2, 6);
  const std::array<Operand, 2> list{{{&a, 0}, {&b, 1}}};
  const Operands operands(list);
  Facets facets(operands);
  Skeleton skeleton(operands, facets);
  const auto pairs = candidate_pairs(operands, {}, SIZE_MAX);
  ASSERT_TRUE(pairs.ok() && find_contacts(*pairs, facets, skeleton, {}).ok());
  ASSERT_TRUE(cut_segments(skeleton, {}, SIZE_MAX).ok());
  const Pieces pieces = divide(skeleton);
  const Patches patches = find_patches(operands, facets);
  const auto outcome_of = [&](const std::function<int(std::uint32_t)>& cell) {
    return build_outcome(skeleton, pieces, patches, {cell, [](std::uint32_t) { return 0; }});
  };
  EXPECT_TRUE(outcome_of([](std::uint32_t) { return 0; })->is_empty());
  std::uint32_t covered = 0;
  while (!pieces.is_covered(covered)) ++covered;
  const auto outcome = outcome_of([&](std::uint32_t side) { return side == covered ? 1 : 0; });
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::internal);
  EXPECT_NE(outcome.error().message.find("do not bound a face all round"), std::string::npos);
  EXPECT_NE(outcome.error().message.find("near ("), std::string::npos) << outcome.error().message;
}

}  // namespace
}  // namespace algebra3d::arrangement
