// Checksums of pages: what they notice, and files without them. Random damage: tests/crash/page_checksums_test.
#include "queries/store/detail/database_file.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

constexpr std::size_t kPageBytes = 4096;

class PageChecksums : public StoreTest {
 protected:
  void let_everything() {
    reopen();
    write([&] {
      let_parts(200);
      let_index("I", "Parts", "Solid", "volume3d");
    });
    store_.reset();
  }
  /// Number of the first page of the relation's table.
  std::uint32_t root() {
    return static_cast<std::uint32_t>(
        std::stoul(sql("SELECT rootpage FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'")));
  }
  std::string wrong_page(std::uint32_t number) const {
    return fmt::format(
        "{}: page {} is not what algebra3d has written: its checksum is wrong; bytes of the file were changed, or "
        "another program has written to it; use a saved copy, or run check database to see what is not damaged",
        path().string(), number);
  }
  Error scan_error() {
    reopen(OpenMode::read_only);
    Error error{ErrorCode::internal, "no error"};
    read([&] {
      const auto stream = *relation("Parts")->scan();
      auto next = stream->next();
      while (next && *next != nullptr) next = stream->next();
      if (!next) error = next.error();
    });
    store_.reset();
    return error;
  }
};

TEST(PageSums, depend_on_bytes_and_number) {
  std::string content(kPageBytes, 'x');
  const auto page = std::as_writable_bytes(std::span(content.data(), content.size()));
  set_page_sum(page, 7);
  EXPECT_TRUE(has_page_sum(page, 7));
  EXPECT_FALSE(has_page_sum(page, 8));
  for (const std::size_t place :
       {std::size_t{0}, std::size_t{30}, std::size_t{4087}, std::size_t{4088}, kPageBytes - 1}) {
    page[place] ^= std::byte{1};
    EXPECT_FALSE(has_page_sum(page, 7)) << place;
    page[place] ^= std::byte{1};
  }
  EXPECT_TRUE(has_page_sum(page, 7));
}

// SQLite's backup changes these, and its journal mode.
TEST(PageSums, of_page_1_do_not_count_some_bytes_of_the_header) {
  std::string content(kPageBytes, 'x');
  const auto page = std::as_writable_bytes(std::span(content.data(), content.size()));
  set_page_sum(page, 1);
  std::string uncounted;
  for (std::size_t place = 0; place < 120; ++place) {
    page[place] ^= std::byte{1};
    if (has_page_sum(page, 1)) uncounted += fmt::format("{} ", place);
    page[place] ^= std::byte{1};
  }
  EXPECT_EQ(uncounted, "18 19 24 25 26 27 40 41 42 43 68 69 70 71 92 93 94 95 96 97 98 99 ");
}

TEST_F(PageChecksums, each_page_of_a_database_has_one) {
  let_everything();
  const std::string content = bytes(path());
  EXPECT_EQ(content[20], 8);
  EXPECT_EQ(stamped(content), content);
  EXPECT_EQ(sql("PRAGMA user_version"), "5");
}

TEST_F(PageChecksums, a_flipped_bit_is_told_with_the_number_of_its_page) {
  let_everything();
  const std::uint32_t number = root();
  std::string content = bytes(path());
  content[(number - 1) * kPageBytes + 4000] ^= 1;
  write_bytes(path(), content);
  const Error error = scan_error();
  EXPECT_EQ(error.code, ErrorCode::database_corrupt);
  EXPECT_EQ(error.text(), wrong_page(number));
}

TEST_F(PageChecksums, what_another_program_writes_is_told) {
  let_everything();
  foreign_sql("DELETE FROM " + foreign_sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'") +
              " WHERE id = 100");
  EXPECT_NE(scan_error().message.find("its checksum is wrong"), std::string::npos);
}

TEST_F(PageChecksums, another_program_can_copy_the_file_and_change_its_journal_mode) {
  let_everything();
  foreign_sql("PRAGMA journal_mode = DELETE");
  EXPECT_EQ(scan_error().message, "no error");
  reopen(OpenMode::read_write);
  write([&] { ok(store_->create("x", "int")); });
  EXPECT_EQ(sql("PRAGMA journal_mode"), "wal");
  store_.reset();
  EXPECT_EQ(stamped(bytes(path())), bytes(path()));
}

TEST_F(PageChecksums, a_header_that_contradicts_the_pages_is_told_in_words) {
  let_everything();
  const std::string whole = bytes(path());
  constexpr std::size_t kLastByteOfVersion = 63, kReservedBytes = 20;
  std::string content = whole;
  content[kLastByteOfVersion] = 3;
  write_bytes(path(), stamped(content));
  EXPECT_EQ(open_error(path(), OpenMode::read_only).text(),
            path().string() +
                ": the header says that the database has version 3, but its pages have room for checksums, "
                "unlike those of that version; the header was changed");
  content = whole;
  content[kReservedBytes] = 0;
  write_bytes(path(), stamped(content));
  EXPECT_EQ(open_error(path(), OpenMode::read_only).text(),
            path().string() +
                ": the header says that the database has version 5, but its pages have no room for "
                "checksums, unlike those of that version; the header was changed");
}

// A file of version 3, made of one of version 1, and marked as one of version 2.
TEST_F(PageChecksums, a_version_that_contradicts_the_tables_is_told_in_words) {
  std::filesystem::copy_file(std::filesystem::path(ALGEBRA3D_SOURCE) / "tests/unit/store/data/version1.database",
                             path());
  reopen(OpenMode::read_write);
  store_.reset();
  sql("PRAGMA user_version = 2");
  EXPECT_EQ(open_error(path(), OpenMode::read_write).text(),
            path().string() +
                ": the header says that the database has version 2, but it has the table index_pages, which "
                "came with version 3; the header was changed");
}

// Nothing proves that what another process has written behind is a page of ours, so nothing is written behind it.
TEST_F(PageChecksums, nothing_is_written_behind_a_page_of_another_program) {
  let_everything();
  reopen(OpenMode::read_write);
  write([&] { ok(store_->create("x", "int")); });
  foreign_sql("UPDATE " + foreign_sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'") +
              " SET a1_No = -1 WHERE id = 100");
  ok(store_->begin(true));
  ok(store_->create("y", "int"));
  const Status status = store_->commit();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().text().find("in the log (-wal) is not what algebra3d has written"), std::string::npos)
      << status.error().text();
}

}  // namespace
}  // namespace queries
