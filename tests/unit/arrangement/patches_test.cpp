// Seventh stage: the faces that touch nothing, by connected parts.
#include "algebra3d/kernel/arrangement/detail/patches.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

/// "A 8 9": the faces of each patch.
Lines text(const Operands& operands, const Patches& patches) {
  Lines lines;
  for (const PatchId patch : patches.ids()) {
    const OperandId operand = patches[patch].operand;
    std::string line(1, stages::name(operand));
    for (const InputFaceId face : operands.faces())
      if (patches.of_face[face] == patch) line += fmt::format(" {}", operands.in_mesh(operand, face).index());
    lines.push_back(line);
  }
  return lines;
}

void expect_patches(const stages::Boxes& boxes, const Lines& expected) {
  const Facets facets = boxes.facets();
  const Patches patches = find_patches(boxes.operands(), facets);
  EXPECT_EQ(text(boxes.operands(), patches), expected);
  EXPECT_EQ(audit(boxes.operands(), facets, patches), Lines());
}

TEST(Patches, of_boxes) {
  expect_patches(stages::CrossingCubes(), {"A 0 1 4 5 8 9", "B 2 3 6 7 10 11"});
  expect_patches(stages::SharedFace(), {"A 8 9", "B 10 11"});
  expect_patches(stages::SharedEdge(), {"A 4 5 8 9", "B 6 7 10 11"});
  expect_patches(stages::SharedVertex(), {"A 0 1 4 5 8 9", "B 2 3 6 7 10 11"});
  expect_patches(stages::CoplanarOverlap(), {"A 0 1 4 5 8 9", "B 2 3 6 7 10 11"});
  expect_patches(stages::Cavity(), {"A 0 1 2 3 4 5 6 7 8 9 10 11", "B 0 1 2 3 4 5 6 7 8 9 10 11"});
}

TEST(Patches, of_opposite_sides_are_two) {
  // A board through A leaves its sides x- and x+, which have no edge in common.
  const stages::Boxes boxes(solids::cube(0, 4), solids::box({1, -1, -1}, {2, 5, 5}));
  expect_patches(boxes, {"A 8 9", "A 10 11", "B 0 1 2 3 4 5 6 7"});
}

TEST(Patches, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const Facets facets = boxes.facets();
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    Patches damaged = find_patches(boxes.operands(), facets);
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(audit(boxes.operands(), facets, damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  const InputFaceId taken(1), in_facet(10);
  expect_seen([&](Patches& p) { p.of_face[taken] = PatchId(); }, "face 1 is in a facet and a patch, or neither");
  expect_seen([&](Patches& p) { p.of_face[in_facet] = PatchId(0); }, "face 10 is in a facet and a patch, or neither");
  expect_seen([&](Patches& p) { p.of_face[taken] = PatchId(1); }, "patch 1 does not begin with its first face 1");
  expect_seen([&](Patches& p) { p.of_face[taken] = PatchId(7); }, "face 1 is in patch 7, which has not begun");
  expect_seen([&](Patches& p) { p.patches[PatchId(1)].operand = OperandId(0); }, "is in a patch of another operand");
  expect_seen([&](Patches& p) { p.patches[PatchId(1)].first_face = InputFaceId(15); },
              "does not begin with its first face");
  expect_seen([&](Patches& p) { p.patches.push_back(p.patches.front()); }, "2 patches have faces, of 3");
}

}  // namespace
}  // namespace algebra3d::arrangement
