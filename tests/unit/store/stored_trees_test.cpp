// Stored R-trees: read as they lie in the file, follow their relation, and are made anew from the rows when they are
// stale, damaged or missing.
#include <random>
#include <set>

#include "queries/store/detail/cell.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Ids = std::set<std::uint64_t>;

class StoredTrees : public StoreTest {
 protected:
  static constexpr int kCount = 3000;

  Box3 random_box() {
    std::uniform_real_distribution<double> place(0, 100);
    const algebra3d::Vec3 corner{place(random_), place(random_), place(random_)};
    return {corner, corner + algebra3d::Vec3{2, 2, 2}};
  }
  Tuple row(const Box3& box) {
    Tuple result;
    result.attributes = {Value::of(std::int64_t{7}), Value::of(box)};
    return result;
  }
  void let_boxes(int count = kCount) {
    std::vector<Tuple> content;
    for (int i = 0; i < count; ++i) content.push_back(row(random_box()));
    let_relation("R", "(tuple ((No int) (B rect3)))", content);
    let_relation("Other", "(tuple ((No int)))", {tuple({{"int", "1"}})});
    let_index("I", "R", "B", "rect3");
  }
  void make_database(int count = kCount) {
    reopen();
    write([&] { let_boxes(count); });
    reopen();
  }
  static Result<Ids> found(const SpatialIndex& index, const Box3& window) {
    return index.ask([&](const SpatialIndex::Tree& tree) {
      Ids ids;
      for (const std::uint64_t id : tree.window(window)) ids.insert(id);
      return ids;
    });
  }
  /// For random windows the index gives what a scan gives.
  void expect_index_equals_scan(int windows = 20) {
    const auto stored = tuples(*relation("R"));
    const auto spatial = index("I");
    EXPECT_EQ(*spatial->size(), stored.size());
    for (int i = 0; i < windows; ++i) {
      Box3 window = random_box();
      window.extend(random_box());
      Ids expected;
      for (const TuplePtr& each : stored)
        if (each->attributes[1].get<Box3>().intersects(window)) expected.insert(static_cast<std::uint64_t>(each->id));
      const auto ids = found(*spatial, window);
      ASSERT_TRUE(ids.ok()) << ids.error().text();
      EXPECT_EQ(*ids, expected);
    }
  }
  std::string table() { return sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'"); }
  /// Whether an answer of the index needs no scan: one would meet a damaged row.
  bool is_answered_without_scan() {
    sql("UPDATE " + table() + " SET checksum = checksum + 1 WHERE id = 1");
    bool is_found = false;
    read([&] {
      const auto ids = found(*index("I"), {{0, 0, 0}, {102, 102, 102}});
      is_found = ids.ok() && ids->size() > 1;
    });
    sql("UPDATE " + table() + " SET checksum = checksum - 1 WHERE id = 1");
    return is_found;
  }
  std::string page_count() { return sql("SELECT count(*) FROM index_pages"); }
  void expect_sound() {
    read([&] {
      const auto findings = store_->check(context_, {});
      ASSERT_TRUE(findings.ok()) << findings.error().text();
      EXPECT_TRUE(findings->empty()) << findings->front().text();
    });
  }

  std::mt19937 random_{7};
};

TEST_F(StoredTrees, are_read_as_they_are) {
  make_database();
  EXPECT_TRUE(is_answered_without_scan());
  read([&] { expect_index_equals_scan(); });
  expect_sound();
  reopen(OpenMode::read_only);
  EXPECT_TRUE(is_answered_without_scan());
}

TEST_F(StoredTrees, follow_changes_of_their_relation_in_each_process) {
  make_database(500);
  for (int step = 0; step < 30; ++step) {
    reopen();
    ok(store_->begin(true));
    for (int i = 0; i < 10; ++i) {
      const auto stored = tuples(*relation("R"));
      const TupleId id = stored[random_() % stored.size()]->id;
      const auto choice = random_() % 3;
      if (choice == 0) {
        EXPECT_TRUE(relation("R")->insert(row(random_box())).ok());
      }
      if (choice == 1) ok(relation("R")->update(id, row(random_box())));
      if (choice == 2) ok(relation("R")->erase(id));
    }
    if (step % 3 == 0) expect_index_equals_scan(3);
    if (step % 5 == 4)
      store_->rollback();
    else
      ok(store_->commit());
    read([&] { expect_index_equals_scan(3); });
    expect_sound();
    EXPECT_TRUE(is_answered_without_scan());
    if (HasFailure()) return;
  }
}

TEST_F(StoredTrees, follow_statements_within_a_transaction) {
  make_database(300);
  ok(store_->begin_transaction());
  for (int i = 1; i <= 20; ++i) write([&] { ok(relation("R")->update(i, row(random_box()))); });
  read([&] { expect_index_equals_scan(); });
  ok(store_->abort_transaction());
  read([&] { expect_index_equals_scan(); });
  ok(store_->begin_transaction());
  for (int i = 1; i <= 20; ++i) write([&] { ok(relation("R")->update(i, row(random_box()))); });
  ok(store_->commit_transaction());
  reopen();
  EXPECT_TRUE(is_answered_without_scan());
  read([&] { expect_index_equals_scan(); });
  expect_sound();
}

TEST_F(StoredTrees, survive_commits_of_other_processes) {
  make_database();
  read([&] { expect_index_equals_scan(2); });
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(true));
  ok(other->read("Other")->relation()->erase(1));
  ok(other->commit());
  EXPECT_TRUE(is_answered_without_scan());
  ok(other->begin(true));
  ok(other->read("R")->relation()->update(5, row(random_box())));
  ok(other->commit());
  EXPECT_TRUE(is_answered_without_scan());
  read([&] { expect_index_equals_scan(); });
}

TEST_F(StoredTrees, a_changed_tuple_costs_few_pages) {
  make_database();
  write([&] { let_relation("Plain", "(tuple ((No int) (B rect3)))", {row(random_box()), row(random_box())}); });
  const auto without = logged_pages([&] { ok(relation("Plain")->update(1, row(random_box()))); });
  for (int i = 0; i < 20; ++i) {
    const TupleId id = 1 + static_cast<TupleId>(random_() % kCount);
    const auto with = logged_pages([&] { ok(relation("R")->update(id, row(random_box()))); });
    EXPECT_LE(with, without + 10);
  }
  // A changed number leaves the tree as it is, but for the state of the relation. The row group gets a dead tuple.
  Tuple changed;
  read([&] { changed = **relation("R")->fetch(9); });
  changed.attributes[0] = Value::of(std::int64_t{8});
  const auto number = logged_pages([&] { ok(relation("R")->update(9, changed)); });
  EXPECT_LE(number, without + 2);
  EXPECT_TRUE(is_answered_without_scan());
}

// The rows are those of a later statement than the tree, as if a program that does not know trees had written them.
TEST_F(StoredTrees, a_tree_of_another_state_is_made_anew) {
  make_database();
  sql("CREATE TABLE kept AS SELECT * FROM index_pages");
  write([&] { ok(relation("R")->erase(7)); });
  sql("DELETE FROM index_pages; INSERT INTO index_pages SELECT * FROM kept; DROP TABLE kept");
  reopen();
  read([&] { expect_index_equals_scan(); });
  expect_sound();
  reopen();
  EXPECT_TRUE(is_answered_without_scan());
  read([&] { expect_index_equals_scan(); });
}

// The header of the image names its version at byte 8, behind 56 bytes of the header of the tree.
TEST_F(StoredTrees, a_tree_of_another_version_is_no_damage_and_made_anew) {
  make_database();
  const std::string place = sql("SELECT place FROM index_pages ORDER BY place LIMIT 1");
  const std::string digits = sql("SELECT hex(bytes) FROM index_pages WHERE place = " + place);
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  ASSERT_EQ(bytes.at(64), static_cast<char>(rtree::kImageVersion));
  bytes[64] = 1;
  const auto checksum = static_cast<std::int64_t>(checksum_of(bytes, std::stoull(place)));
  sql(fmt::format("UPDATE index_pages SET checksum = {}, bytes = x'{}01{}' WHERE place = {}", checksum,
                  digits.substr(0, 128), digits.substr(130), place));
  reopen();
  expect_sound();
  read([&] { expect_index_equals_scan(); });
  EXPECT_EQ(sql("SELECT substr(hex(bytes), 129, 2) FROM index_pages WHERE place = " + place), "02");
  EXPECT_TRUE(is_answered_without_scan());
}

// A change in a process of its own reads the nodes on its way, and writes beside nodes that it did not read.
TEST_F(StoredTrees, a_change_in_a_new_process_reads_few_pages) {
  make_database(20'000);
  sql("CREATE TABLE kept AS SELECT * FROM index_pages");
  for (const TupleId id : {5, 9000, 17'777}) {
    reopen();
    write([&] { ok(relation("R")->update(id, row({{1, 1, 1}, {2, 2, 2}}))); });
  }
  EXPECT_LE(std::stoi(sql("SELECT count(*) FROM index_pages JOIN kept USING(place) WHERE index_pages.bytes != "
                          "kept.bytes")),
            40);
  sql("DROP TABLE kept");
  reopen();
  read([&] { expect_index_equals_scan(10); });
  expect_sound();
}

TEST_F(StoredTrees, every_damaged_page_is_found_and_the_answers_stay_right) {
  make_database(700);
  const std::string pages = page_count();
  std::size_t noticed = 0;
  for (int page = 0; page < std::stoi(pages); ++page) {
    const std::string place = fmt::format("(SELECT place FROM index_pages ORDER BY place LIMIT 1 OFFSET {})", page);
    const std::string byte = std::to_string(1 + random_() % 200);
    sql("UPDATE index_pages SET bytes = CAST(substr(bytes, 1, " + byte + " - 1) || x'f3' || substr(bytes, " + byte +
        " + 1) AS BLOB) WHERE place = " + place);
    reopen();
    read([&] { noticed += store_->check(context_, {})->empty() ? 0 : 1; });
    reopen();
    read([&] { expect_index_equals_scan(5); });
    read([&] {
      auto nearest = index("I");
      const auto ids = found(*nearest, {{0, 0, 0}, {102, 102, 102}});
      EXPECT_EQ(ids->size(), 700U);
    });
    // It was stored again meanwhile.
    expect_sound();
    EXPECT_EQ(page_count(), pages);
    if (HasFailure()) return;
  }
  EXPECT_GE(noticed + 1, static_cast<std::size_t>(std::stoi(pages)));
}

TEST_F(StoredTrees, changes_beside_a_damaged_page_are_made) {
  make_database(700);
  sql("UPDATE index_pages SET checksum = checksum + 1 WHERE place & 0xffffffff >= 0x80000000");
  reopen();
  write([&] {
    for (int i = 1; i <= 20; ++i) ok(relation("R")->update(i, row(random_box())));
    expect_index_equals_scan();
  });
  reopen();
  read([&] { expect_index_equals_scan(); });
  expect_sound();
}

TEST_F(StoredTrees, missing_pages_and_a_missing_table_hinder_nothing) {
  make_database(700);
  sql("DELETE FROM index_pages WHERE place & 0xffffffff = 0x80000003");
  reopen();
  read([&] { expect_index_equals_scan(); });
  expect_sound();
  sql("DROP TABLE index_pages");
  reopen();
  read([&] { expect_index_equals_scan(); });
  write([&] {
    ok(relation("R")->update(3, row(random_box())));
    ok(relation("R")->erase(4));
  });
  read([&] { expect_index_equals_scan(); });
  reopen(OpenMode::read_only);
  read([&] { expect_index_equals_scan(); });
}

// Of all other tuples neither row nor geometry can be read.
TEST_F(StoredTrees, a_window_reads_only_what_it_returns) {
  const StoreOptions apart{.inline_bytes = 50};
  reopen(OpenMode::open_or_create, apart);
  write([&] {
    let_parts(1000);
    let_index("P", "Parts", "Solid", "volume3d");
  });
  reopen();
  const std::string parts = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'");
  sql("UPDATE " + parts + " SET checksum = checksum + 1 WHERE id NOT IN (11, 12, 13)");
  sql("DELETE FROM chunks WHERE tuple NOT IN (11, 12, 13)");
  read([&] {
    const auto ids = found(*index("P"), {{95, 0, 0}, {120, 1, 1}});
    ASSERT_TRUE(ids.ok()) << ids.error().text();
    EXPECT_EQ(*ids, (Ids{11, 12, 13}));
    const RelationPtr stored = relation("Parts");
    for (const std::uint64_t id : *ids) {
      const auto tuple = stored->fetch(static_cast<TupleId>(id));
      ASSERT_TRUE(tuple.ok()) << tuple.error().text();
      EXPECT_EQ(text(**tuple), text(part(static_cast<int>(id) - 1)));
    }
    EXPECT_EQ(store_->geometry_loads(), 3U);
  });
}

TEST_F(StoredTrees, go_with_their_index_and_their_relation) {
  make_database(100);
  write([&] {
    let_index("J", "R", "B", "rect3");
    expect_index_equals_scan(2);
  });
  write([&] { ok(store_->remove("I")); });
  read([&] { EXPECT_EQ(*index("J")->size(), 100U); });
  expect_sound();
  write([&] { ok(store_->rename("R", "Q")); });
  read([&] { EXPECT_EQ(*index("J")->size(), 100U); });
  expect_sound();
  write([&] { ok(store_->remove("Q")); });
  EXPECT_EQ(page_count(), "0");
  expect_sound();
}

}  // namespace
}  // namespace queries
