#include "queries/test_runner/detail/variation.h"

#include <gtest/gtest.h>

#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "support/cloud_type.h"
#include "unit/test_runner/nested_text.h"
#include "unit/test_runner/sample_run.h"

namespace queries {
namespace {

using algebra3d::Registry;

TypeExpr type(const std::string& text) {
  return TypeExpr::from_nested(list(text)).value();
}

const Motion kMoved = Motion::translation(test_registry(), {10, 20, 30});
const Motion kTurned = Motion::turned_axes(test_registry());

std::string image(const Motion& motion, const std::string& type_text, const std::string& value) {
  return motion.image(type(type_text), list(value)).print();
}

TEST(Motion, moves_every_spatial_type) {
  EXPECT_EQ(image(kMoved, "point3d", "(1 2 3)"), "(11.0 22.0 33.0)");
  EXPECT_EQ(image(kMoved, "vector3d", "(1 2 3)"), "(1.0 2.0 3.0)");
  EXPECT_EQ(image(kMoved, "points3d", "((1 2 3) (0 0 0))"), "((11.0 22.0 33.0) (10.0 20.0 30.0))");
  EXPECT_EQ(image(kMoved, "rect3", "(0 1 0 1 0 1)"), "(10.0 11.0 20.0 21.0 30.0 31.0)");
  EXPECT_EQ(image(kMoved, "surface3d", "(((0 0 0) (1 0 0) (0 1 0)))"),
            "(((10.0 20.0 30.0) (11.0 20.0 30.0) (10.0 21.0 30.0)))");
  // The plane z = 2: its point nearest to the origin goes along.
  EXPECT_EQ(image(kMoved, "plane3d", "(2 0 0 1)"), "((10.0 20.0 32.0) (0.0 0.0 1.0))");
  EXPECT_EQ(image(kMoved, "plane3d", "((1 2 3) (0 0 1))"), "((11.0 22.0 33.0) (0.0 0.0 1.0))");
}

TEST(Motion, a_type_says_what_its_numbers_are) {
  algebra3d::Registry types;
  types.add(algebra3d::TypeOf<Cloud>::type());
  const Motion moved = Motion::translation(types, {10, 20, 30});
  EXPECT_EQ(image(moved, "cloud3d", "((1 2 3) (0 0 0))"), "((11.0 22.0 33.0) (10.0 20.0 30.0))");
  EXPECT_EQ(image(kMoved, "cloud3d", "((1 2 3))"), "((1 2 3))");
  EXPECT_EQ(moved.image_of_constants(list("(f (cloud3d ((1 2 3))))")).print(), "(f (cloud3d ((11.0 22.0 33.0))))");
  EXPECT_EQ(frame_free(types, type("cloud3d"), list("((2 0 0) (1 0 0))")).print(), "((1 0 0) (2 0 0))");
}

TEST(Motion, turns_the_axes_in_a_circle) {
  EXPECT_EQ(image(kTurned, "point3d", "(1 2 3)"), "(3.0 1.0 2.0)");
  EXPECT_EQ(image(kTurned, "vector3d", "(1 2 3)"), "(3.0 1.0 2.0)");
  EXPECT_EQ(image(kTurned, "rect3", "(1 2 3 4 5 6)"), "(5.0 6.0 1.0 2.0 3.0 4.0)");
  EXPECT_EQ(image(kTurned, "plane3d", "(7 1 2 3)"), "(7 3 1 2)");
}

TEST(Motion, moves_what_is_in_relations) {
  EXPECT_EQ(image(kMoved, "(rel (tuple ((N int) (P point3d))))", "((1 (1 2 3)) (2 undefined))"),
            "((1 (11.0 22.0 33.0)) (2 undefined))");
}

TEST(Motion, keeps_coordinates_exact) {
  EXPECT_EQ(image(kMoved, "point3d", "(1/3 1e-300 0.1)").find("31/3"), 1U);
  const std::string far = image(Motion::translation(test_registry(), {1048576, 0, 0}), "point3d", "(0.1 0 0)");
  EXPECT_EQ(image(Motion::translation(test_registry(), {1048576, 0, 0}).inverse(), "point3d", far), "(0.1 0.0 0.0)");
}

TEST(Motion, the_inverse_leads_back) {
  for (const Motion& motion : {kMoved, kTurned})
    for (const auto& [type_text, value] :
         {std::pair{"point3d", "(1.0 2.0 3.0)"}, std::pair{"rect3", "(1.0 2.0 3.0 4.0 5.0 6.0)"},
          std::pair{"plane3d", "((1.0 2.0 3.0) (4.0 5.0 6.0))"}})
      EXPECT_EQ(image(motion.inverse(), type_text, image(motion, type_text, value)), value);
}

TEST(Motion, what_is_no_value_stays_as_it_is) {
  for (const auto& [type_text, value] :
       {std::pair{"point3d", "(1 2)"}, std::pair{"point3d", "undefined"}, std::pair{"point3d", "(1 a 3)"},
        std::pair{"surface3d", "(((0 0 0) (1 0 0) (0 1 0)) ((0 0 0)))"}, std::pair{"rect3", "(1/3 1 0 1 0 1)"},
        std::pair{"plane3d", "(1 0 0 0)"}, std::pair{"int", "5"}, std::pair{"(rel (tuple ((P point3d))))", "((1 2 3))"},
        std::pair{"no_such_type", "(1 2 3)"}})
    EXPECT_EQ(image(kMoved, type_text, value), value);
}

TEST(Motion, order_that_follows_the_axes_is_taken_away) {
  const auto free = [](const std::string& type_text, const std::string& value) {
    return frame_free(test_registry(), type(type_text), list(value)).print();
  };
  EXPECT_EQ(free("points3d", "((2 0 0) (1 0 0))"), free("points3d", "((1 0 0) (2 0 0))"));
  EXPECT_EQ(free("surface3d", "((a b c) (d e f))"), free("surface3d", "((e f d) (c a b))"));
  EXPECT_NE(free("surface3d", "((a b c))"), free("surface3d", "((a c b))"));
  EXPECT_EQ(free("plane3d", "(2 0 0 1)"), free("plane3d", "((5 6 2) (0 0 1))"));
  EXPECT_NE(free("plane3d", "(2 0 0 1)"), free("plane3d", "(2 0 0 -1)"));
  EXPECT_EQ(free("point3d", "(2 1 0)"), "(2 1 0)");
}

/// `PASSED FAILED LEFT_OUT` per variation.
std::string varied(const std::string& cases, const Registry& registry = test_registry()) {
  const SampleRun result = run_sample("#setup s\n" + cases, {.varies = true}, registry);
  std::string text;
  for (const VariedChecks& checks : result.outcome.varied)
    text += fmt::format("{} {} {} {}, ", checks.name, checks.passed, checks.failed, checks.left_out);
  return text;
}

std::string varied_function() {
  return varied(
      "#testcase a\n#yields ((map point3d bool) (fun (p point3d) (= p (const point3d value (1.0 2.0 3.0)))))\n"
      "query fun(p: point3d) p = [const point3d value (1.0 2.0 3.0)];\n");
}

std::string moved(const Variation& variation, const std::string& command) {
  auto result = variation.moved_command(command, {"/no/such/folder", "/no/such/scratch"});
  return result ? std::move(result).value() : "error: " + result.error().text();
}

TEST(Variation, literals_are_moved_in_the_text) {
  const Variation axes(VariationKind::axes, test_registry());
  EXPECT_EQ(moved(axes, "query [const point3d value (1 2 3)]"), "query [const point3d value (3.0 1.0 2.0)]");
  EXPECT_EQ(moved(axes, "query f([const vector3d value (1 2 3)], 'a ]', [const int value 5]) + 1"),
            "query f([const vector3d value (3.0 1.0 2.0)], 'a ]', [const int value 5]) + 1");
  EXPECT_EQ(moved(axes, "let R = [const rel(tuple([P: point3d])) value (((1 2 3)))] feed"),
            "let R = [const rel(tuple([P: point3d])) value (((3.0 1.0 2.0)))] feed");
  EXPECT_EQ(moved(axes, "query [const (rel (tuple ((P point3d)))) value (((1 2 3)))]"),
            "query [const (rel (tuple ((P point3d)))) value (((3.0 1.0 2.0)))]");
}

TEST(Variation, constants_in_nested_lists_are_moved) {
  const Variation axes(VariationKind::axes, test_registry());
  EXPECT_EQ(moved(axes, "(query (bbox (point3d (1 2 3))))"), "(query (bbox (point3d (3.0 1.0 2.0))))");
  EXPECT_EQ(moved(axes, "(let p = (const point3d value (1 2 3)))"), "(let p = (const point3d value (3.0 1.0 2.0)))");
  EXPECT_EQ(moved(axes, "(query (count ((rel (tuple ((P point3d)))) (((1 2 3))))))"),
            "(query (count ((rel (tuple ((P point3d)))) (((3.0 1.0 2.0))))))");
  EXPECT_EQ(moved(axes, "(query (+ 1 2))"), "(query (+ 1 2))");
}

TEST(Variation, constants_in_functions_are_moved_back) {
  EXPECT_EQ(varied_function(), "offset 1 0 0, axes 1 0 0, operands 1 0 0, ");
}

TEST(Variation, text_that_is_no_literal_stays) {
  const Variation offset(VariationKind::offset, test_registry());
  for (const char* text :
       {"query 1 + 2", "query \"[const point3d value (1 2 3)]\"", "query '[const point3d value (1 2 3)]'",
        "query [const point3d value (1 2)]", "query [const point3d value (1 2 3)", "query [const", "query [const 5 6]",
        "query \xC2\xA7 [const point3d value (1 2 3)]", "(query (point3d (1 2 3))", "query [const point3d value (1 2]"})
    EXPECT_EQ(moved(offset, text), text);
}

TEST(Variation, results_are_moved_back) {
  const Variation axes(VariationKind::axes, test_registry());
  EXPECT_EQ(axes.original_result(list("(point3d (3.0 1.0 2.0))")).print(), "(point3d (1.0 2.0 3.0))");
  EXPECT_EQ(axes.original_result(list("(inquiry (objects ()))")).print(), "(inquiry (objects ()))");
  EXPECT_EQ(axes.original_result(list("()")).print(), "()");
}

TEST(Variation, every_case_is_asked_in_every_way) {
  const SampleRun result = run_sample("#setup s\n#testcase a\n#yields (int 1)\nquery 1;\n", {.varies = true});
  EXPECT_EQ(result.outcome.passed, 4U);
}

TEST(Variation, expected_answers_follow_by_rule) {
  const std::string cases =
      "create database d;\nopen database d;\nlet P = makePoint3D(1, 2, 3);\n"
      "let C = createCylinder(P, 1, 3, 4);\n"
      "#testcase point\n#yields (point3d (1.0 2.0 3.0))\nquery P;\n"
      "#testcase number\n#yields (real 3.0)\nquery getz(P);\n"
      "#testcase box\n#yields (rect3 (0.0 2.0 1.0 3.0 3.0 6.0))\nquery bbox(C);\n"
      "#testcase bound\n#yields (real 6.0)\nquery maxD(bbox(C), 3);\n"
      "#testcase volume\n#yields (real 6.0)\nquery volume(C);\n"
      "#testcase mirrored\n#yields (point3d (1.0 2.0 1.0))\nquery P mirror[[const plane3d value (2 0 0 1)]];\n"
      "#testcase turned\n#yields (point3d (-2.0 1.0 3.0))\n"
      "query P rotate[[const point3d value (0 0 0)], makeVector3D(0, 0, 1), 90];\n"
      "#testcase scaled\n#yields (point3d (2.0 2.0 -3.0))\n"
      "query P scaleDir[makePoint3D(0, 0, 0), makeVector3D(2, 1, -1)];\n"
      "#testcase plane\n#yields (plane3d (2.0 0.0 0.0 1.0))\nquery [const plane3d value (2 0 0 1)];\n"
      "#testcase object\n#yields *P\nquery [const point3d value (1 2 3)];\n"
      "#testcase stored\n#yields (real 3.0)\nquery intstream(1, 2) transformstream\n"
      "  extend[Q: makePoint3D(.Elem, 0, 0)] extend[X: getx(.Q)] sum[X];\n";
  EXPECT_EQ(varied(cases), "offset 11 0 0, axes 11 0 0, operands 11 0 0, ");
}

TEST(Variation, exported_files_are_in_the_space_of_the_file) {
  EXPECT_EQ(
      varied("#testcase a\n#yields (bool TRUE)\n"
             "query createCube(makePoint3D(0, 0, 0), makePoint3D(1, 2, 3)) exportSTL[\"c\", '$(SCRATCH)/c', TRUE];\n"
             "#testcase b\n#yields (rect3 (0.0 1.0 0.0 2.0 0.0 3.0))\nquery bbox(importSTL('$(SCRATCH)/c'));\n"),
      "offset 2 0 0, axes 2 0 0, operands 2 0 0, ");
}

bool lies_near_the_origin(const algebra3d::Point3d& p) {
  return p.position.approx().x < 1000;
}
bool leans_to_x(const algebra3d::Point3d& p) {
  return p.position.approx().x > p.position.approx().y;
}

TEST(Variation, saved_objects_are_moved_when_they_are_restored) {
  const TestFolder folder;
  std::ofstream(folder.path() / "saved") << "(DATABASE saved (DESCRIPTIVE ALGEBRA) (TYPES) (OBJECTS\n"
                                            "(OBJECT P () point3d (1.0 2.0 3.0) ())\n"
                                            "(OBJECT N () int 5 ())\n"
                                            "(DERIVED Q (bbox (point3d (1.0 2.0 3.0))))))\n";
  std::ofstream(folder.path() / "restores.test")
      << "#setup s\nrestore database saved from saved;\n"
         "#testcase a\n#yields (point3d (1.0 2.0 3.0))\nquery P;\n"
         "#testcase b\n#yields (bool TRUE)\nquery P = makePoint3D(1, 2, 3);\n"
         "#testcase c\n#yields (rect3 (1.0 1.0 2.0 2.0 3.0 3.0))\nquery Q;\n"
         "#testcase d\nsave P to '$(SCRATCH)/p';\ndelete P;\nrestore P from '$(SCRATCH)/p';\n"
         "#yields (point3d (1.0 2.0 3.0))\nquery P;\n";
  std::string report;
  const auto outcome =
      run_test_file(folder.path() / "restores.test", test_registry(),
                    {.print = [&](const std::string& line) { report += line + "\n"; }, .varies = true});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome->passed, 28U) << report;
  EXPECT_EQ(outcome->failed, 0U) << report;
}

TEST(Variation, an_operator_that_depends_on_coordinates_is_found_out) {
  Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  registry.add({.name = "isNear",
                .syntax = "isNear(_)",
                .doc = "True near the origin.",
                .overloads = {algebra3d::overload<&lies_near_the_origin>("p")}});
  registry.add({.name = "leansToX",
                .syntax = "leansToX(_)",
                .doc = "True if x is larger.",
                .overloads = {algebra3d::overload<&leans_to_x>("p")}});
  EXPECT_EQ(varied("#testcase a\n#yields (bool TRUE)\nquery isNear(makePoint3D(1, 2, 3));\n", registry),
            "offset 0 1 0, axes 1 0 0, operands 1 0 0, ");
  EXPECT_EQ(varied("#testcase a\n#yields (bool FALSE)\nquery leansToX(makePoint3D(1, 2, 3));\n", registry),
            "offset 0 1 0, axes 0 1 0, operands 1 0 0, ");
}

double first_operand(double a, double /*b*/) {
  return a;
}

TEST(Variation, an_operator_that_wrongly_says_that_it_is_symmetric_is_found_out) {
  Registry registry;
  for (const algebra3d::Type* known : test_registry().types()) registry.add(*known);
  registry.add({.name = "+",
                .syntax = "_ + _",
                .doc = "The first of two.",
                .overloads = {algebra3d::symmetric(algebra3d::overload<&first_operand>("a", "b"))}});
  EXPECT_EQ(varied("#testcase a\n#yields (real 1.0)\nquery 1.0 + 2.0;\n", registry),
            "offset 1 0 0, axes 1 0 0, operands 0 1 0, ");
}

TEST(Variation, a_case_may_say_what_does_not_hold) {
  const std::string order = "#yields (bool TRUE)\nquery makePoint3D(1, 2, 3) < makePoint3D(2, 1, 1);\n";
  EXPECT_EQ(varied("#testcase a\n" + order), "offset 1 0 0, axes 0 1 0, operands 1 0 0, ");
  EXPECT_EQ(varied("#testcase a\n#variation offset,operands points are ordered by x first\n" + order),
            "offset 1 0 0, axes 0 0 1, operands 1 0 0, ");
  EXPECT_EQ(varied("#testcase a\n#variation none points are ordered by x first\n" + order),
            "offset 0 0 1, axes 0 0 1, operands 0 0 1, ");
  // It ends with its case, or holds for the file.
  EXPECT_EQ(varied("#testcase a\n#variation none because\n" + order + "#testcase b\n" + order),
            "offset 1 0 1, axes 0 1 1, operands 1 0 1, ");
  EXPECT_EQ(varied("#variation offset because\n#testcase a\n" + order + "#testcase b\n" + order),
            "offset 2 0 0, axes 0 0 2, operands 0 0 2, ");
}

TEST(Variation, what_does_not_hold_needs_a_reason) {
  EXPECT_EQ(verdict("#testcase a\n#variation none\n#yields (int 1)\nquery 1;"), "1/1");
  EXPECT_EQ(verdict("#testcase a\n#variation sideways because\n#yields (int 1)\nquery 1;"), "1/1");
}

TEST(Variation, a_comment_about_variations_is_no_directive) {
  EXPECT_EQ(verdict("# variation is the spice of life\n#testcase a\n#yields (int 1)\nquery 1;"), "1/0");
}

TEST(Variation, commands_of_left_out_cases_are_run) {
  EXPECT_EQ(varied("create database d;\nopen database d;\n#testcase a\n#variation none because\nlet x = 1;\n"
                   "#testcase b\n#yields (int 1)\nquery x;\n"),
            "offset 1 0 1, axes 1 0 1, operands 1 0 1, ");
}

TEST(Variation, a_failure_names_the_variation) {
  const SampleRun result =
      run_sample("#setup s\n#testcase order\n#yields (bool TRUE)\nquery makePoint3D(1, 2, 3) < makePoint3D(2, 1, 1);\n",
                 {.varies = true});
  EXPECT_EQ(result.outcome.failures, std::vector<std::string>{"1@4 (axes)"});
  EXPECT_NE(result.report.find("FAILED 1@4 (axes) order"), std::string::npos) << result.report;
}

}  // namespace
}  // namespace queries
