#include "queries/transfer/detail/copy_format.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

namespace queries {
namespace {

using namespace std::string_literals;

std::string row_of(const std::vector<std::optional<std::string>>& fields) {
  std::string bytes;
  append_copy_row(bytes, fields);
  return bytes;
}

// The bytes that a server of version 15 sends for (VALUES (1, NULL, '')), of int, text and text.
TEST(copy_format, a_row_is_what_a_server_sends) {
  EXPECT_EQ(row_of({"\0\0\0\1"s, std::nullopt, ""}), "\0\3\0\0\0\4\0\0\0\1\377\377\377\377\0\0\0\0"s);
  EXPECT_EQ(copy_beginning(), "PGCOPY\n\377\r\n\0\0\0\0\0\0\0\0\0"s);
  EXPECT_EQ(copy_end(), "\377\377");
}

TEST(copy_format, rows_are_read_as_they_were_written) {
  CopyReader reader(2);
  const std::string first = std::string(copy_beginning()) + row_of({"a", std::nullopt});
  const auto* fields = *reader.take(first);
  ASSERT_NE(fields, nullptr);
  EXPECT_EQ((*fields)[0], "a");
  EXPECT_EQ((*fields)[1], std::nullopt);
  const std::string second = row_of({std::string(70'000, 'b'), ""});
  fields = *reader.take(second);
  ASSERT_NE(fields, nullptr);
  EXPECT_EQ((*fields)[0]->size(), 70'000U);
  EXPECT_EQ((*fields)[1], "");
  EXPECT_EQ(*reader.take(copy_end()), nullptr);
  EXPECT_FALSE(reader.take(second).ok());
}

TEST(copy_format, a_beginning_may_come_alone) {
  CopyReader reader(1);
  EXPECT_EQ(*reader.take(copy_beginning()), nullptr);
  EXPECT_NE(*reader.take(row_of({"x"})), nullptr);
}

TEST(copy_format, what_is_no_copy_is_refused) {
  const std::string beginning(copy_beginning()), row = row_of({"abc", "d"});
  const auto message_of = [&](const std::string& message) {
    CopyReader reader(2);
    const auto taken = reader.take(message);
    return taken ? "" : taken.error().message;
  };
  EXPECT_EQ(message_of(beginning + row), "");
  EXPECT_NE(message_of("PGCOPX" + (beginning + row).substr(6)).find("another signature"), std::string::npos);
  EXPECT_NE(message_of(beginning + row_of({"a"})).find("1 fields, expected 2"), std::string::npos);
  EXPECT_NE(message_of(beginning + row + "z").find("1 bytes behind a row"), std::string::npos);
  EXPECT_NE(message_of(beginning + row.substr(0, row.size() - 1)).find("1 bytes are missing"), std::string::npos);
}

TEST(copy_format, random_changes_are_read_or_refused) {
  std::mt19937 random(7);
  const std::string whole = std::string(copy_beginning()) + row_of({"abc", std::nullopt, std::string(40, 'x')});
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string changed = whole;
    changed[random() % changed.size()] = static_cast<char>(random());
    if (random() % 4 == 0) changed.resize(random() % changed.size());
    CopyReader reader(3);
    refused += reader.take(changed).ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace queries
