// Whole results as JSON and CSV.
#include <fstream>

#include <nlohmann/json.hpp>

#include "unit/exchange/exchange_session.h"

namespace queries {
namespace {

constexpr const char* kParts =
    "query [const rel(tuple([Name: string, No: int])) value ((\"bolt\" 1) (\"nut, small\" 2))]";
constexpr const char* kNoParts = "query [const rel(tuple([Name: string, No: int])) value ()]";

TEST(JsonResult, a_relation_is_one_array) {
  ExchangeSession session;
  EXPECT_EQ(session.json(kParts), "[{\"Name\":\"bolt\",\"No\":1},\n{\"Name\":\"nut, small\",\"No\":2}]\n");
  EXPECT_EQ(session.json(kNoParts), "[]\n");
}

TEST(JsonResult, as_lines_it_has_an_object_in_each) {
  ExchangeSession session;
  EXPECT_EQ(session.lines(kParts), "{\"Name\":\"bolt\",\"No\":1}\n{\"Name\":\"nut, small\",\"No\":2}\n");
  EXPECT_EQ(session.lines(kNoParts), "");
  EXPECT_EQ(session.lines("query 5"), "5\n");
}

TEST(CsvResult, a_relation_has_a_line_of_names) {
  ExchangeSession session;
  EXPECT_EQ(session.csv(kParts), "Name,No\nbolt,1\n\"nut, small\",2\n");
  EXPECT_EQ(session.csv(kNoParts), "Name,No\n");
  ExchangeSession bare({.has_header = false});
  EXPECT_EQ(bare.csv(kParts), "bolt,1\n\"nut, small\",2\n");
  EXPECT_EQ(bare.csv(kNoParts), "");
}

// More than the buffer takes, so that it is written in parts.
TEST(Results, long_ones_are_whole) {
  ExchangeSession session;
  const std::string query = "query intstream(1, 40000) transformstream consume";
  const auto rows = nlohmann::json::parse(session.json(query));
  ASSERT_EQ(rows.size(), 40000U);
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(rows[i]["Elem"], i + 1);
  std::string expected = "Elem\n";
  for (int i = 1; i <= 40000; ++i) expected += std::to_string(i) + "\n";
  EXPECT_EQ(session.csv(query), expected);
  ASSERT_GT(expected.size(), 2 * kBytesAtOnce);
}

// What came before an error is shown, and cannot be taken for all.
TEST(Results, an_error_in_the_middle_leaves_them_unfinished) {
  ExchangeSession session({.geometry = ExchangeOptions::Geometry::file, .folder = "meshes"});
  ASSERT_EQ(session.run_silently("let R = [const rel(tuple([A: int, N: arel(tuple([B: int]))])) value ((1 ((1))))]"),
            "");
  const std::string csv = session.csv("query R");
  EXPECT_TRUE(csv.starts_with("error: ")) << csv;
  const std::string failing =
      "query intstream(1, 3) transformstream extend[B: tostring(.Elem)] filter[.Elem / ifthenelse(.Elem < 3, 1, 0) > "
      "0] consume";
  const std::string json = session.json(failing);
  EXPECT_TRUE(json.find("error: ") != std::string::npos || json.find("\"Elem\":3") == std::string::npos) << json;
}

TEST(Results, other_values_have_their_notation) {
  ExchangeSession session;
  ASSERT_EQ(session.run_silently("let f = fun(x: int) x + 1"), "");
  EXPECT_EQ(session.json("query f"), "\"(fun (x int) (+ x 1))\"\n");
  EXPECT_EQ(session.csv("query f"), "(fun (x int) (+ x 1))\n");
  EXPECT_EQ(session.json("let g = 5"), "") << "a command without a value";
}

TEST(Results, inquiries_are_relations) {
  ExchangeSession session;
  ASSERT_EQ(session.run_silently("let Word = \"a, b\""), "");
  EXPECT_EQ(session.csv("list databases"), "Name\nd\n");
  EXPECT_EQ(session.json("list databases"), "[{\"Name\":\"d\"}]\n");
  EXPECT_EQ(session.lines("list databases"), "{\"Name\":\"d\"}\n");
}

// Both formats are read back by this program: the same tuples.
TEST(Results, importers_read_back_what_was_written) {
  ExchangeSession session;
  const std::string relation =
      "[const rel(tuple([S: string, T: text, R: real, B: bool, I: int])) value ((\"a 'b' , c\" 'x' 0.1 TRUE 1) "
      "(\" edge \" '' -1e-300 FALSE -9223372036854775808) (\"\" 'caf\u00e9' 1e300 undefined 0))]";
  ASSERT_EQ(session.run_silently("let R = " + relation), "") << relation;
  std::ofstream(session.folder() / "r.csv") << session.csv("query R");
  std::ofstream(session.folder() / "r.json") << session.json("query R");
  for (const char* reader : {"importCSV('r.csv', R)", "importJSON('r.json', R)"})
    EXPECT_EQ(session.json(fmt::format("query {} consume", reader)), session.json("query R")) << reader;
}

}  // namespace
}  // namespace queries
