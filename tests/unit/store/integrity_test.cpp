// The integrity check: says nothing of a sound database and names what is wrong in another one.
#include <algorithm>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoreIntegrity : public StoreTest {
 protected:
  void let_everything(const StoreOptions& options = {}) {
    store_.reset();
    std::filesystem::remove(path());
    reopen(OpenMode::open_or_create, options);
    write([&] {
      std::vector<Tuple> content;
      for (int i = 0; i < 10; ++i)
        content.push_back(tuple({{"int", std::to_string(i)},
                                 {"string", fmt::format("\"part {}\"", i)},
                                 {"volume3d", i == 3 ? "undefined" : solid(3 * i)},
                                 {"point3d", fmt::format("({}/3 0.0 1.0)", 3 * i + 1)}}));
      let_relation("R", "(tuple ((No int) (Name string) (Solid volume3d) (P point3d)))", content);
      let_index("I", "R", "Solid", "volume3d");
      ok(store_->create_function("f", type("(map int int)"), "fun(x: int) x + 1"));
      ok(store_->create("v", "volume3d"));
      ok(store_->assign("v", Datum{value("volume3d", solid(4))}, context_));
      ok(store_->create("empty", "int"));
      ok(store_->create("never", type("(rel (tuple ((A int))))")));
      ok(store_->create_type("t", "real"));
      ok(store_->remember_imported("R", {"a.stl", 84, 1}));
      ok(store_->remember_pulled("R", {"d.s.t", "(0,1)", 84, 1}));
    });
    read([&] {
      EXPECT_EQ(*index("I")->size(), 9U);
      const auto index_of_all = index("I");
      ok(store_->create("frozen", type("(rtree3 (tuple ((No int))) volume3d FALSE)")));
      ok(store_->assign(
          "frozen",
          Datum{std::make_shared<SpatialIndex>("", "", std::make_shared<SpatialIndex::Tree>(**index_of_all->tree()))},
          context_));
    });
  }
  std::vector<std::string> findings(Store& store) {
    ok(store.begin(false));
    const auto found = store.check(context_, {});
    store.rollback();
    EXPECT_TRUE(found.ok()) << found.error().text();
    std::vector<std::string> result;
    if (found)
      for (const Finding& each : *found) result.push_back(each.text());
    return result;
  }
  std::vector<std::string> findings() {
    const auto store = opened(OpenMode::read_only);
    return findings(*store);
  }
  using Texts = std::vector<std::string>;
  std::string table() { return sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'"); }
  /// Changes the file behind the back of the store, which has it open, and gives what a check then finds.
  Texts after(const std::string& statement) {
    let_everything();
    store_.reset();
    sql(statement);
    return findings();
  }
  Texts after_in_table(std::string statement) {
    let_everything();
    store_.reset();
    statement.replace(statement.find('@'), 1, table());
    sql(statement);
    return findings();
  }
};

TEST_F(StoreIntegrity, a_sound_database_gives_no_findings) {
  let_everything();
  EXPECT_EQ(findings(*store_), Texts());
  write([&] {
    ok(relation("R")->erase(2));
    ok(relation("R")->update(5, **relation("R")->fetch(6)));
    ok(store_->rename("R", "r"));
  });
  EXPECT_EQ(findings(*store_), Texts());
  ok(store_->begin_transaction());
  write([&] {
    ok(relation("r")->erase(7));
    ok(store_->remove("v"));
  });
  EXPECT_EQ(findings(*store_), Texts());
  ok(store_->commit_transaction());
  EXPECT_EQ(findings(), Texts());
}

TEST_F(StoreIntegrity, values_in_chunks_are_followed) {
  let_everything({.inline_bytes = 50, .chunk_bytes = 100});
  EXPECT_EQ(findings(*store_), Texts());
  store_.reset();
  EXPECT_NE(sql("SELECT count(*) FROM chunks"), "0");
  sql("UPDATE chunks SET bytes = zeroblob(length(bytes)) WHERE owner = 0 AND part = 1");
  sql("DELETE FROM chunks WHERE owner <> 0 AND tuple = 6 AND part = 0");
  sql("INSERT INTO chunks VALUES(77, 1, 0, 0, x'00'), (0, 78, 0, 0, x'00')");
  const Texts found = findings();
  ASSERT_EQ(found.size(), 5U) << found[0];
  EXPECT_TRUE(found[0].starts_with("R: tuple 6: 'Solid': a long value has ")) << found[0];
  EXPECT_EQ(found[1], "frozen: the stored value is not what was written");
  EXPECT_EQ(found[2], "v: the stored value is not what was written");
  EXPECT_EQ(found[3], "there are chunks of a value that is not there: owner 0, tuple 78, attribute 0");
  EXPECT_EQ(found[4], "there are chunks of a value that is not there: owner 77, tuple 1, attribute 0");
}

TEST_F(StoreIntegrity, changed_rows_and_bytes_are_named) {
  EXPECT_EQ(after_in_table("UPDATE @ SET a2_Name = 'other' WHERE id = 7"),
            Texts{"R: tuple 7: the row is not what was written"});
  EXPECT_EQ(after_in_table("UPDATE @ SET a3_Solid = zeroblob(200) WHERE id IN (2, 5)"),
            (Texts{"R: tuple 2: 'Solid': the bytes of 'Solid' are not what was written",
                   "R: tuple 5: 'Solid': the bytes of 'Solid' are not what was written"}));
  EXPECT_EQ(after("UPDATE object_values SET value = x'00'").size(), 2U);
}

TEST_F(StoreIntegrity, lost_and_added_tuples_are_counted) {
  EXPECT_EQ(after_in_table("DELETE FROM @ WHERE id = 5"), Texts{"R: there are 9 tuples, 10 were written"});
  EXPECT_EQ(
      after_in_table("UPDATE @ SET id = 500 WHERE id = 5"),
      (Texts{"R: tuple 500: the row is not what was written", "R: there is a tuple 500, the next one is to be 11"}));
}

TEST_F(StoreIntegrity, what_belongs_to_no_object_is_named) {
  EXPECT_EQ(after("CREATE TABLE rel_99_X(id INTEGER PRIMARY KEY)"), Texts{"the table rel_99_X belongs to no object"});
  EXPECT_EQ(after("CREATE TABLE other(a)"), Texts{"the table other belongs to no object"});
  EXPECT_EQ(after("INSERT INTO object_values VALUES(99, x'00')"),
            Texts{"the table object_values has rows of the object number 99, which is not there"});
  EXPECT_EQ(after("INSERT INTO imported_files VALUES(99, 'a', 1, 1)"),
            Texts{"the table imported_files has rows of the object number 99, which is not there"});
  EXPECT_EQ(after("INSERT INTO pulled_tables VALUES(99, 'a', 'b', 1, 1)"),
            Texts{"the table pulled_tables has rows of the object number 99, which is not there"});
}

TEST_F(StoreIntegrity, a_lost_table_is_an_unreadable_relation) {
  let_everything();
  store_.reset();
  sql("DROP TABLE " + table());
  const Texts found = findings();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].starts_with("R: ")) << found[0];
  EXPECT_NE(found[0].find("no such table"), std::string::npos) << found[0];
  EXPECT_EQ(found[1], "R: 0 of 10 tuples can still be read");
}

// A box that is not that of the geometry, under right checksums: what a fault in the program that wrote it would give.
TEST_F(StoreIntegrity, boxes_sizes_and_geometry_are_compared_behind_the_checksums) {
  let_everything();
  write([&] {
    Tuple changed = **relation("R")->fetch(1);
    struct Liar : algebra3d::DeferredValue {
      algebra3d::GeometryHeader header() const override { return {{{0, 0, 0}, {9, 9, 9}}, 5}; }
      Result<Value> load() const override { return truth; }
      std::shared_ptr<const algebra3d::DeferredSource> source() const override { return nullptr; }
      void append_reference(std::string& /*bytes*/) const override {}
      Value truth;
      explicit Liar(Value value) : truth(std::move(value)) {}
    };
    const Value truth = *changed.attributes[2].loaded();
    changed.attributes[2] = Value(truth.type(), std::make_shared<Liar>(truth));
    ok(relation("R")->update(1, changed));
  });
  EXPECT_EQ(findings(*store_), (Texts{"R: tuple 1: 'Solid': the box in the columns is not that of the value",
                                      "R: tuple 1: 'Solid': the size in the columns is 5, that of the value 4"}));
}

TEST_F(StoreIntegrity, an_index_in_memory_that_missed_a_change_is_found) {
  let_everything();
  read([&] { (*index("I")->tree())->insert({{0, 0, 0}, {1, 1, 1}}, 5); });
  EXPECT_EQ(findings(*store_), Texts{"R: 'Solid': the index in memory does not have the boxes of the relation"});
}

TEST_F(StoreIntegrity, damaged_pages_are_found_by_sqlite_and_the_rest_is_still_checked) {
  let_everything();
  const std::string root = sql("SELECT rootpage FROM sqlite_schema WHERE name = '" + table() + "'");
  store_.reset();
  const auto page_bytes = std::stoul(sql("PRAGMA page_size"));
  sql("UPDATE object_values SET value = x'00' WHERE id = (SELECT id FROM catalogue WHERE name = 'v')");
  std::string content = bytes(path());
  content.replace((std::stoul(root) - 1) * page_bytes, page_bytes, page_bytes, '\xff');
  write_bytes(path(), content);
  const Texts found = findings();
  ASSERT_GE(found.size(), 4U);
  EXPECT_TRUE(found[0].starts_with("R: page ")) << found[0];
  EXPECT_TRUE(std::all_of(found.begin(), found.end() - 1, [](const auto& each) {
    return each.starts_with("R: ") || each.starts_with("the free pages of the file");
  }));
  EXPECT_EQ(std::ranges::count(found, "R: 0 of 10 tuples can still be read"), 1);
  EXPECT_EQ(found.back(), "v: the stored value is not what was written");
}

// A leaf of the table: the tuples on it are lost, and those behind it are read. Which tuples lie on a page is told by
// the table dbstat where SQLite has it; here by their numbers, which stand in the page.
TEST_F(StoreIntegrity, tuples_behind_a_damaged_page_are_read) {
  reopen(OpenMode::open_or_create, {.group_rows = 0});
  write([&] {
    std::vector<Tuple> content;
    for (int i = 1; i <= 3000; ++i)
      content.push_back(tuple({{"int", std::to_string(i)}, {"string", fmt::format("\"a part of number {:06}\"", i)}}));
    let_relation("R", "(tuple ((No int) (Name string)))", content);
  });
  store_.reset();
  sql("VACUUM");  // pages that were divided hold copies of tuples that are elsewhere now
  const auto page_bytes = std::stoul(sql("PRAGMA page_size"));
  std::string content = bytes(path());
  int first = 0;
  int last = 0;
  const std::size_t page = content.find("a part of number 001500") / page_bytes * page_bytes;
  for (int i = 1; i <= 3000; ++i) {
    const std::size_t at = content.find(fmt::format("a part of number {:06}", i));
    if (at / page_bytes * page_bytes != page) continue;
    first = first == 0 ? i : first;
    last = i;
  }
  ASSERT_GT(last, first);
  content.replace(page, page_bytes, page_bytes, '\xff');
  write_bytes(path(), content);
  const Texts found = findings();
  const auto has = [&](const std::string& wanted) {
    return std::ranges::any_of(found, [&](const auto& each) { return each.find(wanted) != std::string::npos; });
  };
  EXPECT_TRUE(has(fmt::format("R: tuple {0}: tuples {0} to {1} cannot be read: ", first, last)));
  EXPECT_TRUE(has(fmt::format("R: {} of 3000 tuples can still be read: tuples 1 to {}, tuples {} to 3000",
                              3000 - (last - first + 1), first - 1, last + 1)))
      << found.back();
}

TEST_F(StoreIntegrity, columns_and_rows_that_do_not_belong_are_named) {
  EXPECT_EQ(after("INSERT INTO meta VALUES(2, 1, 1, 1)"),
            Texts{"the catalogue (table meta): there are 2 rows, 1 was written"});
  EXPECT_EQ(after("ALTER TABLE named_types ADD COLUMN more"),
            Texts{"the catalogue (table named_types): the table named_types has a column 'more' that does not belong "
                  "there"});
  const Texts found = after_in_table("ALTER TABLE @ ADD COLUMN more");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("R: the table rel_")) << found[0];
}

TEST_F(StoreIntegrity, a_damaged_catalogue_does_not_hide_the_rest) {
  let_everything();
  store_.reset();
  sql("UPDATE catalogue SET name = 'other' WHERE name = 'v'");
  sql("UPDATE " + table() + " SET a1_No = 77 WHERE id = 4");
  const auto found = Store::check_damaged(path(), registry_, context_, {});
  ASSERT_TRUE(found.ok()) << found.error().text();
  Texts texts;
  for (const Finding& each : *found) texts.push_back(each.text());
  ASSERT_GE(texts.size(), 3U);
  EXPECT_EQ(texts[0], "the catalogue: the catalogue's row of the object 'other' is not what was written");
  EXPECT_EQ(texts[1],
            "the catalogue: the catalogue is not what was written: objects are missing or there are too many");
  EXPECT_EQ(texts[2], "R: tuple 4: the row is not what was written");
}

TEST_F(StoreIntegrity, what_was_killed_is_no_finding) {
  let_everything();
  store_.reset();
  sql("UPDATE object_values SET value = x'00' WHERE id = (SELECT id FROM catalogue WHERE name = 'v')");
  reopen();
  write([&] { ok(store_->kill("v")); });
  EXPECT_EQ(findings(*store_), Texts());
}

TEST_F(StoreIntegrity, many_findings_on_one_object_are_counted) {
  reopen();
  write([&] { let_parts(150); });
  store_.reset();
  sql("UPDATE " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'") + " SET a1_No = -1");
  const Texts found = findings();
  ASSERT_EQ(found.size(), 101U);
  EXPECT_EQ(found[0], "Parts: tuple 1: the row is not what was written");
  EXPECT_EQ(found[100], "Parts: 50 more findings");
}

TEST_F(StoreIntegrity, it_reports_progress_and_can_be_interrupted) {
  let_everything();
  std::vector<std::string> objects;
  ok(store_->begin(false));
  CheckProgress last;
  ASSERT_TRUE(store_
                  ->check(context_,
                          [&](const CheckProgress& progress) {
                            objects.push_back(progress.object);
                            EXPECT_GT(progress.done, last.done);
                            last = progress;
                          })
                  .ok());
  EXPECT_EQ(objects, (Texts{"I", "R", "empty", "f", "frozen", "never", "v"}));
  EXPECT_EQ(last.total, 17U);
  EXPECT_EQ(last.done, last.total);
  std::atomic<bool> cancel = false;
  const Context cancellable{diagnostics_, &cancel, {}};
  const auto interrupted = store_->check(cancellable, [&](const CheckProgress&) { cancel = true; });
  EXPECT_EQ(interrupted.error().code, ErrorCode::interrupted);
  EXPECT_EQ(store_->check(cancellable, {}).error().code, ErrorCode::interrupted);
  cancel = false;
  EXPECT_TRUE(store_->check(cancellable, {})->empty());
  store_->rollback();
  EXPECT_FALSE(store_->check(context_, {}).ok());
}

TEST_F(StoreIntegrity, a_file_of_the_version_before_is_checked_as_it_is) {
  std::filesystem::copy_file(std::filesystem::path(ALGEBRA3D_SOURCE) / "tests/unit/store/data/version1.database",
                             path());
  EXPECT_EQ(findings(), Texts());
  EXPECT_EQ(sql("PRAGMA user_version"), "1");
}

}  // namespace
}  // namespace queries
