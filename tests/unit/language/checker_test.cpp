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

TEST(CheckerErrors, unknown_names) {
  EXPECT_EQ(type_of("1 + limit"), "error 1:5 unknown name 'limit', did you mean 'Limit'?");
  EXPECT_EQ(type_of("Part feed count"), "error 1:1 unknown name 'Part', did you mean 'Parts'?");
  EXPECT_EQ(type_of("q"), "error 1:1 unknown name 'q'");
  EXPECT_EQ(type_of("volum(1)"), "error 1:1 unknown operator 'volum', did you mean 'volume'?");
  EXPECT_EQ(type_of("[const valume3d value ()]"), "error 1:8 unknown type 'valume3d', did you mean 'volume3d'?");
  EXPECT_EQ(type_of("Parts feed filter[.Nam = \"a\"]"),
            "error 1:19 unknown attribute 'Nam', did you mean 'Name'?; the attributes are Name or Solid");
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
  EXPECT_EQ(type_of("[const point3d value (1 2)]"), "error 1:2 point3d: expected (x y z), got (1 2)");
  EXPECT_EQ(type_of("[const stream(int) value ()]"), "error 1:2 a constant cannot be of type (stream int)");
  EXPECT_EQ(type_of("[const rel(tuple([A: int, A: real])) value ()]"),
            "error 1:18 tuple: the attribute 'A' stands twice");
  EXPECT_EQ(type_of("[const rel(tuple([A: rel(tuple([B: int]))])) value ()]").substr(0, 63),
            "error 1:18 tuple: attribute 'A': expected a type of kind DATA, ");
}

TEST(CheckerErrors, lists_are_no_values) {
  EXPECT_EQ(type_of("[1, 2]"), "error 1:1 a list of 2 elements is no value");
  EXPECT_EQ(type_of("[1]"), "int");
}

}  // namespace
}  // namespace queries
