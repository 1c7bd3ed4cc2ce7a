// B-tree objects: definitions follow their relation, frozen copies do not.
#include <map>
#include <random>

#include "queries/streams/ordered_index.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoredOrderedIndexes : public StoreTest {
 protected:
  StoredOrderedIndexes() { reopen(); }

  std::shared_ptr<OrderedIndex> ordered(const std::string& name) {
    auto datum = store_->read(name);
    EXPECT_TRUE(datum.ok()) << (datum ? "" : datum.error().text());
    return datum ? datum->ordered_index() : nullptr;
  }
  void let_ordered(const std::string& name, const std::string& relation_name, const std::string& attribute,
                   const std::string& attribute_type) {
    ok(store_->create(name, TypeExpr("btree", {relation(relation_name)->tuple_type(), TypeExpr(attribute_type)})));
    ok(store_->assign(name,
                      Datum{std::make_shared<OrderedIndex>(relation_name, attribute, std::make_shared<OrderedTree>())},
                      context_));
  }
  Tuple row(int number, const std::string& word) {
    return tuple({{"int", number < 0 ? "undefined" : std::to_string(number)}, {"string", "\"" + word + "\""}});
  }
  void let_rows(int count) {
    std::vector<Tuple> content;
    for (int i = 0; i < count; ++i) content.push_back(row((i * 7) % count, "w" + std::to_string(i % 3)));
    let_relation("R", "(tuple ((No int) (Word string)))", content);
    let_ordered("N", "R", "No", "int");
    let_ordered("W", "R", "Word", "string");
  }
  /// What the index must hold, from the tuples themselves: text of the key and id, in the order of numbers or words.
  template <typename Key, typename KeyOf>
  static std::multimap<Key, TupleId> expected(const std::vector<TuplePtr>& stored, std::size_t attribute,
                                              KeyOf key_of) {
    std::multimap<Key, TupleId> result;
    for (const TuplePtr& each : stored)
      if (each->attributes[attribute].is_defined()) result.emplace(key_of(each->attributes[attribute]), each->id);
    return result;
  }
  template <typename Key>
  static std::vector<TupleId> ids(const std::multimap<Key, TupleId>& content) {
    std::vector<TupleId> result;
    for (const auto& [key, id] : content) result.push_back(id);
    return result;
  }
  void expect_indexes_equal_scan() {
    const auto stored = tuples(*relation("R"));
    const auto numbers = expected<int>(stored, 0, [](const Value& value) { return value.get<std::int64_t>(); });
    const auto words = expected<std::string>(stored, 1, [](const Value& value) { return value.get<std::string>(); });
    EXPECT_EQ(*ordered("N")->entries().range({}, {}), ids(numbers));
    EXPECT_EQ(*ordered("W")->entries().range({}, {}), ids(words));
  }
  void expect_sound() {
    const auto found = store_->check(context_, {});
    ASSERT_TRUE(found.ok()) << found.error().text();
    EXPECT_TRUE(found->empty()) << found->front().text();
  }
};

TEST_F(StoredOrderedIndexes, a_definition_is_remembered_and_built_when_it_is_used) {
  write([&] { let_rows(20); });
  for (int round = 0; round < 2; ++round) {
    read([&] {
      EXPECT_TRUE(ordered("N")->is_definition());
      EXPECT_EQ(ordered("N")->relation(), "R");
      EXPECT_EQ(ordered("N")->attribute(), "No");
      expect_indexes_equal_scan();
      const Value five = Value::of(std::int64_t{5});
      const auto found = *ordered("N")->entries().range(five, five);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(text((*relation("R")->fetch(found[0]))->attributes[0]), "5");
    });
    reopen();
  }
}

TEST_F(StoredOrderedIndexes, definitions_follow_inserts_updates_deletes_and_going_back) {
  write([&] { let_rows(30); });
  read([&] { expect_indexes_equal_scan(); });
  std::mt19937 random(9);
  for (int step = 0; step < 60; ++step) {
    const auto chance = random() % 8;
    if (chance == 0 && !store_->is_in_explicit_transaction()) ok(store_->begin_transaction());
    if (chance == 1 && store_->is_in_explicit_transaction()) ok(store_->commit_transaction());
    if (chance == 2 && store_->is_in_explicit_transaction()) ok(store_->abort_transaction());
    ok(store_->begin(true));
    for (int i = 0; i < 5; ++i) {
      const auto stored = tuples(*relation("R"));
      const Tuple fresh = row(static_cast<int>(random() % 40) - 5, "w" + std::to_string(random() % 5));
      const auto choice = stored.empty() ? 0 : random() % 3;
      const TupleId id = stored.empty() ? 0 : stored[random() % stored.size()]->id;
      if (choice == 0) {
        EXPECT_TRUE(relation("R")->insert(fresh).ok());
      }
      if (choice == 1) ok(relation("R")->update(id, fresh));
      if (choice == 2) ok(relation("R")->erase(id));
    }
    expect_indexes_equal_scan();
    if (random() % 3 == 0)
      store_->rollback();
    else
      ok(store_->commit());
    read([&] {
      expect_indexes_equal_scan();
      expect_sound();
    });
    if (HasFailure()) return;
  }
}

TEST_F(StoredOrderedIndexes, keys_may_be_geometry) {
  write([&] {
    let_parts(5);
    let_ordered("S", "Parts", "Solid", "volume3d");
  });
  read([&] { EXPECT_EQ(*ordered("S")->size(), 5U); });
  write([&] {
    ok(relation("Parts")->erase(2));
    ASSERT_TRUE(relation("Parts")->insert(part(9)).ok());
    const Value key = value("volume3d", solid(90));
    EXPECT_EQ(*ordered("S")->entries().range(key, key), std::vector<TupleId>{6});
    EXPECT_EQ(*ordered("S")->size(), 5U);
    expect_sound();
  });
}

TEST_F(StoredOrderedIndexes, definitions_go_with_their_relation_and_follow_its_name) {
  write([&] { let_rows(4); });
  write([&] { ok(store_->rename("R", "Q")); });
  read([&] {
    EXPECT_EQ(ordered("N")->relation(), "Q");
    EXPECT_EQ(*ordered("N")->size(), 4U);
  });
  write([&] { ok(store_->remove("Q")); });
  EXPECT_TRUE(store_->objects()->empty());
}

TEST_F(StoredOrderedIndexes, a_frozen_copy_keeps_its_entries_and_its_damage_is_found) {
  write([&] {
    let_rows(10);
    const auto copy = std::make_shared<OrderedTree>();
    for (const TuplePtr& each : tuples(*relation("R"))) copy->insert(each->attributes[1], each->id);
    ok(store_->create("F", TypeExpr("btree", {relation("R")->tuple_type(), TypeExpr("string")})));
    ok(store_->assign("F", Datum{std::make_shared<OrderedIndex>("", copy)}, context_));
    ok(relation("R")->erase(1));
  });
  reopen();
  read([&] {
    const auto frozen = ordered("F");
    EXPECT_FALSE(frozen->is_definition());
    EXPECT_EQ(*frozen->size(), 10U);
    const Value word = Value::of(std::string("w0"));
    EXPECT_EQ(*frozen->entries().range(word, word), (std::vector<TupleId>{1, 4, 7, 10}));
    expect_sound();
  });
  store_.reset();
  sql("UPDATE object_values SET value = substr(value, 1, length(value) - 1) || x'00'");
  reopen();
  read([&] { EXPECT_EQ(store_->read("F").error().text(), "F: the stored value is not what was written"); });
}

// The index lies in the file: SQLite has it as its own, and an answer does not read the other rows.
TEST_F(StoredOrderedIndexes, an_index_on_numbers_or_texts_is_sqlites) {
  write([&] { let_rows(2000); });
  EXPECT_EQ(sql("SELECT count(*) FROM sqlite_schema WHERE type = 'index' AND name LIKE 'order_%'"), "2");
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("UPDATE " + table + " SET checksum = checksum + 1 WHERE a1_No = 1000");
  reopen();
  read([&] {
    const Value five = Value::of(std::int64_t{5});
    EXPECT_EQ(ordered("N")->entries().range(five, five)->size(), 1U);
    EXPECT_EQ(ordered("N")->entries().range({}, five)->size(), 6U);
    EXPECT_EQ(*ordered("N")->size(), 2000U);
  });
}

TEST_F(StoredOrderedIndexes, kinds_of_keys) {
  write([&] {
    let_relation(
        "R", "(tuple ((No int) (Word string) (Real real) (Flag bool) (Note text)))",
        {tuple({{"int", "9007199254740993"}, {"string", "\"b\""}, {"real", "-0.0"}, {"bool", "TRUE"}, {"text", "'z'"}}),
         tuple({{"int", "-5"}, {"string", "\"\""}, {"real", "0.0"}, {"bool", "FALSE"}, {"text", "'a'"}}),
         tuple({{"int", "9007199254740992"},
                {"string", "\"ä\""},
                {"real", "1e300"},
                {"bool", "undefined"},
                {"text", "undefined"}}),
         tuple({{"int", "undefined"}, {"string", "\"B\""}, {"real", "-1e-300"}, {"bool", "TRUE"}, {"text", "'ab'"}})});
    let_ordered("N", "R", "No", "int");
    let_ordered("W", "R", "Word", "string");
    let_ordered("X", "R", "Real", "real");
    let_ordered("F", "R", "Flag", "bool");
    let_ordered("T", "R", "Note", "text");
  });
  using List = std::vector<TupleId>;
  read([&] {
    EXPECT_EQ(*ordered("N")->entries().range(Value::of(INT64_MIN), {}), (List{2, 3, 1}));
    const Value large = Value::of(std::int64_t{9007199254740993});
    EXPECT_EQ(*ordered("N")->entries().range(large, large), List{1});
    EXPECT_EQ(*ordered("W")->entries().range(Value::of(std::string()), {}), (List{2, 4, 1, 3}));
    const Value zero = Value::of(0.0);
    EXPECT_EQ(*ordered("X")->entries().range(zero, zero), (List{1, 2}));
    EXPECT_EQ(*ordered("X")->entries().range({}, zero), (List{4, 1, 2}));
    EXPECT_EQ(*ordered("F")->entries().range(Value::of(true), {}), (List{1, 4}));
    EXPECT_EQ(*ordered("T")->entries().range({}, Value::of(algebra3d::Text{"b"})), (List{2, 4}));
    EXPECT_EQ(*ordered("T")->size(), 3U);
    EXPECT_EQ(*ordered("N")->entries().range(Value::of(std::int64_t{3}), Value::of(std::int64_t{-3})), List{});
  });
}

// What neither SQLite nor the checksums of pages notice: keys in the pages of an index that are not those of the rows.
TEST_F(StoredOrderedIndexes, damaged_pages_are_found_and_made_anew) {
  write([&] { let_rows(600); });
  ASSERT_EQ(sql("PRAGMA wal_checkpoint(TRUNCATE)"), "0");
  const std::int64_t root =
      std::stoll(sql("SELECT rootpage FROM sqlite_schema WHERE type = 'index' AND name LIKE 'order_%_1'"));
  store_.reset();
  const std::string whole = bytes(path());
  const std::size_t begin = static_cast<std::size_t>(root - 1) * 4096;
  std::mt19937 random(3);
  int restored = 0;
  for (int round = 0; round < 150; ++round) {
    std::string damaged = whole;
    // The entries lie at the end of the page; the leaves of the tree follow its root.
    const std::size_t page = random() % 3;
    const std::size_t byte = begin + page * 4096 + 1500 + random() % 2500;
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << random() % 8));
    damaged = stamped(std::move(damaged));
    write_bytes(path(), damaged);
    std::filesystem::remove(path().string() + "-wal");
    std::filesystem::remove(path().string() + "-shm");
    reopen(OpenMode::read_write);
    read([&] {
      const auto stored = tuples(*relation("R"));
      for (std::int64_t low = 0; low < 600; low += 7) {
        const Value from = Value::of(low), to = Value::of(low + 3);
        std::vector<TupleId> expected;
        std::multimap<std::int64_t, TupleId> sorted;
        for (const TuplePtr& each : stored) sorted.emplace(each->attributes[0].get<std::int64_t>(), each->id);
        for (auto at = sorted.lower_bound(low); at != sorted.upper_bound(low + 3); ++at) expected.push_back(at->second);
        const auto ids = ordered("N")->entries().range(from, to);
        ASSERT_TRUE(ids.ok()) << ids.error().text();
        EXPECT_EQ(*ids, expected) << "byte " << byte << " from " << low;
      }
    });
    const bool was_damaged = bytes(path()) != damaged || std::filesystem::file_size(path().string() + "-wal") > 0;
    restored += was_damaged ? 1 : 0;
    store_.reset();
    if (HasFailure()) return;
  }
  EXPECT_GT(restored, 20);
}

TEST_F(StoredOrderedIndexes, a_missing_index_is_made_when_it_is_asked) {
  write([&] { let_rows(50); });
  store_.reset();
  const std::string name = sql("SELECT name FROM sqlite_schema WHERE type = 'index' AND name LIKE 'order_%_1'");
  sql("DROP INDEX " + name);
  reopen(OpenMode::read_only);
  read([&] { expect_indexes_equal_scan(); });
  reopen(OpenMode::read_write);
  // What asks makes it, and later checks find it.
  read([&] { expect_indexes_equal_scan(); });
  read([&] { expect_sound(); });
  EXPECT_EQ(sql("SELECT count(*) FROM sqlite_schema WHERE name = '" + name + "'"), "1");
  write([&] { ok(store_->remove("N")); });
  EXPECT_EQ(sql("SELECT count(*) FROM sqlite_schema WHERE name = '" + name + "'"), "0");
  read([&] { expect_sound(); });
}

TEST_F(StoredOrderedIndexes, an_index_on_another_column_is_found) {
  write([&] { let_rows(5); });
  store_.reset();
  const std::string name = sql("SELECT name FROM sqlite_schema WHERE type = 'index' AND name LIKE 'order_%_1'");
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("DROP INDEX " + name + "; CREATE INDEX " + name + " ON " + table + "(a2_Word)");
  reopen();
  read([&] {
    const auto found = store_->check(context_, {});
    ASSERT_EQ(found->size(), 1U);
    EXPECT_EQ(found->front().text(), "R: 'No': the index " + name + " is not as it was made");
  });
}

}  // namespace
}  // namespace queries
