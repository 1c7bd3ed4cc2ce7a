// A database of somebody else, with what may have come with it: opening it does nothing beside it.
#include <sys/stat.h>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

class ForeignFiles : public StoreTest {
 protected:
  ForeignFiles() {
    std::ofstream(victim()) << "somebody's file";
    reopen();
    write([&] {
      ok(store_->create("x", "int"));
      ok(store_->assign("x", Datum{Value::of(std::int64_t{7})}, context_));
    });
    store_.reset();
  }
  fs::path victim() const { return path("victim"); }
  fs::path beside(const char* ending) const { return path().string() + ending; }

  static void append_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  }
  // A rollback journal without pages that says that it belongs to several databases: SQLite's file format, section 3,
  // with the name of their common journal behind it.
  std::string journal_with(const std::string& name) const {
    constexpr std::string_view kMagic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
    constexpr std::uint32_t kPageBytes = 4096;
    std::string bytes(kMagic);
    for (const std::uint32_t number :
         {0U, 12345U, static_cast<std::uint32_t>(fs::file_size(path()) / kPageBytes), 512U, kPageBytes})
      append_number(bytes, number);
    bytes.resize(512);
    if (name.empty()) return bytes;
    std::uint32_t sum = 0;
    for (const char c : name) sum += static_cast<unsigned char>(c);
    append_number(bytes, 0x40000000 / kPageBytes + 1);
    bytes += name;
    append_number(bytes, static_cast<std::uint32_t>(name.size()));
    append_number(bytes, sum);
    return bytes.append(kMagic);
  }
};

// SQLite would roll it back, and then delete the file that it names.
TEST_F(ForeignFiles, a_journal_that_names_another_file_is_refused) {
  std::ofstream(beside("-journal"), std::ios::binary) << journal_with(victim());
  for (const OpenMode mode :
       {OpenMode::read_write, OpenMode::open_or_create, OpenMode::read_only, OpenMode::read_damaged}) {
    const Error error = open_error(path(), mode);
    EXPECT_EQ(error.code, ErrorCode::database_foreign);
    EXPECT_TRUE(error.text().starts_with(beside("-journal").string() + ": the journal names another file"))
        << error.text();
    EXPECT_TRUE(fs::exists(victim()));
  }
  fs::remove(beside("-journal"));
  reopen();
  read([&] { EXPECT_EQ(text(store_->read("x")->value()), "7"); });
}

// What SQLite does with the same journal through its own interface, or the test above shows nothing.
TEST_F(ForeignFiles, sqlite_alone_deletes_that_file) {
  std::ofstream(beside("-journal"), std::ios::binary) << journal_with(victim());
  sql("SELECT count(*) FROM sqlite_schema");
  EXPECT_FALSE(fs::exists(victim()));
}

TEST_F(ForeignFiles, a_journal_of_its_own_is_rolled_back_as_ever) {
  std::ofstream(beside("-journal"), std::ios::binary) << journal_with("");
  reopen();
  read([&] { EXPECT_EQ(text(store_->read("x")->value()), "7"); });
}

// A pipe would never end.
TEST_F(ForeignFiles, links_pipes_and_folders_beside_it_are_refused) {
  for (const char* ending : {"-wal", "-shm", "-journal"}) {
    const fs::path file = beside(ending);
    for (const auto& make : {+[](const fs::path& name) { fs::create_symlink("victim", name); },
                             +[](const fs::path& name) { ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0); },
                             +[](const fs::path& name) { fs::create_directory(name); }}) {
      fs::remove(file);
      make(file);
      for (const OpenMode mode : {OpenMode::read_write, OpenMode::read_only}) {
        const Error error = open_error(path(), mode);
        EXPECT_EQ(error.code, ErrorCode::database_foreign);
        EXPECT_EQ(error.text(),
                  file.string() + ": not a regular file, as SQLite's files beside a database are; remove it");
      }
    }
    fs::remove(file);
  }
  EXPECT_EQ(fs::file_size(victim()), 15U);
}

// They would run with every change.
TEST_F(ForeignFiles, triggers_and_views_of_the_schema_do_nothing) {
  reopen();
  write([&] { let_relation("R", "(tuple ((A int)))", {tuple({{"int", "1"}})}); });
  store_.reset();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("CREATE TABLE caught (A)");
  sql("CREATE TRIGGER t AFTER INSERT ON " + table + " BEGIN INSERT INTO caught VALUES (1); END");
  reopen();
  write([&] { EXPECT_TRUE(relation("R")->insert(tuple({{"int", "2"}})).ok()); });
  read([&] { EXPECT_EQ(rows("R"), (std::vector<std::string>{"1", "2"})); });
  store_.reset();
  EXPECT_EQ(sql("SELECT count(*) FROM caught"), "0");
}

}  // namespace
}  // namespace queries
