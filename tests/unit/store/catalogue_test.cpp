// Derived objects, named types, other names, objects that are given up; files of the version before.
#include "queries/store/detail/tables.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

class StoredCatalogue : public StoreTest {
 protected:
  StoredCatalogue() { reopen(); }

  void let_number(const std::string& name, int value) {
    ok(store_->create(name, "int"));
    ok(store_->assign(name, Datum{Value::of(std::int64_t{value})}, context_));
  }
  std::string table_of(const std::string& relation) {
    return sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_" + relation + "'");
  }
  static void expect_error(const Status& status, ErrorCode code, const std::string& message) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, code);
    EXPECT_EQ(status.error().text(), message);
  }
};

TEST_F(StoredCatalogue, a_derived_object_keeps_its_expression_and_its_value) {
  write([&] {
    ok(store_->create_derived("d", "int", "x + 1"));
    ok(store_->assign("d", Datum{Value::of(std::int64_t{8})}, context_));
    let_number("x", 7);
  });
  reopen();
  const auto info = store_->find("d");
  ASSERT_TRUE(info->has_value());
  EXPECT_EQ((*info)->derived_text, "x + 1");
  EXPECT_TRUE((*info)->has_value);
  EXPECT_EQ((*store_->find("x"))->derived_text, "");
  EXPECT_EQ((*store_->objects())[0].derived_text, "x + 1");
  read([&] { EXPECT_EQ(text(store_->read("d")->value()), "8"); });
}

TEST_F(StoredCatalogue, named_types_are_kept_listed_and_removed) {
  const TypeExpr parts = type("(rel (tuple ((No int) (Solid volume3d))))");
  write([&] {
    ok(store_->create_type("parts", parts));
    ok(store_->create_type("length", "real"));
    ok(store_->create("parts", "int"));
  });
  reopen();
  ASSERT_EQ(store_->types()->size(), 2U);
  EXPECT_EQ((*store_->types())[0].name, "length");
  EXPECT_EQ((*store_->types())[1].type, parts);
  EXPECT_EQ(*store_->find_type("parts"), parts);
  EXPECT_FALSE(store_->find_type("Parts")->has_value());
  write([&] {
    expect_error(store_->create_type("length", "int"), ErrorCode::name_exists, "there is a type 'length' already");
    ok(store_->remove_type("length"));
    expect_error(store_->remove_type("length"), ErrorCode::unknown_name, "there is no type 'length'");
  });
  reopen();
  EXPECT_EQ(store_->types()->size(), 1U);
}

TEST_F(StoredCatalogue, types_that_were_changed_or_lost_in_the_file_are_missed) {
  write([&] { ok(store_->create_type("length", "real")); });
  store_.reset();
  sql("UPDATE named_types SET type = 'int'");
  EXPECT_EQ(open_error(path(), OpenMode::read_write).text(),
            path().string() + ": the catalogue's row of the type 'length' is not what was written");
  sql("DELETE FROM named_types");
  EXPECT_EQ(open_error(path(), OpenMode::read_write).text(),
            path().string() + ": the catalogue is not what was written: objects are missing or there are too many");
}

TEST_F(StoredCatalogue, a_relation_under_another_name_keeps_tuples_indexes_and_imported_files) {
  const Store::ImportedFile file{"a.stl", 84, 1};
  write([&] {
    let_parts(3);
    let_index("I", "Parts", "Solid", "volume3d");
    ok(store_->remember_imported("Parts", file));
  });
  read([&] { EXPECT_EQ(*index("I")->size(), 3U); });
  write([&] { ok(store_->rename("Parts", "Teile")); });
  for (int round = 0; round < 2; ++round) {
    EXPECT_FALSE(store_->find("Parts")->has_value());
    read([&] {
      EXPECT_EQ(rows("Teile").size(), 3U);
      EXPECT_EQ(index("I")->relation(), "Teile");
      EXPECT_EQ(*index("I")->size(), 3U);
    });
    EXPECT_TRUE(*store_->is_imported("Teile", file));
    EXPECT_EQ(table_of("Teile").substr(0, 4), "rel_");
    reopen();
  }
  write([&] {
    EXPECT_EQ(*relation("Teile")->insert(part(7)), 4);
    EXPECT_EQ(*index("I")->size(), 4U);
    ok(store_->remove("Teile"));
  });
  EXPECT_TRUE(store_->objects()->empty());
  EXPECT_EQ(table_of("Teile"), "");
}

TEST_F(StoredCatalogue, names_may_differ_in_case_only_and_be_exchanged) {
  write([&] {
    let_parts(2);
    let_number("a", 1);
    let_number("b", 2);
  });
  write([&] {
    ok(store_->rename("Parts", "pARTS"));
    ok(store_->rename("a", "t"));
    ok(store_->rename("b", "a"));
    ok(store_->rename("t", "b"));
  });
  reopen();
  read([&] {
    EXPECT_EQ(rows("pARTS").size(), 2U);
    EXPECT_EQ(text(store_->read("a")->value()), "2");
    EXPECT_EQ(text(store_->read("b")->value()), "1");
  });
}

TEST_F(StoredCatalogue, a_name_that_is_taken_or_unknown_is_refused) {
  write([&] {
    let_number("a", 1);
    let_number("b", 2);
    expect_error(store_->rename("a", "b"), ErrorCode::name_exists, "there is an object 'b' already");
    expect_error(store_->rename("c", "d"), ErrorCode::unknown_name, "there is no object 'c'");
    expect_error(store_->kill("c"), ErrorCode::unknown_name, "there is no object 'c'");
  });
}

TEST_F(StoredCatalogue, geometry_of_a_relation_that_is_renamed_meanwhile_is_an_error_not_wrong) {
  write([&] { let_parts(2); });
  read([&] {
    const TuplePtr early = *relation("Parts")->fetch(1);
    ok(store_->rename("Parts", "Teile"));
    EXPECT_EQ(early->attributes[1].loaded().error().code, ErrorCode::wrong_usage);
    EXPECT_EQ(text(**relation("Teile")->fetch(1)), text(part(0)));
    EXPECT_EQ(rows("Teile").size(), 2U);
  });
}

TEST_F(StoredCatalogue, what_is_killed_is_gone_with_its_rows_and_indexes_if_they_are_sound) {
  write([&] {
    let_parts(3);
    let_index("I", "Parts", "Solid", "volume3d");
    let_number("x", 1);
  });
  write([&] {
    ok(store_->kill("Parts"));
    ok(store_->kill("x"));
  });
  EXPECT_TRUE(store_->objects()->empty());
  EXPECT_EQ(table_of("Parts"), "");
  EXPECT_EQ(sql("SELECT count(*) FROM object_values"), "0");
  EXPECT_EQ(sql("SELECT count(*) FROM abandoned"), "0");
}

TEST_F(StoredCatalogue, a_damaged_value_can_be_killed) {
  write([&] {
    let_parts(300);
    let_number("x", 1);
    ok(store_->create("v", "volume3d"));
    ok(store_->assign("v", Datum{value("volume3d", solid(1))}, context_));
  });
  const std::string root = sql("SELECT rootpage FROM sqlite_schema WHERE name = '" + table_of("Parts") + "'");
  store_.reset();
  sql("UPDATE object_values SET value = x'00' WHERE id = (SELECT id FROM catalogue WHERE name = 'v')");
  const auto page_bytes = std::stoul(sql("PRAGMA page_size"));
  std::string content = bytes(path());
  content.replace((std::stoul(root) - 1) * page_bytes, page_bytes, page_bytes, '\xff');
  write_bytes(path(), content);
  reopen();
  ok(store_->begin(true));
  EXPECT_FALSE((*store_->read("Parts")->relation()->scan())->next().ok());
  EXPECT_FALSE(store_->read("v").ok());
  EXPECT_FALSE(store_->remove("Parts") && store_->commit());
  store_->rollback();
  write([&] {
    ok(store_->kill("Parts"));
    ok(store_->kill("v"));
  });
  reopen();
  ASSERT_EQ(store_->objects()->size(), 1U);
  EXPECT_EQ(sql("SELECT group_concat(name) FROM abandoned"), "Parts,v");
  write([&] { let_parts(2); });
  read([&] {
    EXPECT_EQ(rows("Parts").size(), 2U);
    EXPECT_EQ(text(store_->read("x")->value()), "1");
  });
}

// data/version1.database was written by the program as it was when version 1 was the present one:
//   let Parts = [const rel(tuple([No: int, Name: string, Solid: volume3d])) value ((1 "one" (a tetrahedron)) (2 "two"
//   undefined))]; let Parts_Solid = Parts creatertree[Solid]; let f = fun(x: int) x + 1; let v = 42; create w : real;
class OlderVersion : public StoreTest {
 protected:
  OlderVersion() { fs::copy_file(fs::path(ALGEBRA3D_SOURCE) / "tests/unit/store/data/version1.database", path()); }

  void expect_contents() {
    std::string names;
    const auto objects = store_->objects();
    for (const ObjectInfo& info : *objects) names += info.name + " ";
    EXPECT_EQ(names, "Parts Parts_Solid f v w ");
    EXPECT_EQ((*store_->find("f"))->function_text, "fun(x: int) x + 1");
    EXPECT_FALSE((*store_->find("w"))->has_value);
    EXPECT_TRUE(store_->types()->empty());
    read([&] {
      EXPECT_EQ(text(store_->read("v")->value()), "42");
      const std::string tetrahedron =
          "(((0 0 0) (0 1 0) (1 0 0)) ((0 0 0) (1 0 0) (0 0 1)) ((1 0 0) (0 1 0) (0 0 1)) ((0 1 0) (0 0 0) (0 0 1)))";
      EXPECT_EQ(rows("Parts"),
                (std::vector<std::string>{"1 \"one\" " + text(value("volume3d", tetrahedron)), "2 \"two\" undefined"}));
      EXPECT_EQ(*index("Parts_Solid")->size(), 1U);
    });
  }
};

TEST_F(OlderVersion, opened_for_writing_it_is_upgraded_once_and_says_so) {
  reopen(OpenMode::read_write);
  EXPECT_EQ(store_->opening_notice(),
            path().string() + ": the database was upgraded from version 1 to 3; older programs cannot open it");
  expect_contents();
  EXPECT_EQ(sql("PRAGMA user_version"), "3");
  write([&] { ok(store_->create_derived("d", "int", "v + 1")); });
  reopen(OpenMode::read_write);
  EXPECT_EQ(store_->opening_notice(), "");
  EXPECT_EQ((*store_->find("d"))->derived_text, "v + 1");
  EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
}

TEST_F(OlderVersion, opened_for_reading_it_is_read_as_it_is) {
  reopen(OpenMode::read_only);
  EXPECT_EQ(store_->opening_notice(), "");
  expect_contents();
  EXPECT_EQ(sql("PRAGMA user_version"), "1");
  // Another process upgrades it meanwhile.
  const auto writer = opened(OpenMode::read_write);
  ok(writer->begin(true));
  ok(writer->remove("v"));
  ok(writer->commit());
  EXPECT_FALSE(store_->find("v")->has_value());
}

TEST_F(OlderVersion, while_another_process_writes_the_upgrade_waits_and_gives_up) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(path().c_str(), &handle), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(handle, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  const auto store = open_store(path(), OpenMode::read_write, registry_, {.busy_milliseconds = 10});
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::database_busy);
  sqlite3_close(handle);
  reopen(OpenMode::read_write);
  expect_contents();
}

TEST_F(OlderVersion, a_damaged_one_is_left_as_it_was) {
  sql("UPDATE catalogue SET function_text = 'fun(x: int) x' WHERE name = 'f'");
  EXPECT_EQ(open_error(path(), OpenMode::read_write).text(),
            path().string() + ": the catalogue's row of the object 'f' is not what was written");
  EXPECT_EQ(sql("PRAGMA user_version"), "1");
}

// A process that has the file open while another one, of a later version, upgrades it.
TEST_F(OlderVersion, a_version_that_becomes_newer_while_the_file_is_open_is_refused) {
  reopen(OpenMode::read_write);
  sql("PRAGMA user_version = 6");
  EXPECT_EQ(
      store_->begin(true).error().text(),
      path().string() + ": the database has version 6, this program reads versions up to 5; use a newer algebra3d");
}

}  // namespace
}  // namespace queries
