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
    EXPECT_TRUE(datum.ok()) << (datum ? "" : datum.error().message);
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
    EXPECT_EQ(ordered("N")->tree().range({}, {}), ids(numbers));
    EXPECT_EQ(ordered("W")->tree().range({}, {}), ids(words));
  }
  void expect_sound() {
    const auto found = store_->check(context_, {});
    ASSERT_TRUE(found.ok()) << found.error().message;
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
      const auto found = ordered("N")->tree().range(five, five);
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
    // Whoever holds the index sees it as it was.
    const auto held = ordered("N");
    const auto before = held->tree().range({}, {});
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
    EXPECT_EQ(held->tree().range({}, {}), before);
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
  read([&] { EXPECT_EQ(ordered("S")->tree().size(), 5U); });
  write([&] {
    ok(relation("Parts")->erase(2));
    ASSERT_TRUE(relation("Parts")->insert(part(9)).ok());
    const Value key = value("volume3d", solid(90));
    EXPECT_EQ(ordered("S")->tree().range(key, key), std::vector<TupleId>{6});
    EXPECT_EQ(ordered("S")->tree().size(), 5U);
    expect_sound();
  });
}

TEST_F(StoredOrderedIndexes, definitions_go_with_their_relation_and_follow_its_name) {
  write([&] { let_rows(4); });
  write([&] { ok(store_->rename("R", "Q")); });
  read([&] {
    EXPECT_EQ(ordered("N")->relation(), "Q");
    EXPECT_EQ(ordered("N")->tree().size(), 4U);
  });
  write([&] { ok(store_->remove("Q")); });
  EXPECT_TRUE(store_->objects()->empty());
}

TEST_F(StoredOrderedIndexes, a_frozen_copy_keeps_its_entries_and_its_damage_is_found) {
  write([&] {
    let_rows(10);
    const auto copy = std::make_shared<OrderedTree>(ordered("W")->tree());
    ok(store_->create("F", TypeExpr("btree", {relation("R")->tuple_type(), TypeExpr("string")})));
    ok(store_->assign("F", Datum{std::make_shared<OrderedIndex>("", "", copy)}, context_));
    ok(relation("R")->erase(1));
  });
  reopen();
  read([&] {
    const auto frozen = ordered("F");
    EXPECT_FALSE(frozen->is_definition());
    EXPECT_EQ(frozen->tree().size(), 10U);
    const Value word = Value::of(std::string("w0"));
    EXPECT_EQ(frozen->tree().range(word, word), (std::vector<TupleId>{1, 4, 7, 10}));
    expect_sound();
  });
  store_.reset();
  sql("UPDATE object_values SET value = substr(value, 1, length(value) - 1) || x'00'");
  reopen();
  read([&] { EXPECT_EQ(store_->read("F").error().message, "F: the stored value is not what was written"); });
}

TEST_F(StoredOrderedIndexes, an_index_in_memory_that_missed_a_change_is_found) {
  write([&] { let_rows(4); });
  read([&] {
    ordered("N")->tree().insert(Value::of(std::int64_t{77}), 2);
    const auto found = store_->check(context_, {});
    ASSERT_EQ(found->size(), 1U);
    EXPECT_EQ(found->front().text(), "R: 'No': the ordered index in memory does not have the values of the relation");
  });
}

}  // namespace
}  // namespace queries
