// Opening: which files are databases of ours, and what is said of the others.
#include <unistd.h>

#include "queries/store/detail/sqlite_connection.h"
#include "queries/store/detail/tables.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

class StoreFiles : public StoreTest {
 protected:
  void expect_error(const Error& error, ErrorCode code, const std::string& message) {
    EXPECT_EQ(error.code, code) << error.text();
    EXPECT_EQ(error.text(), message);
  }
  std::string name(std::string_view file = "test.db") const { return path(file).string(); }
};

TEST_F(StoreFiles, a_missing_file_or_folder_is_named) {
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_missing,
               name() + ": there is no such file");
  expect_error(open_error(path(), OpenMode::read_only), ErrorCode::database_missing,
               name() + ": there is no such file");
  const fs::path lost = folder_ / "no" / "x.db";
  expect_error(open_error(lost, OpenMode::read_write), ErrorCode::database_missing,
               lost.string() + ": there is no folder '" + lost.parent_path().string() + "'");
  expect_error(open_error(lost, OpenMode::create), ErrorCode::file_missing,
               lost.string() + ": there is no folder '" + lost.parent_path().string() + "'");
}

TEST_F(StoreFiles, create_refuses_a_file_that_is_there) {
  reopen(OpenMode::create);
  store_.reset();
  expect_error(open_error(path(), OpenMode::create), ErrorCode::database_exists, name() + ": the file exists already");
}

TEST_F(StoreFiles, files_of_other_kinds_are_foreign_and_stay_as_they_are) {
  write_bytes(path("a.stl"), "solid a\nendsolid a\n");
  for (const OpenMode mode : {OpenMode::open_or_create, OpenMode::read_write, OpenMode::read_only})
    expect_error(open_error(path("a.stl"), mode), ErrorCode::database_foreign,
                 name("a.stl") + ": not a SQLite file; expected an algebra3d database");
  EXPECT_EQ(bytes(path("a.stl")), "solid a\nendsolid a\n");
  expect_error(open_error(folder_, OpenMode::open_or_create), ErrorCode::database_foreign,
               folder_.string() + ": expected an algebra3d database, found a folder");
  sql("CREATE TABLE t(a)");
  const std::string before = bytes(path());
  expect_error(open_error(path(), OpenMode::open_or_create), ErrorCode::database_foreign,
               name() + ": expected an algebra3d database, found a SQLite database of another program");
  sql("PRAGMA application_id = 16");
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_foreign,
               name() + ": expected an algebra3d database, found a SQLite database of application 0x10");
  EXPECT_EQ(bytes(path()).size(), before.size());
}

TEST_F(StoreFiles, an_empty_file_becomes_a_database_only_when_one_may_be_made) {
  write_bytes(path(), "");
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_foreign,
               name() + ": expected an algebra3d database, found an empty file");
  reopen(OpenMode::create);
  reopen(OpenMode::read_write);
  EXPECT_TRUE(store_->objects()->empty());
}

TEST_F(StoreFiles, a_newer_version_is_refused) {
  reopen();
  store_.reset();
  sql("PRAGMA user_version = 6");
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_version,
               name() + ": the database has version 6, this program reads versions up to 5; use a newer algebra3d");
}

TEST_F(StoreFiles, the_file_has_a_log_and_the_mark_of_algebra3d) {
  reopen();
  EXPECT_EQ(sql("PRAGMA journal_mode"), "wal");
  EXPECT_EQ(sql("PRAGMA application_id"), std::to_string(kApplicationId));
  store_.reset();
  EXPECT_EQ(bytes(path()).substr(68, 4), "A3DB");
}

TEST_F(StoreFiles, names_that_mean_something_to_sqlite_are_names) {
  for (const char* file : {"file:x.db", "a?mode=memory#b%41.db", ":memory:"}) {
    const auto store = Store::open(path(file), OpenMode::create, registry_);
    ASSERT_TRUE(store.ok()) << store.error().text();
    EXPECT_TRUE(fs::exists(path(file)));
  }
}

TEST_F(StoreFiles, reading_only_refuses_every_change) {
  reopen();
  write([&] { let_parts(2); });
  reopen(OpenMode::read_only);
  const auto status = store_->begin(true);
  expect_error(status.error(), ErrorCode::database_read_only, name() + ": the database was opened for reading only");
  ok(store_->begin(false));
  EXPECT_EQ(rows("Parts").size(), 2U);
  expect_error(relation("Parts")->insert(part(1)).error(), ErrorCode::database_read_only,
               name() + ": the database was opened for reading only");
  expect_error(store_->create("x", "int").error(), ErrorCode::database_read_only,
               name() + ": the database was opened for reading only");
  ok(store_->commit());
}

TEST_F(StoreFiles, a_file_and_folder_without_rights_to_write_can_be_read) {
  if (::geteuid() == 0) GTEST_SKIP() << "permissions do not bind the superuser";
  reopen();
  write([&] { let_parts(2); });
  store_.reset();
  fs::permissions(path(), fs::perms::owner_read);
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_read_only,
               name() + ": the file cannot be written; open it with --read-only");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  reopen(OpenMode::read_only);
  read([&] { EXPECT_EQ(rows("Parts").size(), 2U); });
  store_.reset();
  fs::permissions(folder_, fs::perms::owner_all);
  fs::permissions(path(), fs::perms::none);
  EXPECT_EQ(open_error(path(), OpenMode::read_only).code, ErrorCode::file_missing);
}

TEST_F(StoreFiles, an_unchanging_file_is_read_without_any_other_file) {
  reopen();
  write([&] { let_parts(2); });
  store_.reset();
  const auto connection = SqliteConnection::open(path(), SqliteConnection::Access::immutable, 0);
  ASSERT_TRUE(connection.ok()) << connection.error().text();
  EXPECT_EQ(*(*connection)->integer("SELECT object_count FROM meta"), 1);
  EXPECT_FALSE(fs::exists(name() + "-shm"));
}

TEST_F(StoreFiles, a_truncated_file_is_corrupt) {
  reopen();
  write([&] { let_parts(100); });
  store_.reset();
  const std::string whole = bytes(path());
  write_bytes(path(), whole.substr(0, 50));
  expect_error(open_error(path(), OpenMode::read_write), ErrorCode::database_corrupt,
               name() + ": the file ends after 50 bytes, within the header of a database");
  for (const std::size_t size : {std::size_t{100}, std::size_t{4096}, std::size_t{5000}, whole.size() / 2}) {
    write_bytes(path(), whole.substr(0, size));
    const auto store = Store::open(path(), OpenMode::read_write, registry_);
    if (!store) {
      EXPECT_EQ(store.error().code, ErrorCode::database_corrupt) << size << " " << store.error().text();
      continue;
    }
    ok((*store)->begin(false));
    const auto datum = (*store)->read("Parts");
    ASSERT_TRUE(datum.ok());
    auto stream = *datum->relation()->scan();
    auto next = stream->next();
    while (next && *next != nullptr) next = stream->next();
    ASSERT_FALSE(next.ok()) << size;
    EXPECT_EQ(next.error().code, ErrorCode::database_corrupt) << size << " " << next.error().text();
  }
}

}  // namespace
}  // namespace queries
