// Relations in row groups: they are what the same relations in rows are, whatever happens to them.
#include <array>
#include <functional>
#include <random>
#include <set>

#include "queries/streams/batch.h"
#include "queries/streams/ordered_index.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

const StoreOptions kSmallGroups{.group_rows = 8, .least_group_rows = 3, .loose_rows = 6};
const StoreOptions kNoGroups{.group_rows = 0};

class RowGroupRelations : public StoreTest {
 protected:
  RowGroupRelations() { reopen(OpenMode::open_or_create, kSmallGroups); }

  Tuple numbered(int number) {
    if (number % 7 == 0) return tuple({{"int", "undefined"}, {"string", "undefined"}});
    return tuple({{"int", std::to_string(number)}, {"string", fmt::format("\"s{}\"", number % 5)}});
  }
  void let_numbers(int count) {
    std::vector<Tuple> content;
    for (int i = 1; i <= count; ++i) content.push_back(numbered(i));
    let_relation("R", "(tuple ((A int) (B string)))", content);
  }
  void let_order(const std::string& name, const std::string& attribute, const std::string& attribute_type) {
    ok(store_->create(name, TypeExpr("btree", {relation("R")->tuple_type(), TypeExpr(attribute_type)})));
    ok(store_->assign(name,
                      Datum{std::make_shared<OrderedIndex>("R", attribute, std::shared_ptr<const OrderedEntries>())},
                      context_));
  }
  Status insert_all(const std::vector<Tuple>& content) {
    std::vector<TuplePtr> shared;
    for (const Tuple& each : content) shared.push_back(std::make_shared<const Tuple>(each));
    const auto inserted = relation("R")->insert_all(*TupleBuffer(std::move(shared)).scan(), context_);
    return inserted ? Status() : inserted.error();
  }
  /// Gives each tuple a number: its id and this one.
  Status update_all(const std::vector<TupleId>& ids, int more) {
    std::vector<TuplePtr> values;
    for (const TupleId id : ids)
      values.push_back(std::make_shared<const Tuple>(tuple({{"int", std::to_string(id + more)}})));
    return relation("R")->update_all(ids, std::vector<std::size_t>{0}, *TupleBuffer(std::move(values)).scan(),
                                     context_);
  }
  std::vector<std::string> findings() {
    std::vector<std::string> result;
    auto found = store_->check(context_, nullptr);
    EXPECT_TRUE(found.ok()) << (found ? "" : found.error().text());
    if (found)
      for (const Finding& each : *found) result.push_back(each.text());
    return result;
  }
  std::string group_count() { return sql("SELECT count(*) FROM row_groups"); }
  std::string table() { return sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'"); }
  std::string loose_count() { return sql("SELECT count(*) FROM " + table()); }

  /// The tuples with these ids.
  static std::vector<std::string> by_ids(TuplesById& tuples, const std::vector<TupleId>& ids) {
    std::vector<std::string> result;
    const auto batch = tuples.read(ids);
    EXPECT_TRUE(batch.ok()) << (batch ? "" : batch.error().text());
    if (batch)
      for (std::size_t i = 0; i < (*batch)->rows.count; ++i)
        result.push_back(text(*tuple_of(**batch, (*batch)->rows[i])));
    return result;
  }

  /// The tuples of a scan in columns that reads some attributes.
  std::vector<std::string> in_columns(const std::string& name, std::vector<bool> read, std::size_t most) {
    std::vector<std::string> result;
    auto scan = relation(name)->scan_columns(std::move(read), {});
    while (true) {
      const auto batch = (*scan)->next_batch(most);
      EXPECT_TRUE(batch.ok()) << (batch ? "" : batch.error().text());
      if (!batch || *batch == nullptr) return result;
      EXPECT_LE((*batch)->rows.count, most);
      for (std::size_t i = 0; i < (*batch)->rows.count; ++i) {
        const TuplePtr each = tuple_of(**batch, (*batch)->rows[i]);
        result.push_back(std::to_string(each->id) + " " + text(*each));
      }
    }
  }
};

TEST_F(RowGroupRelations, many_tuples_become_groups_and_few_do_not) {
  write([&] { let_numbers(20); });
  EXPECT_EQ(group_count(), "3");
  EXPECT_EQ(loose_count(), "0");
  write([&] { ASSERT_TRUE(relation("R")->insert(numbered(21)).ok()); });
  write([&] { ok(insert_all({numbered(22), numbered(23)})); });
  EXPECT_EQ(group_count(), "3");
  EXPECT_EQ(loose_count(), "3");
  write([&] { ok(insert_all({numbered(24), numbered(25), numbered(26)})); });
  EXPECT_EQ(group_count(), "4");
  reopen(OpenMode::read_write, kSmallGroups);
  read([&] {
    EXPECT_EQ(*relation("R")->count(), 26);
    const auto found = rows("R");
    ASSERT_EQ(found.size(), 26U);
    for (int i = 1; i <= 26; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i - 1)], text(numbered(i)));
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
}

TEST_F(RowGroupRelations, a_type_with_large_values_stays_in_rows) {
  write([&] { let_parts(20); });
  EXPECT_EQ(group_count(), "0");
  EXPECT_EQ(sql("SELECT count(*) FROM " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'")), "20");
}

TEST_F(RowGroupRelations, loose_tuples_become_groups_when_there_are_many) {
  write([&] { let_numbers(16); });
  for (int i = 17; i < 22; ++i) write([&] { ASSERT_TRUE(relation("R")->insert(numbered(i)).ok()); });
  EXPECT_EQ(loose_count(), "5");
  write([&] { ASSERT_TRUE(relation("R")->insert(numbered(22)).ok()); });
  EXPECT_EQ(loose_count(), "0");
  EXPECT_EQ(group_count(), "3");
  read([&] { EXPECT_EQ(findings(), std::vector<std::string>{}); });
}

TEST_F(RowGroupRelations, overwritten_tuples_stand_beside_their_group_until_there_are_many) {
  write([&] { let_numbers(16); });
  write([&] { ok(relation("R")->update(3, numbered(103))); });
  EXPECT_EQ(loose_count(), "1");
  EXPECT_EQ(sql("SELECT hex(dead) FROM row_groups WHERE first = 1"), "04");
  write([&] {
    for (const int id : {1, 2, 4, 5, 6, 8}) ok(relation("R")->update(id, numbered(100 + id)));
  });
  EXPECT_EQ(loose_count(), "0");
  EXPECT_EQ(sql("SELECT hex(dead) FROM row_groups WHERE first = 1"), "");
  write([&] {
    for (TupleId id = 1; id <= 8; ++id) ok(relation("R")->erase(id));
  });
  EXPECT_EQ(group_count(), "1");
  EXPECT_EQ(sql("SELECT count(*) FROM column_chunks"), "2");
  read([&] {
    EXPECT_EQ(rows("R").size(), 8U);
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
}

TEST_F(RowGroupRelations, a_scan_shows_the_relation_as_it_was_when_it_began) {
  write([&] { let_numbers(20); });
  write([&] { ok(relation("R")->update(5, numbered(105))); });
  write([&] {
    const auto before = rows("R");
    const auto scan = *relation("R")->scan();
    const auto late = *relation("R")->by_id({true, true});
    std::vector<std::string> found;
    found.push_back(text(**scan->next()));
    EXPECT_EQ(by_ids(*late, {2}), std::vector<std::string>{before[1]});
    for (const int id : {1, 2, 5, 9, 19}) ok(relation("R")->update(id, numbered(200 + id)));
    ok(relation("R")->erase(20));
    ok(relation("R")->erase(3));
    ok(insert_all({numbered(31), numbered(32), numbered(33), numbered(34)}));
    ASSERT_TRUE(relation("R")->insert(numbered(35)).ok());
    while (const TuplePtr next = *scan->next()) found.push_back(text(*next));
    EXPECT_EQ(found, before);
    EXPECT_EQ(by_ids(*late, {20, 5, 99, 9, 2, 3, 32, 9}),
              (std::vector<std::string>{before[19], before[4], before[8], before[1], before[2], before[8]}));
    EXPECT_EQ(by_ids(**relation("R")->by_id({true, true}), {20, 9}), std::vector<std::string>{text(numbered(209))});
    EXPECT_EQ(rows("R").size(), 23U);
    EXPECT_EQ(rows("R")[0], text(numbered(201)));
  });
  read([&] { EXPECT_EQ(findings(), std::vector<std::string>{}); });
}

// A reader that has begun sees the chunks of before, also when they are replaced twice.
TEST_F(RowGroupRelations, chunks_are_replaced_under_readers) {
  write([&] { let_numbers(20); });
  write([&] { ok(relation("R")->update(5, numbered(105))); });
  std::vector<std::string> after;
  write([&] {
    const auto before = rows("R");
    const auto first_scan = *relation("R")->scan();
    const auto first_ids = *relation("R")->by_id({true, true});
    std::vector<std::string> first_found = {text(**first_scan->next())};
    ok(first_ids->read({}).ok() ? Status() : Error{ErrorCode::internal, "not read"});
    ok(update_all({20, 5, 3, 11, 7, 9}, 400));
    const auto middle = rows("R");
    EXPECT_EQ(middle[2], "403 \"s3\"");
    EXPECT_EQ(middle[4], "405 undefined");
    EXPECT_EQ(middle[6], "407 undefined");
    const auto second_scan = *relation("R")->scan();
    std::vector<std::string> second_found = {text(**second_scan->next())};
    ok(update_all({1, 2, 3, 4, 5, 6, 7, 8}, 500));
    ok(relation("R")->erase_all(std::vector<TupleId>{12, 5, 6}, context_));
    while (const TuplePtr next = *first_scan->next()) first_found.push_back(text(*next));
    while (const TuplePtr next = *second_scan->next()) second_found.push_back(text(*next));
    EXPECT_EQ(first_found, before);
    EXPECT_EQ(second_found, middle);
    EXPECT_EQ(by_ids(*first_ids, {12, 3, 1}), (std::vector<std::string>{before[11], before[2], before[0]}));
    after = rows("R");
  });
  EXPECT_EQ(after.size(), 17U);
  EXPECT_EQ(after[2], "503 \"s3\"");
  reopen(OpenMode::read_write, kSmallGroups);
  read([&] {
    EXPECT_EQ(rows("R"), after);
    EXPECT_EQ(*relation("R")->count(), 17);
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
}

TEST_F(RowGroupRelations, replaced_chunks_go_with_their_statement) {
  write([&] { let_numbers(20); });
  std::vector<std::string> before;
  ok(store_->begin(true));
  before = rows("R");
  const auto reader = *relation("R")->by_id({true, true});
  EXPECT_EQ(by_ids(*reader, {2}), std::vector<std::string>{before[1]});
  ok(update_all({1, 2, 3, 10, 20}, 400));
  EXPECT_EQ(rows("R")[1], "402 \"s2\"");
  store_->rollback();
  read([&] {
    EXPECT_EQ(rows("R"), before);
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
}

// Large changes leave nothing beside the groups, and indexes follow, whether they are in the file or in memory.
TEST_F(RowGroupRelations, indexes_follow_changes_in_columns) {
  write([&] {
    let_numbers(40);
    let_order("R_A", "A", "int");
  });
  const auto in_range = [&](int low, int high) {
    return *store_->read("R_A")->ordered_index()->entries().range(Value::of(std::int64_t{low}),
                                                                  Value::of(std::int64_t{high}));
  };
  write([&] {
    EXPECT_EQ(in_range(1, 5), (std::vector<TupleId>{1, 2, 3, 4, 5}));
    ok(update_all({1, 2, 7, 30}, 400));
    EXPECT_EQ(in_range(1, 5), (std::vector<TupleId>{3, 4, 5}));
    ok(relation("R")->erase_all(std::vector<TupleId>{3, 40}, context_));
  });
  EXPECT_EQ(loose_count(), "0");
  read([&] {
    EXPECT_EQ(in_range(1, 5), (std::vector<TupleId>{4, 5}));
    EXPECT_EQ(in_range(400, 499), (std::vector<TupleId>{1, 2, 7, 30}));
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
}

// A damaged chunk takes away its attribute in its tuples, and nothing else.
TEST_F(RowGroupRelations, a_damaged_chunk_is_named_and_the_rest_is_read) {
  write([&] { let_numbers(20); });
  store_.reset();
  sql("UPDATE column_chunks SET bytes = zeroblob(length(bytes)) WHERE attribute = 0 AND first = 9");
  reopen(OpenMode::read_write, kSmallGroups);
  read([&] {
    const auto scan = *relation("R")->scan();
    for (int i = 0; i < 8; ++i) EXPECT_EQ(text(**scan->next()), text(numbered(i + 1)));
    EXPECT_EQ(scan->next().error().text(), "R: 'A' of tuples 9 to 16: the column chunk is not what was written");
    EXPECT_EQ(in_columns("R", {false, true}, 5).size(), 20U);
    EXPECT_EQ(text(**relation("R")->fetch(17)), text(numbered(17)));
    EXPECT_FALSE(relation("R")->fetch(9).ok());
    EXPECT_EQ(findings(),
              (std::vector<std::string>{"R: 'A': 'A' of tuples 9 to 16: the column chunk is not what was written",
                                        "R: 12 of 20 tuples can still be read: tuples 1 to 8, tuples 17 to 20"}));
  });
}

TEST_F(RowGroupRelations, what_is_missing_is_noticed) {
  const auto after = [&](const std::string& statement) {
    store_.reset();
    std::filesystem::remove(path());
    reopen(OpenMode::open_or_create, kSmallGroups);
    write([&] { let_numbers(20); });
    store_.reset();
    sql(statement);
    reopen(OpenMode::read_only, kSmallGroups);
    std::vector<std::string> found;
    read([&] { found = findings(); });
    // A scan that reads no attribute notices a row group that is missing or changed.
    ok(store_->begin(false));
    auto scan = relation("R")->scan_columns({true, true}, {});
    bool is_noticed = !scan.ok();
    while (!is_noticed) {
      const auto batch = (*scan)->next_batch(100);
      is_noticed = !batch.ok();
      if (!batch || *batch == nullptr) break;
    }
    store_->rollback();
    EXPECT_TRUE(is_noticed) << statement;
    return found;
  };
  EXPECT_EQ(after("DELETE FROM row_groups WHERE first = 9; DELETE FROM column_chunks WHERE first = 9"),
            (std::vector<std::string>{"R: there are 12 tuples, 20 were written"}));
  EXPECT_EQ(after("DELETE FROM column_chunks WHERE first = 9 AND attribute = 1"),
            (std::vector<std::string>{"R: 'B': 'B' of tuples 9 to 16: the column chunk is not there",
                                      "R: 12 of 20 tuples can still be read: tuples 1 to 8, tuples 17 to 20"}));
  EXPECT_EQ(after("UPDATE row_groups SET dead = x'01' WHERE first = 9")[0],
            "R: the row group of tuples 9 to 16 is not what was written");
  // Another chunk with a right checksum, from another place.
  EXPECT_EQ(
      after("UPDATE column_chunks SET bytes = (SELECT bytes FROM column_chunks WHERE attribute = 0 AND first = 1) "
            "WHERE attribute = 0 AND first = 9")[0],
      "R: 'A': 'A' of tuples 9 to 16: the column chunk is not what was written");
}

TEST_F(RowGroupRelations, ordered_indexes_follow) {
  write([&] {
    let_numbers(20);
    let_order("R_A", "A", "int");
    let_order("R_B", "B", "string");
  });
  const auto of = [&](const std::string& name, const std::optional<Value>& low, const std::optional<Value>& high) {
    return *store_->read(name)->ordered_index()->entries().range(low, high);
  };
  const auto a = [&](int number) { return std::optional(value("int", std::to_string(number))); };
  read([&] {
    EXPECT_EQ(of("R_A", a(9), a(11)), (std::vector<TupleId>{9, 10, 11}));
    EXPECT_EQ(*store_->read("R_A")->ordered_index()->size(), 18U);
  });
  write([&] {
    ok(relation("R")->update(10, numbered(1)));
    ok(relation("R")->erase(9));
    ok(insert_all({numbered(9), numbered(10), numbered(10)}));
  });
  reopen(OpenMode::read_write, kSmallGroups);
  read([&] {
    EXPECT_EQ(of("R_A", a(9), a(11)), (std::vector<TupleId>{21, 22, 23, 11}));
    EXPECT_EQ(of("R_A", a(1), a(1)), (std::vector<TupleId>{1, 10}));
    EXPECT_EQ(of("R_B", value("string", "\"s4\""), value("string", "\"s4\"")), (std::vector<TupleId>{4, 19, 21}));
    EXPECT_EQ(findings(), std::vector<std::string>{});
  });
  store_.reset();
  const std::string keys = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'keys_%_1'");
  sql("UPDATE " + keys + " SET key = 77 WHERE id = 11");
  reopen(OpenMode::read_write, kSmallGroups);
  read([&] {
    EXPECT_EQ(findings(), (std::vector<std::string>{"R_A: the key table " + keys +
                                                    ": it does not have the values of the relation"}));
  });
  write([&] { ok(store_->remove("R_A")); });
  EXPECT_EQ(sql("SELECT count(*) FROM sqlite_schema WHERE name = '" + keys + "'"), "0");
  write([&] { ok(store_->remove("R")); });
  EXPECT_EQ(sql("SELECT count(*) FROM sqlite_schema WHERE name LIKE 'keys%' OR name LIKE 'order%'"), "0");
  EXPECT_EQ(sql("SELECT count(*) FROM row_groups"), "0");
  EXPECT_EQ(sql("SELECT count(*) FROM column_chunks"), "0");
}

// Whatever the bounds leave out, no tuple within them is missing; and groups are left out.
TEST_F(RowGroupRelations, groups_outside_of_bounds_are_left_out) {
  write([&] {
    std::vector<Tuple> content;
    for (int i = 1; i <= 80; ++i)
      content.push_back(tuple({{"int", std::to_string(i)}, {"real", fmt::format("{}.5", -i)}}));
    let_relation("R", "(tuple ((A int) (X real)))", content);
  });
  // In a group that would be left out, a tuple beside it that is within the bounds.
  write([&] { ok(relation("R")->update(2, tuple({{"int", "42"}, {"real", "-42.5"}}))); });
  write([&] { ok(relation("R")->erase(45)); });
  const auto within = [&](const AttributeBounds& bounds) {
    auto scan = relation("R")->scan_columns({true, false}, {bounds});
    std::vector<TupleId> found;
    while (true) {
      const auto batch = (*scan)->next_batch(1024);
      EXPECT_TRUE(batch.ok());
      if (!batch || *batch == nullptr) break;
      for (std::size_t i = 0; i < (*batch)->rows.count; ++i) {
        const std::size_t row = (*batch)->rows[i];
        const auto a = (*batch)->columns[0]->value(row).get<std::int64_t>();
        if (40 <= a && a <= 46) found.push_back((*batch)->ids[row]);
      }
    }
    const auto stages = (*scan)->stages();
    EXPECT_EQ(stages.size(), 1U);
    if (!stages.empty()) {
      EXPECT_EQ(stages[0].what, "row groups left out");
      EXPECT_EQ(stages[0].count, 8U);
    }
    return found;
  };
  read([&] {
    const std::vector<TupleId> expected = {2, 40, 41, 42, 43, 44, 46};
    EXPECT_EQ(within({0, value("int", "40"), value("int", "46")}), expected);
    EXPECT_EQ(within({1, value("real", "-46.5"), value("real", "-40.5")}), expected);
  });
}

/// A file of version 4 with the relation R and an index on A.
class FileOfVersion4 : public RowGroupRelations {
 protected:
  FileOfVersion4() {
    reopen(OpenMode::open_or_create, kNoGroups);
    write([&] {
      let_numbers(40);
      let_order("R_A", "A", "int");
    });
    store_.reset();
    const std::string order = sql("SELECT name FROM sqlite_schema WHERE type = 'index' AND name LIKE 'order_%'");
    sql("DROP TABLE " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'keys_%'"));
    sql("CREATE INDEX " + order + " ON " + table() + "(a1_A)");
    sql("DROP TABLE row_groups; DROP TABLE column_chunks; PRAGMA user_version = 4");
  }
  void expect_content(std::size_t count) {
    read([&] {
      EXPECT_EQ(rows("R").size(), count);
      const auto range = store_->read("R_A")->ordered_index()->entries().range(value("int", "39"), std::nullopt);
      EXPECT_EQ(range->size(), count - 38);
      EXPECT_EQ(findings(), std::vector<std::string>{});
    });
  }
};

TEST_F(FileOfVersion4, is_converted_when_many_tuples_come) {
  reopen(OpenMode::read_only, kSmallGroups);
  expect_content(40);
  EXPECT_EQ(sql("PRAGMA user_version"), "4");
  reopen(OpenMode::read_write, kSmallGroups);
  expect_content(40);
  write([&] { ASSERT_TRUE(relation("R")->insert(numbered(41)).ok()); });
  expect_content(41);
  EXPECT_EQ(sql("PRAGMA user_version"), "4");
  write([&] { ok(insert_all({numbered(43), numbered(44), numbered(45), numbered(46)})); });
  expect_content(45);
  EXPECT_EQ(sql("PRAGMA user_version"), "5");
  EXPECT_EQ(loose_count(), "0");
  reopen(OpenMode::read_write, kSmallGroups);
  expect_content(45);
}

TEST_F(FileOfVersion4, a_conversion_that_is_undone_leaves_it_as_it_was) {
  reopen(OpenMode::read_write, kSmallGroups);
  ok(store_->begin(true));
  ok(insert_all({numbered(43), numbered(44), numbered(45), numbered(46)}));
  store_->rollback();
  expect_content(40);
  EXPECT_EQ(sql("PRAGMA user_version"), "4");
  ok(store_->begin_transaction());
  write([&] { ok(insert_all({numbered(43), numbered(44), numbered(45), numbered(46)})); });
  expect_content(44);
  ok(store_->abort_transaction());
  expect_content(40);
  EXPECT_EQ(sql("PRAGMA user_version"), "4");
}

// Random sessions on a relation in row groups and on the same one in rows.
class RandomSessions : public RowGroupRelations, public testing::WithParamInterface<unsigned> {
 protected:
  struct Side {
    std::unique_ptr<Store> store;
    StoreOptions options;
    std::filesystem::path file;
  };

  void on(Side& side, const std::function<void()>& work) {
    std::swap(store_, side.store);
    work();
    std::swap(store_, side.store);
  }
  void open(Side& side) {
    side.store.reset();
    auto store = open_store(side.file, OpenMode::open_or_create, registry_, side.options);
    ASSERT_TRUE(store.ok()) << store.error().text();
    side.store = *std::move(store);
  }
  Tuple any_tuple() {
    const auto some = [&](std::string text) { return random_() % 6 == 0 ? "undefined" : text; };
    const int number = static_cast<int>(random_() % 50);
    return tuple({{"int", some(std::to_string(number))},
                  {"real", some(fmt::format("{}.5", number))},
                  {"string", some(fmt::format("\"{}\"", std::string(random_() % 4, 'x')))},
                  {"point3d", some(random_() % 9 == 0 ? "(1/3 0 0)" : fmt::format("({} 0 0)", number))}});
  }
  /// The ids, tuples, and what the index finds.
  std::vector<std::string> content() {
    std::vector<std::string> result = in_columns("R", {true, true, true, true}, 1 + random_size_ % 9);
    std::size_t row = 0;
    for (const TuplePtr& each : tuples(*relation("R")))
      EXPECT_EQ(result.at(row++), std::to_string(each->id) + " " + text(*each));
    EXPECT_EQ(row, result.size());
    EXPECT_EQ(*relation("R")->count(), static_cast<std::int64_t>(result.size()));
    const auto order = store_->read("R_A");
    const auto in_order = order->ordered_index()->entries().range(value("int", "10"), value("int", "30"));
    EXPECT_TRUE(in_order.ok());
    for (const TupleId id : *in_order) {
      const auto fetched = relation("R")->fetch(id);
      EXPECT_TRUE(fetched.ok() && *fetched != nullptr);
      result.push_back("in order: " + std::to_string(id) + " " + text(**fetched));
    }
    EXPECT_EQ(findings(), std::vector<std::string>{});
    return result;
  }
  void let_random(int count) {
    std::vector<Tuple> tuples_to_store;
    for (int i = 0; i < count; ++i) tuples_to_store.push_back(any_tuple());
    let_relation("R", "(tuple ((A int) (X real) (S string) (P point3d)))", tuples_to_store);
    let_order("R_A", "A", "int");
  }

  std::mt19937 random_{GetParam()};
  std::size_t random_size_ = 0;
};

TEST_P(RandomSessions, give_what_rows_give) {
  std::array<Side, 2> sides{Side{nullptr, kSmallGroups, path("groups.db")}, Side{nullptr, kNoGroups, path("rows.db")}};
  store_.reset();
  const auto seed = random_();
  for (Side& side : sides) {
    random_.seed(seed);
    open(side);
    on(side, [&] { write([&] { let_random(static_cast<int>(random_() % 40)); }); });
  }
  bool is_in_transaction = false;
  for (int step = 0; step < 40; ++step) {
    const auto step_seed = random_();
    std::array<std::vector<std::string>, 2> contents;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      random_.seed(step_seed);
      const auto kind = random_() % 8;
      if (kind == 0 && !is_in_transaction) open(sides[i]);
      on(sides[i], [&] {
        if (kind == 1) ok(is_in_transaction ? store_->abort_transaction() : store_->begin_transaction());
        if (kind == 2 && is_in_transaction) ok(store_->commit_transaction());
        ok(store_->begin(true));
        const auto all = tuples(*relation("R"));
        const auto any_id = [&] { return all[random_() % all.size()]->id; };
        // A scan that began before the changes.
        const auto scan = *relation("R")->scan();
        if (!all.empty()) {
          EXPECT_EQ(text(**scan->next()), text(*all[0]));
        }
        const int change_count = static_cast<int>(random_() % 12);
        std::set<TupleId> erased;
        for (int change = 0; change < change_count; ++change) {
          const auto what = random_() % 10;
          if (what < 4) {
            ASSERT_TRUE(relation("R")->insert(any_tuple()).ok());
          } else if (what == 4) {
            std::vector<Tuple> many;
            for (auto count = random_() % 25; count > 0; --count) many.push_back(any_tuple());
            ok(insert_all(many));
          } else if (!all.empty()) {
            const TupleId id = any_id();
            if (erased.contains(id)) continue;
            if (what < 7) erased.insert(id);
            ok(what < 7 ? relation("R")->erase(id) : relation("R")->update(id, any_tuple()));
          }
        }
        for (std::size_t row = 1; row < all.size(); ++row) {
          const auto next = scan->next();
          ASSERT_TRUE(next.ok()) << next.error().text();
          EXPECT_EQ(text(**next), text(*all[row]));
        }
        if (random_() % 5 == 0) {
          store_->rollback();
          ok(store_->begin(false));
        }
        ok(store_->commit());
        random_size_ = random_();
        read([&] { contents[i] = content(); });
      });
      if (i + 1 == sides.size() && kind == 1) is_in_transaction = !is_in_transaction;
      if (i + 1 == sides.size() && kind == 2) is_in_transaction = false;
    }
    ASSERT_EQ(contents[0], contents[1]) << "seed " << GetParam() << ", step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSessions, testing::Range(1U, 9U));

}  // namespace
}  // namespace queries
