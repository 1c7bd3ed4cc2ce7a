#include "queries/language/checker.h"

#include <gtest/gtest.h>

#include "unit/language/language_samples.h"

namespace queries {
namespace {

TEST(Checker, literals_and_objects) {
  EXPECT_EQ(type_of("1"), "int");
  EXPECT_EQ(type_of("1.0"), "real");
  EXPECT_EQ(type_of("TRUE"), "bool");
  EXPECT_EQ(type_of("\"a\""), "string");
  EXPECT_EQ(type_of("'a'"), "text");
  EXPECT_EQ(type_of("Limit"), "int");
  EXPECT_EQ(type_of("Parts"), "(rel (tuple ((Name string) (Solid volume3d))))");
  EXPECT_EQ(type_of("[const typeOf(Parts) value ()]"), "(rel (tuple ((Name string) (Solid volume3d))))");
}

TEST(Checker, overloads_and_promotion) {
  EXPECT_EQ(type_of("1 + 2"), "int");
  EXPECT_EQ(type_of("1 + 2.0"), "real");
  EXPECT_EQ(type_of("1 / 2"), "real");
  EXPECT_EQ(type_of("Limit < 2.5"), "bool");
}

TEST(Checker, streams_and_functions) {
  EXPECT_EQ(type_of("Parts feed"), "(stream (tuple ((Name string) (Solid volume3d))))");
  EXPECT_EQ(type_of("Parts feed extend[V: volume(.Solid)]"),
            "(stream (tuple ((Name string) (Solid volume3d) (V real))))");
  EXPECT_EQ(type_of("Parts feed {p} project[Name_p]"), "(stream (tuple ((Name_p string))))");
  EXPECT_EQ(type_of("Parts feed groupby[Name; N: group count]"), "(stream (tuple ((Name string) (N int))))");
  EXPECT_EQ(type_of("fun(n: int, r: real) n + r"), "(map int real real)");
  EXPECT_EQ(type_of("fun(t: tuple([A: int])) attr(t, A)"), "(map (tuple ((A int))) int)");
  EXPECT_EQ(type_of("twice(twice(1))"), "int");
  EXPECT_EQ(type_of("fun twice"), "(map int int)");
  EXPECT_EQ(type_of("Parts creatertree[Solid]"), "(rtree3 (tuple ((Name string) (Solid volume3d))) volume3d FALSE)");
}

TEST(Checker, inner_functions_see_the_parameters_of_outer_ones) {
  EXPECT_EQ(type_of("Parts feed filter[fun(t: TUPLE) Parts feed {i} filter[.Name_i = attr(t, Name)] count > 1] count"),
            "int");
  EXPECT_EQ(type_of("fun(a: int) fun(b: real) a + b"), "(map int (map real real))");
}

TEST(Checker, parameters_hide_objects) {
  EXPECT_EQ(type_of("fun(Limit: string) Limit"), "(map string string)");
}

TEST(Checker, objects_may_have_the_names_of_operators) {
  EXPECT_EQ(type_of("area + 1"), "int");
  EXPECT_EQ(type_of("union union union"), "rect3");
  EXPECT_EQ(type_of("Parts feed extend[area: area(.Solid) + area] extract[area]"), "real");
  EXPECT_EQ(type_of("fun(area: string) area"), "(map string string)");
}

TEST(Checker, a_function_takes_the_calls_of_its_name_that_fit) {
  EXPECT_EQ(type_of("length(1)"), "string");
  EXPECT_EQ(type_of("length(makeVector3D(1, 2, 3))"), "real");
  EXPECT_EQ(type_of("`length`(1)"), "string");
  EXPECT_EQ(type_of("between(1, 2)"), "int");
  EXPECT_EQ(type_of("1 between[0, 2]"), "bool");
  EXPECT_EQ(type_of("fun(size: map(int, bool)) size(1)"), "(map (map int bool) bool)");
  EXPECT_EQ(type_of("fun(length: vector3d) length(length)"), "(map vector3d real)");
}

TEST(CheckerErrors, names_of_operators_that_are_no_objects) {
  EXPECT_EQ(type_of("1 + volume"),
            "error 1:5 there is no object 'volume'; the operator of that name is written volume(_)");
  EXPECT_EQ(type_of("feed"), "error 1:1 there is no object 'feed'; the operator of that name is written _ feed");
  EXPECT_EQ(type_of("count(Parts)"),
            "error 1:1 there is no function 'count'; the operator of that name is written _ count");
  EXPECT_EQ(type_of("`volume`(1)"),
            "error 1:1 there is no function 'volume'; the operator of that name is written volume(_)");
  EXPECT_EQ(type_of("`length`(TRUE)"), "error 1:10 length: expected int, got bool");
}

TEST(Hints, attributes_that_lack_their_dot_or_have_the_wrong_one) {
  EXPECT_EQ(type_of("Parts feed filter[Name = \"a\"] count"),
            "error 1:19 unknown name 'Name', did you mean the attribute '.Name'?");
  EXPECT_EQ(type_of("Parts feed filter[fun(t: TUPLE) Name = \"a\"] count"),
            "error 1:33 unknown name 'Name', did you mean the attribute 'attr(t, Name)'?");
  EXPECT_EQ(type_of("Parts feed filter[name = \"a\"] count"), "error 1:19 unknown name 'name', did you mean '.Name'?");
  EXPECT_EQ(type_of("Parts feed {a} Parts feed {b} symmjoin[.Name_b = \"x\"] count"),
            "error 1:40 unknown attribute '.Name_b', did you mean '..Name_b', of the second stream?");
  EXPECT_EQ(type_of("Parts feed {a} Parts feed {b} symmjoin[.Name_a = ..Name_a] count"),
            "error 1:50 unknown attribute '..Name_a', did you mean '.Name_a', of the first stream?");
  EXPECT_EQ(type_of("Parts feed {a} Parts feed {b} symmjoin[Name_b = \"x\"] count"),
            "error 1:40 unknown name 'Name_b', did you mean the attribute '..Name_b'?");
}

TEST(Hints, near_misses_of_objects_come_before_operators) {
  EXPECT_EQ(type_of("rr"), "error 1:1 unknown name 'rr'");
  EXPECT_EQ(type_of("Count"), "error 1:1 unknown name 'Count'");
  EXPECT_EQ(type_of("Volume"), "error 1:1 unknown name 'Volume', did you mean 'volume'?");
  EXPECT_EQ(type_of("parts feed count"), "error 1:1 unknown name 'parts', did you mean 'Parts'?");
  EXPECT_EQ(type_of("limt"), "error 1:1 unknown name 'limt', did you mean 'Limit'?");
  EXPECT_EQ(type_of("true"), "error 1:1 unknown name 'true', did you mean 'TRUE'?");
}

TEST(CheckerErrors, unknown_names) {
  EXPECT_EQ(type_of("1 + limit"), "error 1:5 unknown name 'limit', did you mean 'Limit'?");
  EXPECT_EQ(type_of("Part feed count"), "error 1:1 unknown name 'Part', did you mean 'Parts'?");
  EXPECT_EQ(type_of("q"), "error 1:1 unknown name 'q'");
  EXPECT_EQ(type_of("volum(1)"), "error 1:1 unknown operator 'volum', did you mean 'volume'?");
  EXPECT_EQ(type_of("[const valume3d value ()]"), "error 1:8 unknown type 'valume3d', did you mean 'volume3d'?");
  EXPECT_EQ(type_of("Parts feed filter[.Nam = \"a\"]"),
            "error 1:19 unknown attribute 'Nam', did you mean 'Name'? The attributes are Name or Solid");
  EXPECT_EQ(type_of("Parts feed project[Names] count").substr(0, 67),
            "error 1:12 project: unknown attribute 'Names', did you mean 'Name'?");
}

TEST(CheckerErrors, types_that_do_not_fit) {
  EXPECT_EQ(type_of("volume(Limit)"), "error 1:1 volume: expected (volume3d), got (int)");
  EXPECT_EQ(type_of("1 +\n TRUE").substr(0, 12), "error 1:3 +:");
  EXPECT_EQ(type_of("Parts feed filter[.Name]"), "error 1:12 filter: expected a function that gives bool, got string");
  EXPECT_EQ(type_of("Parts filter[TRUE]").substr(0, 81),
            "error 1:7 filter: expected a stream of tuples (write `feed` after the relation), ");
  EXPECT_EQ(type_of("twice(TRUE)"), "error 1:7 twice: expected int, got bool");
  EXPECT_EQ(type_of("twice()"), "error 1:1 twice: expected (int) arguments, got 0");
  EXPECT_EQ(type_of("Limit(1)"), "error 1:1 Limit: expected a function, got int");
  EXPECT_EQ(type_of("volume(Parts feed)").substr(0, 47), "error 1:1 volume: expected (volume3d), got ((st");
  EXPECT_EQ(type_of("1 + fun(a: int) a").substr(0, 12), "error 1:3 +:");
}

TEST(CheckerErrors, counts_of_arguments) {
  EXPECT_EQ(type_of("Parts feed head[]"), "error 1:12 head: expected something in the brackets (syntax: _ head[_])");
  EXPECT_EQ(type_of("Parts feed head[1, 2]"),
            "error 1:12 head: expected 1 argument in the brackets, got 2 (syntax: _ head[_])");
  EXPECT_EQ(type_of("volume()"), "error 1:1 volume: expected (volume3d), got ()");
}

TEST(CheckerErrors, implicit_parameters_out_of_place) {
  EXPECT_EQ(type_of(".A"),
            "error 1:1 '.A' needs an operator around it that gives it a meaning, such as filter or extend");
  EXPECT_EQ(type_of("Parts feed filter[..Name = \"a\"]"), "error 1:19 '..Name': the function here has 1 parameter");
  EXPECT_EQ(type_of("Parts feed filter[fun(t: TUPLE) .Name = \"a\"]").substr(0, 29), "error 1:33 '.Name' needs an o");
}

TEST(CheckerErrors, constants) {
  EXPECT_EQ(type_of("[const point3d value (1 2)]"), "error 1:22 point3d: expected (x y z), got (1 2)");
  EXPECT_EQ(type_of("[const stream(int) value ()]"), "error 1:2 a constant cannot be of type (stream int)");
  EXPECT_EQ(type_of("[const rel(tuple([A: int, A: real])) value ()]"),
            "error 1:18 tuple: duplicate attribute name 'A'; rename one of them");
  EXPECT_EQ(type_of("[const rel(tuple([A: rel(tuple([B: int]))])) value ()]").substr(0, 63),
            "error 1:18 tuple: attribute 'A': expected a type of kind DATA, ");
}

TEST(CheckerErrors, wrong_elements_of_constants_have_their_place) {
  const auto place = [](const std::string& text) {
    const std::string shown = type_of(text);
    return shown.substr(0, shown.find(' ', 6));
  };
  EXPECT_EQ(place("[const point3d value (1 x 3)]"), "error 1:25");
  EXPECT_EQ(place("[const points3d value ((1 2 3)\n (4 5) (6 7 8))]"), "error 2:2");
  EXPECT_EQ(place("[const volume3d value (((0 0 0) (1 0 0) (0 1 0))\n ((0 0 0) (1 'a' 0) (0 1 0)))]"), "error 2:14");
  EXPECT_EQ(place("[const rel(tuple([A: int, P: point3d])) value ((1 (0 0 0))\n (2 (0 \"y\" 0)) (3 4))]"), "error 2:8");
  EXPECT_EQ(place("[const rel(tuple([A: int, B: bool])) value ((1 TRUE)\n (2 3) (4 TRUE))]"), "error 2:5");
  EXPECT_EQ(place("[const rel(tuple([A: int, B: bool])) value ((1 TRUE)\n (2))]"), "error 2:2");
  EXPECT_EQ(place("[const int value \"a\"]"), "error 1:18");
}

TEST(CheckerErrors, lists_are_no_values) {
  EXPECT_EQ(type_of("[1, 2]"), "error 1:1 a list of 2 elements is not a value");
  EXPECT_EQ(type_of("[1]"), "int");
}

}  // namespace
}  // namespace queries
