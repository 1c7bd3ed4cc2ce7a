// Values for other programs: one at a time, in each form. The expected texts are those of docs/exchange.md.
#include "queries/exchange/exchange_values.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "unit/exchange/exchange_session.h"

namespace queries {
namespace {

using Geometry = ExchangeOptions::Geometry;

std::string cell(std::string_view text) {
  std::string csv;
  append_csv_text(csv, text);
  return csv;
}

// [rfc4180], section 2: quotes around commas, quotes and line ends; quotes are doubled.
TEST(CsvCell, is_quoted_only_where_a_reader_needs_it) {
  EXPECT_EQ(cell("bolt"), "bolt");
  EXPECT_EQ(cell("a,b"), "\"a,b\"");
  EXPECT_EQ(cell("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(cell("a\nb"), "\"a\nb\"");
  EXPECT_EQ(cell("a\r"), "\"a\r\"");
  EXPECT_EQ(cell("a b"), "a b");
  EXPECT_EQ(cell(" a"), "\" a\"");
  EXPECT_EQ(cell("a "), "\"a \"");
  EXPECT_EQ(cell(""), "\"\"") << "an empty cell without quotes is undefined";
}

/// A value of the language, and what it is in both formats.
struct Written {
  const char* expression;
  const char* json;
  const char* csv;
};

const Written kWritten[] = {
    {"3", "3", "3"},
    {"9223372036854775807", "9223372036854775807", "9223372036854775807"},
    {"0.1", "0.1", "0.1"},
    {"TRUE", "true", "TRUE"},
    {"\"a, b\"", "\"a, b\"", "\"a, b\""},
    {"\"\"", "\"\"", "\"\""},
    {"'it is'", "\"it is\"", "it is"},
    {"makePoint3D(1, 2, 3)", "[1.0,2.0,3.0]", "(1.0 2.0 3.0)"},
    {"[const point3d value (1/3 2 3)]", "[\"1/3\",2.0,3.0]", "(1/3 2.0 3.0)"},
    {"rectangle3(0, 1, 2, 3, 4, 5)", "[0.0,1.0,2.0,3.0,4.0,5.0]", "(0.0 1.0 2.0 3.0 4.0 5.0)"},
    {"[const volume3d value ()]", R"({"type":"volume3d","triangles":0,"box":null})",
     R"("{""type"":""volume3d"",""triangles"":0,""box"":null}")"},
    {"createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))",
     R"({"type":"volume3d","triangles":12,"box":[0.0,1.0,0.0,1.0,0.0,1.0]})",
     R"("{""type"":""volume3d"",""triangles"":12,""box"":[0.0,1.0,0.0,1.0,0.0,1.0]}")"},
    {"[const points3d value ((0 0 0) (5 5 5))]", R"({"type":"points3d","points":2,"box":[0.0,5.0,0.0,5.0,0.0,5.0]})",
     R"("{""type"":""points3d"",""points"":2,""box"":[0.0,5.0,0.0,5.0,0.0,5.0]}")"},
};

TEST(ExchangeValue, is_as_the_page_says) {
  ExchangeSession session;
  for (const Written& each : kWritten) {
    const std::string query = std::string("query ") + each.expression;
    EXPECT_EQ(session.json(query), std::string(each.json) + "\n") << query;
    EXPECT_EQ(session.csv(query), std::string(each.csv) + "\n") << query;
    EXPECT_TRUE(nlohmann::json::accept(session.json(query))) << query;
  }
}

// As all of a result undefined would look like an answer; the reason is reported in either case.
TEST(ExchangeValue, undefined_is_null_in_a_row_and_an_error_with_its_reason_alone) {
  ExchangeSession session;
  EXPECT_EQ(session.json("query [const int value undefined]"), "null\n");
  EXPECT_EQ(session.csv("query [const int value undefined]"), "\n");
  EXPECT_EQ(session.json("query [const rel(tuple([A: int, B: string])) value ((undefined \"\") (1 undefined))]"),
            "[{\"A\":null,\"B\":\"\"},\n{\"A\":1,\"B\":null}]\n");
  EXPECT_EQ(session.csv("query [const rel(tuple([A: int, B: string])) value ((undefined \"\") (1 undefined))]"),
            "A,B\n,\"\"\n1,\n");
}

TEST(ExchangeValue, geometry_as_a_list_has_every_face) {
  ExchangeSession session({.geometry = Geometry::list});
  const auto faces = nlohmann::json::parse(session.json(std::string("query ") + kUnitCube));
  ASSERT_EQ(faces.size(), 12U);
  double volume = 0;  // six times that of the tetrahedra from the origin
  for (const auto& face : faces) {
    ASSERT_EQ(face.size(), 3U);
    const auto at = [&](int corner, int axis) { return face[corner][axis].get<double>(); };
    volume += at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
              at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
              at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
  }
  EXPECT_EQ(volume / 6, 1.0);
}

TEST(ExchangeValue, fractions_are_texts_or_the_nearest_numbers) {
  const std::string query = "query [const points3d value ((1/3 0 1e300) (-2/3 1 2))]";
  ExchangeSession exact({.geometry = Geometry::list});
  EXPECT_EQ(exact.json(query), "[[\"-2/3\",1.0,2.0],[\"1/3\",0.0,1e+300]]\n");
  ExchangeSession rounded({.geometry = Geometry::list, .rounds_fractions = true});
  EXPECT_EQ(rounded.json(query), "[[-0.6666666666666666,1.0,2.0],[0.3333333333333333,0.0,1e+300]]\n");
  // A text that looks like a fraction stays a text.
  EXPECT_EQ(rounded.json("query '1/3'"), "\"1/3\"\n");
}

TEST(ExchangeValue, files_are_numbered_by_their_attributes) {
  ExchangeSession session({.geometry = Geometry::file, .folder = "meshes", .mesh_ending = "off"});
  ASSERT_EQ(session.run_silently(
                fmt::format("let R = intstream(1, 2) transformstream extend[S: {0}, T: {0}] consume", kUnitCube)),
            "");
  EXPECT_EQ(session.csv("query R"), "Elem,S,T\n1,meshes/S_1.off,meshes/T_1.off\n2,meshes/S_2.off,meshes/T_2.off\n");
  for (const char* name : {"S_1", "S_2", "T_1", "T_2"}) {
    const auto file = session.folder() / "meshes" / (std::string(name) + ".off");
    EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  }
  EXPECT_EQ(session.json("query volume(importOFF('meshes/S_2.off'))"), "1.0\n");
  EXPECT_EQ(session.json(std::string("query ") + kUnitCube), "\"meshes/value_1.off\"\n");
  // Points have no faces and no file.
  EXPECT_EQ(session.json("query [const points3d value ((0 0 0))]"), "[[0.0,0.0,0.0]]\n");
}

TEST(ExchangeValue, a_file_that_cannot_be_written_is_told) {
  ExchangeSession session({.geometry = Geometry::file, .folder = "meshes"});
  std::filesystem::create_directories(session.folder() / "meshes/S_1.obj");
  std::filesystem::create_directories(session.folder() / "meshes/value_1.obj");
  const std::string row = fmt::format("query intstream(1, 1) transformstream extend[S: {}] consume", kUnitCube);
  EXPECT_EQ(session.json(row), "[{\"Elem\":1,\"S\":null}]\n");
  EXPECT_NE(session.notes().find("S_1.obj"), std::string::npos) << session.notes();
  EXPECT_TRUE(session.json(std::string("query ") + kUnitCube).starts_with("error: --geometry-dir: not written: "));
  std::ofstream(session.folder() / "file") << "no folder";
  ExchangeSession blocked({.geometry = Geometry::file, .folder = session.folder() / "file"});
  EXPECT_TRUE(blocked.json(row).ends_with(": Not a directory")) << blocked.json(row);
}

TEST(ExchangeValue, a_nested_relation_is_an_array_and_nothing_for_csv) {
  const std::string query =
      "query [const rel(tuple([A: int, N: arel(tuple([B: string]))])) value ((1 ((\"x\") (\"y\"))) (2 ()))]";
  ExchangeSession session;
  EXPECT_EQ(session.json(query), "[{\"A\":1,\"N\":[{\"B\":\"x\"},{\"B\":\"y\"}]},\n{\"A\":2,\"N\":[]}]\n");
  EXPECT_EQ(session.csv(query),
            "error: csv: 'N' is a nested relation, which CSV does not have; leave it out, `unnest` it, or write JSON");
  ExchangeSession short_session({.most_nested_tuples = 1});
  EXPECT_EQ(short_session.json(query), "[{\"A\":1,\"N\":{\"type\":\"arel\",\"tuples\":2}},\n{\"A\":2,\"N\":[]}]\n");
}

}  // namespace
}  // namespace queries
