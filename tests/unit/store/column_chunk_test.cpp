// Column chunks: what is encoded is read back, and other bytes are refused.
#include <random>

#include "queries/store/detail/chunk_builder.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class ColumnChunks : public StoreTest {
 protected:
  AttributeColumns attribute(const std::string& type_name) {
    const auto layout = RelationLayout::make(registry_, type("(tuple ((A " + type_name + ")))"), "R", 1);
    EXPECT_TRUE(layout.ok());
    return (*layout)->attributes()[0];
  }
  static std::string encoded(const AttributeColumns& attribute, const std::vector<Value>& values) {
    ChunkBuilder builder(attribute);
    for (const Value& each : values) ok(builder.add(each));
    return builder.encode().bytes;
  }
  /// Encodes the values, reads them back one by one and as columns, and gives the bytes per value.
  std::size_t expect_kept(const std::string& type_name, const std::vector<std::string>& texts) {
    const AttributeColumns columns = attribute(type_name);
    ChunkBuilder builder(columns);
    std::vector<Value> values;
    for (const std::string& each : texts) values.push_back(value(type_name, each));
    for (const Value& each : values) ok(builder.add(each));
    const EncodedChunk chunk = builder.encode();
    const auto parsed = ColumnChunk::parse(columns, chunk.bytes, values.size());
    EXPECT_TRUE(parsed.ok()) << (parsed ? "" : parsed.error().text());
    if (!parsed) return 0;
    EXPECT_TRUE((*parsed)->audit(chunk.range).ok());
    for (std::size_t row = 0; row < values.size(); ++row) {
      EXPECT_EQ(text(*(*parsed)->value(row)), text(values[row])) << type_name << " " << row;
      EXPECT_EQ(text(*builder.value(row)), text(values[row])) << type_name << " " << row;
    }
    const std::size_t first = values.size() / 3;
    const std::size_t count = values.size() - first;
    algebra3d::ValueColumn column(*columns.type);
    column.restart(count);
    ok((*parsed)->read(first, count, column));
    for (std::size_t row = 0; row < count; ++row) EXPECT_EQ(text(column.value(row)), text(values[first + row]));
    // From a column to a chunk again.
    ChunkBuilder again(columns);
    ok(again.add(column, {nullptr, count}));
    for (std::size_t row = 0; row < count; ++row) EXPECT_EQ(text(*again.value(row)), text(values[first + row]));
    return chunk.bytes.size() / values.size();
  }
};

std::vector<std::string> repeated(const std::vector<std::string>& texts, int times) {
  std::vector<std::string> result;
  for (int i = 0; i < times; ++i) result.insert(result.end(), texts.begin(), texts.end());
  return result;
}

TEST_F(ColumnChunks, values_of_each_type_are_kept) {
  const std::string least = std::to_string(INT64_MIN);
  const std::string greatest = std::to_string(INT64_MAX);
  expect_kept("int", {least, greatest, "0", "-1", "undefined"});
  expect_kept("int", {"undefined", "undefined"});
  expect_kept("int", {"7"});
  expect_kept("bool", {"TRUE", "FALSE", "undefined", "TRUE"});
  expect_kept("bool", {"TRUE", "TRUE"});
  expect_kept("real", {"-0.0", "0.0", "1e308", "-1e-308", "undefined"});
  expect_kept("string", {"\"\"", "\"a\"", "undefined", "\"\xc3\xa4\xc3\xb6\""});
  expect_kept("string", {"undefined"});
  expect_kept("text", {"<text>some words</text--->", "undefined"});
  expect_kept("point3d", {"(1 2 3)", "(0.1 0.2 0.3)", "undefined", "(1/3 0 0)"});
  expect_kept("rect3", {"(0 1 0 1 0 1)", "undefined", "(2 3 2 3 2 3)"});
  expect_kept("instant", {"\"2003-01-10-12:59\"", "undefined"});
}

TEST_F(ColumnChunks, they_are_short) {
  EXPECT_LE(expect_kept("int", repeated({"1", "100", "250", "17"}, 500)), 1U);
  EXPECT_LE(expect_kept("int", repeated({"1", "1000", "-250", "17"}, 500)), 2U);
  EXPECT_LE(expect_kept("real", repeated({"1.5", "1000.25"}, 500)), 8U);
  EXPECT_LE(expect_kept("string", repeated({"\"north\"", "\"south\"", "\"east\""}, 500)), 1U);
  EXPECT_LE(expect_kept("point3d", repeated({"(1 2 3)", "(0.5 0.25 0)"}, 500)), 26U);
}

TEST_F(ColumnChunks, least_and_greatest_are_those_of_the_defined_values) {
  const AttributeColumns columns = attribute("int");
  ChunkBuilder builder(columns);
  EXPECT_FALSE(builder.encode().range.is_known);
  for (const char* each : {"undefined", "5", "-3", "9"}) ok(builder.add(value("int", each)));
  const EncodedChunk chunk = builder.encode();
  EXPECT_EQ(static_cast<std::int64_t>(chunk.range.least), -3);
  EXPECT_EQ(static_cast<std::int64_t>(chunk.range.greatest), 9);
  const auto parsed = ColumnChunk::parse(columns, chunk.bytes, 4);
  ValueRange wrong = chunk.range;
  wrong.greatest = 8;
  EXPECT_EQ((*parsed)->audit(wrong).error().text(),
            "the least and the greatest value are not those of the column chunk");
}

// A chunk has a checksum; without one, no byte may make a reader read elsewhere.
TEST_F(ColumnChunks, any_bytes_are_refused_or_read) {
  std::mt19937 random(7);
  const std::vector<std::pair<std::string, std::vector<std::string>>> examples = {
      {"int", {"1", "300", "undefined", "70000"}},
      {"bool", {"TRUE", "undefined", "FALSE"}},
      {"real", {"1.5", "undefined"}},
      {"string", {"\"a\"", "\"bcd\"", "undefined"}},
      {"string", repeated({"\"north\"", "\"south\""}, 20)},
      {"point3d", {"(1 2 3)", "(4 5 6)"}}};
  for (const auto& [type_name, texts] : examples) {
    const AttributeColumns columns = attribute(type_name);
    std::vector<Value> values;
    for (const std::string& each : texts) values.push_back(value(type_name, each));
    const std::string right = encoded(columns, values);
    for (int turn = 0; turn < 2000; ++turn) {
      std::string bytes = right;
      for (int i = 0; i < 3; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
      if (turn % 3 == 0) bytes.resize(random() % (bytes.size() + 4));
      const auto parsed = ColumnChunk::parse(columns, bytes, values.size());
      if (!parsed) {
        EXPECT_EQ(parsed.error().text(), "the column chunk does not have the form of one");
        continue;
      }
      algebra3d::ValueColumn column(*columns.type);
      column.restart(values.size());
      static_cast<void>((*parsed)->read(0, values.size(), column));
      for (std::size_t row = 0; row < values.size(); ++row) static_cast<void>((*parsed)->value(row));
    }
  }
}

}  // namespace
}  // namespace queries
