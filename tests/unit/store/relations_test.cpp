// Stored relations: changes, ids, scans that alternate with changes, lazy geometry.
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoredRelations : public StoreTest {
 protected:
  StoredRelations() { reopen(); }

  std::vector<TupleId> ids(const std::string& name) {
    std::vector<TupleId> result;
    for (const TuplePtr& each : tuples(*relation(name))) result.push_back(each->id);
    return result;
  }
  void let_numbers(int count) {
    std::vector<Tuple> content;
    for (int i = 1; i <= count; ++i) content.push_back(tuple({{"int", std::to_string(i)}}));
    let_relation("N", "(tuple ((A int)))", content);
  }
};

TEST_F(StoredRelations, insert_erase_and_update_change_what_a_scan_gives) {
  write([&] { let_numbers(3); });
  read([&] {
    const auto n = relation("N");
    EXPECT_EQ(*n->insert(tuple({{"int", "4"}})), 4);
    ok(n->erase(2));
    ok(n->update(3, tuple({{"int", "33"}})));
    EXPECT_EQ(*n->count(), 3);
    const ChangeCounts counts = store_->change_counts();
    EXPECT_EQ(counts.inserted, 1U);  // what `assign` wrote does not count
    EXPECT_EQ(counts.deleted, 1U);
    EXPECT_EQ(counts.updated, 1U);
  });
  reopen(OpenMode::read_write);
  read([&] {
    EXPECT_EQ(rows("N"), (std::vector<std::string>{"1", "33", "4"}));
    EXPECT_EQ(ids("N"), (std::vector<TupleId>{1, 3, 4}));
    EXPECT_EQ(*relation("N")->count(), 3);
    EXPECT_EQ(*relation("N")->fetch(2), nullptr);
    EXPECT_EQ(text(**relation("N")->fetch(3)), "33");
    EXPECT_EQ(relation("N")->name(), "N");
  });
}

TEST_F(StoredRelations, an_error_names_the_tuple_that_is_not_there) {
  write([&] { let_numbers(1); });
  ok(store_->begin(true));
  EXPECT_EQ(relation("N")->erase(7).error().text(), "N: there is no tuple 7");
  // A statement in which a change failed cannot be committed.
  EXPECT_EQ(store_->commit().error().text(), "N: there is no tuple 7");
}

TEST_F(StoredRelations, ids_are_not_used_again) {
  write([&] { let_numbers(3); });
  write([&] { ok(relation("N")->erase(3)); });
  reopen(OpenMode::read_write);
  write([&] { EXPECT_EQ(*relation("N")->insert(tuple({{"int", "9"}})), 4); });
  write([&] { ok(store_->assign("N", store_->read("N").value(), context_)); });
  read([&] { EXPECT_EQ(ids("N"), (std::vector<TupleId>{5, 6, 7})); });
}

TEST_F(StoredRelations, a_scan_sees_the_relation_as_at_its_first_tuple) {
  write([&] { let_numbers(1000); });
  write([&] {
    const auto n = relation("N");
    auto stream = *n->scan();
    std::vector<std::string> seen{text(**stream->next())};
    ok(n->erase(700));
    ok(n->update(800, tuple({{"int", "-1"}})));
    ok(n->update(800, tuple({{"int", "-2"}})));
    EXPECT_EQ(*n->insert(tuple({{"int", "1001"}})), 1001);
    while (const TuplePtr next = *stream->next()) seen.push_back(text(*next));
    ASSERT_EQ(seen.size(), 1000U);
    for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(seen[i], std::to_string(i + 1));
    EXPECT_EQ(tuples(*n).size(), 1000U);
  });
}

TEST_F(StoredRelations, several_scans_run_side_by_side) {
  write([&] { let_numbers(300); });
  read([&] {
    const auto n = relation("N");
    const auto outer = *n->scan();
    std::size_t pairs = 0;
    for (int i = 0; i < 3; ++i) {
      ASSERT_NE(*outer->next(), nullptr);
      pairs += tuples(*n).size();
    }
    EXPECT_EQ(pairs, 900U);
  });
}

// A function of SQLite takes 126 columns; a point has eight.
TEST_F(StoredRelations, rows_of_any_number_of_columns_are_scanned) {
  for (const int count : {15, 16, 40}) {
    const std::string name = "Wide" + std::to_string(count);
    std::string type = "(tuple (";
    for (int i = 0; i < count; ++i) type += fmt::format("(P{} point3d)", i);
    std::vector<Tuple> content;
    for (int row = 0; row < 600; ++row)
      content.push_back(tuple(std::vector<std::pair<std::string, std::string>>(
          static_cast<std::size_t>(count), {"point3d", fmt::format("({}.5 0.0 0.0)", row)})));
    write([&] { let_relation(name, type + "))", content); });
    read([&] {
      const auto stored = rows(name);
      ASSERT_EQ(stored.size(), 600U);
      for (std::size_t row = 0; row < stored.size(); ++row) EXPECT_EQ(stored[row], text(content[row]));
    });
  }
}

TEST_F(StoredRelations, a_relation_can_be_assigned_from_itself) {
  write([&] { let_parts(4); });
  write([&] { ok(store_->assign("Parts", store_->read("Parts").value(), context_)); });
  read([&] {
    EXPECT_EQ(rows("Parts").size(), 4U);
    EXPECT_EQ(rows("Parts")[3], text(part(3)));
  });
}

TEST_F(StoredRelations, removed_and_made_again_from_its_own_tuples_nothing_is_lost) {
  write([&] { let_parts(3); });
  write([&] {
    const TypeExpr tuple_type = relation("Parts")->tuple_type();
    const auto kept = std::make_shared<MemoryRelation>(tuple_type, TupleBuffer(tuples(*relation("Parts"))));
    ok(store_->remove("Parts"));
    ok(store_->create("Parts", TypeExpr::rel(tuple_type)));
    ok(store_->assign("Parts", Datum{RelationPtr(kept)}, context_));
  });
  read([&] { EXPECT_EQ(rows("Parts")[2], text(part(2))); });
}

TEST_F(StoredRelations, boxes_and_counts_read_no_geometry) {
  write([&] { let_parts(500); });
  reopen(OpenMode::read_write);
  read([&] {
    int hits = 0;
    for (const TuplePtr& each : tuples(*relation("Parts"))) {
      const auto header = each->attributes[1].header();
      EXPECT_EQ(header.size, 4U);
      hits += header.box.intersects({{100, 0, 0}, {200, 1, 1}});
    }
    EXPECT_EQ(hits, 11);
    EXPECT_EQ(store_->geometry_loads(), 0U);
  });
}

TEST_F(StoredRelations, copying_a_relation_decodes_nothing) {
  write([&] { let_parts(20); });
  write([&] {
    const TypeExpr rel = store_->find("Parts")->value().type;
    ok(store_->create("Copy", rel));
    ok(store_->assign("Copy", store_->read("Parts").value(), context_));
  });
  EXPECT_EQ(store_->geometry_loads(), 0U);
  read([&] { EXPECT_EQ(rows("Copy"), rows("Parts")); });
}

TEST_F(StoredRelations, loaded_geometry_is_kept_until_it_changes) {
  write([&] { let_parts(2); });
  const auto first = [&] { return text(tuples(*relation("Parts"))[0]->attributes[1]); };
  read([&] { first(); });
  read([&] { first(); });
  EXPECT_EQ(store_->geometry_loads(), 1U);
  write([&] { ok(relation("Parts")->update(1, part(7))); });
  read([&] { EXPECT_EQ(first(), text(part(7).attributes[1])); });
  EXPECT_EQ(store_->geometry_loads(), 2U);
  ok(store_->begin(true));
  ok(relation("Parts")->update(1, part(8)));
  EXPECT_EQ(first(), text(part(8).attributes[1]));
  store_->rollback();
  read([&] { EXPECT_EQ(first(), text(part(7).attributes[1])); });
}

TEST_F(StoredRelations, the_cache_keeps_no_more_than_its_limit) {
  const StoreOptions small{.cache_bytes = 2000};
  reopen(OpenMode::open_or_create, small);
  write([&] { let_parts(20); });
  read([&] { rows("Parts"); });
  EXPECT_EQ(store_->geometry_loads(), 20U);
  // What came first stays, or a repeated scan would find nothing.
  read([&] { text(tuples(*relation("Parts"))[0]->attributes[1]); });
  EXPECT_EQ(store_->geometry_loads(), 20U);
  read([&] { text(tuples(*relation("Parts"))[10]->attributes[1]); });
  EXPECT_EQ(store_->geometry_loads(), 21U);
}

TEST_F(StoredRelations, a_deferred_value_outlives_the_change_of_its_tuple) {
  write([&] { let_parts(3); });
  write([&] {
    const auto parts = relation("Parts");
    const auto before = tuples(*parts);
    ok(parts->erase(1));
    ok(parts->update(2, part(9)));
    EXPECT_EQ(text(*before[0]), text(part(0)));
    EXPECT_EQ(text(*before[1]), text(part(1)));
    EXPECT_EQ(text(**parts->fetch(2)), text(part(9)));
    EXPECT_EQ(text(*before[2]), text(part(2)));
  });
}

TEST_F(StoredRelations, what_was_made_and_changed_in_one_statement_is_an_error_not_wrong) {
  write([&] { let_parts(1); });
  ok(store_->begin(true));
  const auto parts = relation("Parts");
  ok(parts->update(1, part(5)));
  const Value between = (*parts->fetch(1))->attributes[1];
  ok(parts->update(1, part(6)));
  EXPECT_EQ(between.loaded().error().text(),
            "Parts: tuple 1 was made and changed again by the statement that still reads it; use two statements");
  store_->rollback();
}

TEST_F(StoredRelations, deferred_values_end_with_their_statement_and_with_the_store) {
  write([&] { let_parts(1); });
  std::vector<TuplePtr> kept;
  RelationPtr parts;
  read([&] {
    parts = relation("Parts");
    kept = tuples(*parts);
  });
  EXPECT_EQ(kept[0]->attributes[1].loaded().error().code, ErrorCode::internal);
  read([&] { EXPECT_FALSE(parts->scan().ok()); });
  store_.reset();
  EXPECT_EQ(kept[0]->attributes[1].loaded().error().code, ErrorCode::internal);
}

TEST_F(StoredRelations, a_relation_of_too_many_attributes_is_refused) {
  std::string tuple_type = "(tuple (";
  for (int i = 0; i < 300; ++i) tuple_type += fmt::format("(A{} volume3d)", i);
  write([&] {
    const auto status = store_->create("R", TypeExpr::rel(type(tuple_type + "))")));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().text(), "R: the 300 attributes need 2702 columns, a table has at most 1900");
  });
}

}  // namespace
}  // namespace queries
