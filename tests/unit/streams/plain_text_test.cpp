// What texts from outside mean, and how files of them are cut into records.
#include "queries/streams/plain_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "queries/streams/detail/csv_reader.h"
#include "queries/streams/detail/import_columns.h"
#include "queries/streams/detail/json_records.h"

namespace queries {
namespace {

TEST(PlainText, kinds) {
  for (const char* text : {"TRUE", "false", " True "}) EXPECT_EQ(plain_kind(text), PlainKind::boolean) << text;
  for (const char* text : {"0", "-1", "2147483647", " 12\t"}) EXPECT_EQ(plain_kind(text), PlainKind::integer) << text;
  for (const char* text : {"1.5", ".5", "5.", "-0", "1e5", "-2E-3", "0.0"})
    EXPECT_EQ(plain_kind(text), PlainKind::real) << text;
  for (const char* text : {"", "007", "00.5", "+5", "1e", "e5", ".", "-", "1,5", "1e400", "0x10", "nan", "inf", "1 2",
                           "yes", "99999999999999999999999"})
    EXPECT_EQ(plain_kind(text), PlainKind::text) << text;
}

TEST(PlainText, names_of_attributes) {
  const std::vector<std::string> names = {"Name", "Unit price (€)", "2nd", "", "Name", "a--b", "Name_2", "_x"};
  const std::vector<std::string> expected = {"Name",   "Unit_price", "C_2nd",    "Column4",
                                             "Name_2", "a_b",        "Name_2_2", "_x"};
  EXPECT_EQ(attribute_names_of(names), expected);
}

TEST(PlainText, options) {
  const auto options = split_options(" separator=;; header = no;skip=2; separator= ");
  ASSERT_TRUE(options.ok());
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"separator", ";"}, {"header", "no"}, {"skip", "2"}, {"separator", " "}};
  EXPECT_EQ(*options, expected);
  EXPECT_TRUE(split_options("")->empty());
  EXPECT_FALSE(split_options("header").ok());
}

/// A file with some text, as long as the test runs.
class Records : public testing::Test {
 protected:
  ~Records() override { std::filesystem::remove(path_); }
  TextFile file(const std::string& content) {
    std::ofstream(path_, std::ios::binary) << content;
    return *TextFile::open(path_);
  }
  std::string csv(const std::string& content) {
    CsvReader reader(file(content), ',');
    CsvRecord record;
    std::string text;
    while (true) {
      const auto more = reader.next(record);
      if (!more) return text + more.error().text();
      if (!*more) return text;
      text += std::to_string(record.line) + ":";
      for (const CsvCell& cell : record.cells) text += (cell.is_quoted ? "q[" : "[") + cell.text + "]";
      text += " ";
    }
  }
  std::string json(const std::string& content, std::vector<std::string> path = {}) {
    JsonRecords records(file(content), std::move(path));
    JsonRecord record;
    std::string text;
    while (true) {
      const auto more = records.next(record);
      if (!more) return text + more.error().text();
      if (!*more) return text;
      text += std::to_string(record.line) + ":" + record.text + " ";
    }
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("algebra3d-records-" + std::to_string(getpid()));
};

TEST_F(Records, of_csv) {
  EXPECT_EQ(csv(""), "");
  EXPECT_EQ(csv("a,b\r\n\"c\nd\",\"\"\"\"\n\n,"), "1:[a][b] 2:q[c\nd]q[\"] 4:[] 5:[][] ");
  EXPECT_EQ(csv("a\rb"), "1:[a] 2:[b] ");
  EXPECT_EQ(csv("\xef\xbb\xbf\"\""), "1:q[] ");
  EXPECT_EQ(csv("a\"b\""), "1:[a\"b\"] ");
  EXPECT_EQ(csv("a\n\"b"), "1:[a] line 2, column 1: the quote that begins the cell is not closed");
}

TEST_F(Records, of_json) {
  EXPECT_EQ(json(""), "");
  EXPECT_EQ(json("[]"), "");
  EXPECT_EQ(json("[1, \"a]\\\"\",\n{\"b\": [{}]}, null]"), "1:1 1:\"a]\\\"\" 2:{\"b\": [{}]} 2:null ");
  EXPECT_EQ(json("{\"a\": 1}\n\n{\"a\": 2} 3"), "1:{\"a\": 1} 3:{\"a\": 2} 3:3 ");
  EXPECT_EQ(json("{\"x\": [1], \"a\": {\"b\": [7, 8], \"c\": 0}}", {"a", "b"}), "1:7 1:8 ");
  EXPECT_EQ(json("[1 2]"), "1:1 line 1: expected ',' or ']', found '2'");
  EXPECT_EQ(json("[1,]"), "1:1 line 1: expected a value, found ']'");
  EXPECT_EQ(json("[1"), "1:1 line 1: expected ',' or ']', found the end of the file");
  EXPECT_EQ(json("{\"a\": \"b"), "line 1: the string that begins here is not closed");
  EXPECT_EQ(json("{\"a\": 5}", {"a"}), "line 1: expected an array as \"a\", found '5'");
  EXPECT_EQ(json("{\"b\": 5}", {"a"}), "line 1: expected the member \"a\", found '}'");
}

}  // namespace
}  // namespace queries
