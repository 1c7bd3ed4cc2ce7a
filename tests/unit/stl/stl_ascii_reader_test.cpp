#include <array>
#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stl/stl_reader.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;
using mesh_formats::read_stl;
using stl_bytes::kAscii;
using stl_bytes::kAsciiFacet;
using stl_bytes::replaced;

const TriangleSoup::Triangle kTriangle = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
const std::string kOneLineFacet = stl_bytes::replaced(kAsciiFacet, "\n", " ");

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

struct Accepted {
  std::string label;
  std::string bytes;
  std::size_t triangle_count;
  std::string name;
  std::size_t solid_count = 1;
  std::vector<std::string> remarks = {};
};

std::vector<Accepted> layouts() {
  return {
      {"plain", kAscii, 1, "part"},
      {"carriage return and line feed", replaced(kAscii, "\n", "\r\n"), 1, "part"},
      {"carriage return", replaced(kAscii, "\n", "\r"), 1, "part"},
      {"upper case", upper(kAscii), 1, "PART"},
      {"mixed case", replaced(replaced(kAscii, "facet", "Facet"), "solid", "sOLid"), 1, "part"},
      {"every word on a line of its own",
       "solid part\n" + replaced(replaced(kAsciiFacet, " ", "\n"), "\n", "\n\t\n") + "endsolid", 1, "part"},
      {"all on one line", "solid part " + kOneLineFacet + kOneLineFacet + "endsolid part", 2, "part"},
      {"one line, no name", "solid " + kOneLineFacet + "endsolid", 1, ""},
      {"one line, name of several words", "solid my part no 7 " + kOneLineFacet + "endsolid my part no 7\n", 1,
       "my part no 7"},
      {"facet begins on the solid line", "solid part facet\nnormal 0 0 1" + kOneLineFacet.substr(20) + "endsolid", 1,
       "part"},
      {"tabs and form feeds", replaced(replaced(kAscii, "  ", "\t"), "outer loop", "outer\f\vloop"), 1, "part"},
      {"leading white space", " \r\n\t" + kAscii, 1, "part"},
      {"byte order mark", "\xef\xbb\xbf" + kAscii, 1, "part"},
      {"byte order mark and blank", "\xef\xbb\xbf " + kAscii, 1, "part"},
      {"two words at the ends",
       replaced(replaced(replaced(kAscii, "endloop", "end loop"), "endfacet", "end facet"), "endsolid", "end solid"), 1,
       "part"},
      {"comments",
       "# first\n#second\nsolid part\n" + replaced(kAsciiFacet, "\n", " # comment\n # more\n") +
           "endsolid part # end\n#",
       1, "part"},
      {"no line break at the end", "solid part\n" + kAsciiFacet + "endsolid", 1, "part"},
      {"longer than the sample that decides the format",
       "solid part\n" + replaced(kAsciiFacet + kAsciiFacet, "\n", "\n" + std::string(500, ' ')) + "endsolid part\n", 2,
       "part"},
  };
}

std::vector<Accepted> names_and_ends() {
  return {
      {"name with blanks", replaced(kAscii, "part", "a part with blanks"), 1, "a part with blanks"},
      {"name with blanks at its ends", "solid \t part  \r\n" + kAsciiFacet + "endsolid", 1, "part"},
      {"no name", replaced(kAscii, " part", ""), 1, ""},
      {"name in other letters", "solid W\xc3\xbcrfel\n" + kAsciiFacet + "endsolid W\xc3\xbcrfel\n", 1, "W\xc3\xbcrfel"},
      {"name facet", replaced(kAscii, "part", "facet"), 1, "facet"},
      {"name with facet normal", replaced(kAscii, "part", "my facet normal part"), 1, "my facet normal part"},
      {"name ends in facet normal", replaced(kAscii, "part", "my facet normal"), 1, "my facet normal"},
      {"name with facet normal and a number", replaced(kAscii, "part", "facet normal 3"), 1, "facet normal 3"},
      {"name endsolid", replaced(kAscii, "part", "endsolid"), 1, "endsolid"},
      {"name solid", replaced(kAscii, "part", "solid"), 1, "solid"},
      {"name with end of solid", replaced(kAscii, "part", "the end solid of it"), 1, "the end solid of it"},
      {"other name at the end", "solid part\n" + kAsciiFacet + "endsolid other\n", 1, "part"},
      {"missing endsolid", "solid part\n" + kAsciiFacet, 1, "part", 1, {"missing endsolid"}},
      {"missing endsolid before the next solid",
       "solid a\n" + kAsciiFacet + "solid b\n" + kAsciiFacet,
       2,
       "a",
       2,
       {"missing endsolid in 2 solids"}},
      {"padding",
       kAscii + std::string("\x1a\0\0\0", 4),
       1,
       "part",
       1,
       {"4 trailing bytes after the last solid ignored"}},
      {"empty on two lines", "solid Empty\nendsolid Empty", 0, "Empty"},
      {"empty on one line", "solid x endsolid x", 0, "x"},
      {"empty without name", "solid endsolid", 0, ""},
  };
}

std::vector<Accepted> several_solids() {
  const std::string b = replaced(kAscii, "part", "b");
  return {
      {"two solids", kAscii + b, 2, "part", 2},
      {"an empty one between", kAscii + "solid empty\nendsolid empty\n" + b, 2, "part", 3},
      {"second begins on the line of the first's end", "solid a\n" + kAsciiFacet + "endsolid a " + b, 2, "a", 2},
      {"all on one line", "solid a " + kOneLineFacet + " endsolid a solid b c " + kOneLineFacet + " endsolid b c", 2,
       "a", 2},
      {"all on one line without names", "solid " + kOneLineFacet + " endsolid solid " + kOneLineFacet + " endsolid", 2,
       "", 2},
      {"empty ones on one line", "solid a endsolid a solid b endsolid b solid c endsolid c", 0, "a", 3},
      {"name of the end holds solid", replaced(kAscii, "part", "my solid part") + b, 2, "my solid part", 2},
      {"only the second has a name", replaced(kAscii, " part", "") + b, 2, "", 2},
  };
}

TEST(StlAsciiReader, reads_every_layout) {
  for (const auto& table : {layouts(), names_and_ends(), several_solids()}) {
    for (const Accepted& file : table) {
      SCOPED_TRACE(file.label);
      const auto read = read_stl(file.bytes, "a.stl");
      ASSERT_TRUE(read) << read.error().text();
      EXPECT_EQ(read->format, mesh_formats::Encoding::ascii);
      EXPECT_EQ(read->soup.triangles, (std::vector<TriangleSoup::Triangle>(file.triangle_count, kTriangle)));
      EXPECT_EQ(read->soup.normals, (std::vector<Vec3>(file.triangle_count, Vec3{0, 0, 1})));
      EXPECT_EQ(read->soup.name, file.name);
      EXPECT_EQ(read->solid_count, file.solid_count);
      EXPECT_EQ(read->remarks, file.remarks);
    }
  }
}

struct Number {
  std::string text;
  double value;
};

TEST(StlAsciiReader, numbers_are_the_nearest_doubles) {
  const std::vector<Number> numbers = {
      {"1", 1},
      {"-1.5", -1.5},
      {"+2", 2},
      {".5", 0.5},
      {"5.", 5},
      {"1e3", 1000},
      {"1.E+003", 1000},
      {"-2.5E-1", -0.25},
      {"0.1", 0.1},
      {"1e300", 1e300},
      {"1e-999", 0},
      {"5e-324", 0x1p-1074},
      {"-0", 0},
      {"00012.500", 12.5},
      {"16777217", 16777217},
      {"0.1000000000000000055511151231257827021181583404541015625", 0.1},
      {"9007199254740993", 9007199254740992.0},
  };
  for (const Number& number : numbers) {
    const auto read = read_stl(replaced(kAscii, "vertex 1 0 0", "vertex 1 0 " + number.text), "a.stl");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->soup.triangles.at(0)[1], (Vec3{1, 0, number.value})) << number.text;
  }
}

TEST(StlAsciiReader, facets_without_a_normal_are_read) {
  const std::string bare = replaced(kAsciiFacet, "facet normal 0 0 1", "facet");
  const auto read = read_stl("solid\n" + bare + kAsciiFacet + kAsciiFacet + bare + kAsciiFacet + "endsolid\n", "a.stl");
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read->soup.normals, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(read->soup.triangles,
            (std::vector<algebra3d::TriangleSoup::Triangle>(5, {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}})));
  EXPECT_EQ(read->remarks, std::vector<std::string>{"2 facets have no normal"});
}

TEST(StlAsciiReader, normals_that_are_not_finite_become_zero) {
  for (const char* text :
       {"nan", "-nan", "NaN", "nan(ind)", "-nan(ind)", "inf", "-Infinity", "1.#QNAN", "-1.#IND", "1.#INF00", "1e999"}) {
    const auto read =
        read_stl(replaced(kAscii + kAscii, "normal 0 0 1", std::string("normal 0 ") + text + " 1"), "a.stl");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->soup.normals, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}})) << text;
    EXPECT_EQ(read->remarks, std::vector<std::string>{"2 facets have a normal that is not finite, read as zero"});
  }
}

struct Refused {
  std::string bytes;
  std::string message;  // without "a.stl: "
};

std::string with(std::string_view what, std::string_view by) {
  return replaced(kAscii, what, by);
}

std::vector<Refused> wrong_words() {
  const std::string crlf = replaced(kAscii, "\n", "\r\n");
  return {
      {with("vertex 1", "vertx 1"), "byte 72, line 5: expected 'vertex', found 'vertx'"},
      {replaced(crlf, "vertex 1", "vertx 1"), "byte 76, line 5: expected 'vertex', found 'vertx'"},
      {replaced(with("vertex 1", "vertx 1"), "\n", "\r"), "byte 72, line 5: expected 'vertex', found 'vertx'"},
      {with("      vertex 0 1 0\n", ""), "byte 89, line 6: expected 'vertex', found 'endloop'"},
      {with("    endloop", "      vertex 2 2 2\n    endloop"),
       "byte 110, line 7: facet 1 has more than 3 corners; expected 'endloop', found 'vertex'"},
      {with("vertex 1 0 0", "vertex 1 0"), "byte 89, line 6: expected a number, found 'vertex'"},
      {with("vertex 1 0 0", "vertex 1 0 0 0"), "byte 85, line 5: expected 'vertex', found '0'"},
      {with("vertex 1 0 0", "vertex 1 0,5 0"), "byte 81, line 5: expected a number, found '0,5' with a decimal comma"},
      {with("vertex 1 0 0", "vertex 1 0x1 0"), "byte 81, line 5: expected a number, found '0x1'"},
      {with("vertex 1 0 0", "vertex 1 --1 0"), "byte 81, line 5: expected a number, found '--1'"},
      {with("vertex 1 0 0", "vertex 1 +-1 0"), "byte 81, line 5: expected a number, found '+-1'"},
      {with("vertex 1 0 0", "vertex 1 1.#5 0"), "byte 81, line 5: expected a number, found '1.#5'"},
      {with("vertex 1 0 0", "vertex 1 1e 0"), "byte 81, line 5: expected a number, found '1e'"},
      {with("normal 0 0 1", "normal 0 0"), "byte 34, line 3: expected a number, found 'outer'"},
      {with("facet normal 0 0 1", "facet normals"), "byte 19, line 2: expected 'normal', found 'normals'"},
      {with("endloop", "endloops"), "byte 108, line 7: expected 'endloop', found 'endloops'"},
      {with("endfacet\n", ""), "byte 118, line 8: expected 'endfacet', found 'endsolid'"},
      {with("endsolid part", "junk"), "byte 127, line 9: expected 'facet' or 'endsolid', found 'junk'"},
      {kAscii + "junk", "byte 141, line 10: expected 'solid', found 'junk'"},
      {kAscii + kAsciiFacet, "byte 143, line 10: expected 'solid', found 'facet'"},
      {kAsciiFacet, "byte 2, line 1: expected 'solid', found 'facet'"},
      {"<html>\n", "byte 0, line 1: expected 'solid', found '<html>'"},
      {std::string(2000, 'x'), "byte 0, line 1: expected 'solid', found 'xxxxxxxxxxxxxxxxxxxxxxxx...'"},
      {with("vertex 1", std::string("ver\0tex 1", 9)), "byte 72, line 5: expected 'vertex', found 'ver\\x00tex'"},
      {"# only a comment", "byte 16, line 1: expected 'solid', found end of file"},
      {"solid part\n", "byte 11, line 2: expected 'facet' or 'endsolid', found end of file"},
      {kAscii.substr(0, 60), "byte 60, line 4: expected a number, found end of file"},
  };
}

TEST(StlAsciiReader, refuses_with_byte_line_found_and_expected) {
  for (const Refused& file : wrong_words()) {
    const auto read = read_stl(file.bytes, "a.stl");
    ASSERT_FALSE(read) << file.message;
    EXPECT_EQ(read.error().text(), "a.stl: " + file.message);
    EXPECT_EQ(read.error().code, ErrorCode::file_format);
  }
}

TEST(StlAsciiReader, refuses_coordinates_that_are_not_finite) {
  const std::vector<Refused> files = {
      {"nan", "'nan'; expected a finite number"},
      {"-inf", "'-inf'; expected a finite number"},
      {"1.#QNAN", "'1.#QNAN'; expected a finite number"},
      {"1e999", "'1e999'; expected a number within the range of double"},
      {"-1.5E+400", "'-1.5E+400'; expected a number within the range of double"},
  };
  for (const Refused& number : files) {
    const auto read = read_stl(kAscii + with("vertex 1 0 0", "vertex 1 " + number.bytes + " 0"), "a.stl");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().text(), "a.stl: byte 222, line 14: facet 2, corner 2: y is " + number.message);
  }
}

TEST(StlAsciiReader, every_truncation_is_an_error_or_has_a_remark_until_endsolid_stands) {
  const std::string whole = "solid part\n" + kAsciiFacet + kAsciiFacet;
  const std::size_t first_end = whole.find("endfacet") + 8;
  const std::size_t second_end = whole.rfind("endfacet") + 8;
  const std::string closed = whole + "endsolid";
  for (std::size_t size = 0; size < closed.size(); ++size) {
    const auto read = read_stl(std::string_view(closed).substr(0, size), "a.stl");
    // Readable where only white space stands behind a whole facet; otherwise the cut is in the middle of something.
    const bool is_between =
        (size >= first_end && size <= first_end + 3) || (size >= second_end && size <= second_end + 1);
    EXPECT_EQ(read.ok(), is_between) << size;
    if (read) {
      EXPECT_EQ(read->remarks, std::vector<std::string>{"missing endsolid"});
    }
  }
}

// Facets whose layout is that of the one before are read by comparing it; those beside them must come out the same.
TEST(StlAsciiReader, every_facet_may_have_a_layout_of_its_own) {
  const std::string crlf = replaced(kAsciiFacet, "\n", "\r\n");
  const std::string comment = replaced(kAsciiFacet, "outer loop", "# 1 2 3\n outer # x\n loop");
  const std::string upper = replaced(replaced(kAsciiFacet, "vertex", "VERTEX"), "facet", "FACET");
  const std::string two_blanks = replaced(replaced(kAsciiFacet, "vertex ", "vertex  "), " 1", "  1");
  const std::string exponents = replaced(kAsciiFacet, " 1", " +1.0e0");
  std::string bytes = "solid a\n";
  std::size_t count = 0;
  for (const std::string& facet :
       {kAsciiFacet, crlf, comment, upper, two_blanks, exponents, kOneLineFacet + "\n", kAsciiFacet}) {
    for (int i = 0; i < 3; ++i, ++count) bytes += facet;
    bytes += "# between\n";
  }
  bytes += "endsolid a\n";
  const auto read = read_stl(bytes, "a.stl");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->soup.triangles, (std::vector<TriangleSoup::Triangle>(count, kTriangle)));
  EXPECT_EQ(read->soup.normals, (std::vector<Vec3>(count, Vec3{0, 0, 1})));
}

TEST(StlAsciiReader, what_is_wrong_is_found_in_later_facets_too) {
  const auto wrong = [](std::string_view what, std::string_view by) {
    return "solid a\n" + kAsciiFacet + kAsciiFacet + replaced(kAsciiFacet, what, by) + kAsciiFacet + "endsolid a\n";
  };
  for (const auto& [what, by, message] :
       {std::array{"endfacet", "endfacets", "expected 'endfacet', found 'endfacets'"},
        std::array{"vertex 1", "vertex1", "expected 'vertex', found 'vertex1'"},
        std::array{"1 0 0", "1 0 0 0", "expected 'vertex', found '0'"},
        std::array{"1 0 0", "1 0,5 0", "expected a number, found '0,5' with a decimal comma"},
        std::array{"1 0 0", "1 1e999 0", "y is '1e999'; expected a number within"}}) {
    const auto read = read_stl(wrong(what, by), "a.stl");
    ASSERT_FALSE(read) << message;
    EXPECT_NE(read.error().text().find(message), std::string::npos) << read.error().text();
  }
}

TEST(StlAsciiReader, lines_with_very_many_names_take_linear_time) {
  std::string solids;
  std::string words = "solid ";
  std::string ends = "solid a endsolid ";
  for (int i = 0; i < 100'000; ++i) {
    solids += "solid a endsolid a ";
    words += "facet # normal endsolid ";
    ends += "solid b ";
  }
  const auto many = read_stl(solids, "a.stl");
  ASSERT_TRUE(many) << many.error().text();
  EXPECT_EQ(many->solid_count, 100'000U);
  EXPECT_TRUE(read_stl(ends, "a.stl"));
  EXPECT_TRUE(read_stl(words + "\n" + kAsciiFacet, "a.stl"));
}

TEST(StlAsciiReader, stops_when_cancelled) {
  std::string bytes = "solid\n";
  for (int i = 0; i < 65'536; ++i) bytes += kOneLineFacet;
  const std::atomic<bool> cancel = true;
  const auto read = read_stl(bytes, "a.stl", &cancel);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
}

}  // namespace
