// Transactions over several statements: each statement is whole or absent, and so is all of it.
#include <map>
#include <random>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class LongTransactions : public StoreTest {
 protected:
  LongTransactions() { reopen(); }

  Datum number(int value) { return Datum{Value::of(std::int64_t{value})}; }
  void expect_rows(Store& store, std::vector<int> parts) {
    std::vector<std::string> expected;
    for (const int each : parts) expected.push_back(text(part(each)));
    std::vector<std::string> found;
    ok(store.begin(false));
    for (const TuplePtr& each : tuples(*store.read("Parts")->relation())) found.push_back(text(*each));
    ok(store.commit());
    EXPECT_EQ(found, expected);
  }
  void expect_rows(std::vector<int> parts) { expect_rows(*store_, std::move(parts)); }
};

TEST_F(LongTransactions, a_commit_keeps_all_statements_and_others_see_them_only_then) {
  write([&] { let_parts(2); });
  const auto other = opened(OpenMode::read_write);
  ok(store_->begin_transaction());
  EXPECT_TRUE(store_->is_in_explicit_transaction());
  write([&] { ASSERT_TRUE(relation("Parts")->insert(part(7)).ok()); });
  write([&] { ok(relation("Parts")->erase(1)); });
  write([&] {
    ok(store_->create("x", "int"));
    ok(store_->assign("x", number(5), context_));
  });
  expect_rows({1, 7});
  expect_rows(*other, {0, 1});
  EXPECT_FALSE(other->find("x")->has_value());
  ok(store_->commit_transaction());
  EXPECT_FALSE(store_->is_in_explicit_transaction());
  expect_rows(*other, {1, 7});
  EXPECT_TRUE(other->find("x")->has_value());
  reopen();
  expect_rows({1, 7});
}

TEST_F(LongTransactions, an_abort_restores_everything) {
  write([&] {
    let_parts(3);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  read([&] { EXPECT_EQ(*index("I")->size(), 3U); });
  ok(store_->begin_transaction());
  write([&] { ok(relation("Parts")->update(2, part(8))); });
  write([&] { ok(store_->rename("Parts", "Teile")); });
  write([&] { ASSERT_TRUE(relation("Teile")->insert(part(9)).ok()); });
  read([&] { EXPECT_EQ(*index("I")->size(), 4U); });
  write([&] { ok(store_->create_type("t", type("(rel (tuple ((A int))))"))); });
  write([&] { ok(store_->remove("Teile")); });
  EXPECT_TRUE(store_->objects()->empty());
  ok(store_->abort_transaction());
  expect_rows({0, 1, 2});
  read([&] { EXPECT_EQ(*index("I")->size(), 3U); });
  EXPECT_TRUE(store_->types()->empty());
  write([&] { EXPECT_EQ(*relation("Parts")->insert(part(5)), 4); });
}

TEST_F(LongTransactions, a_statement_that_goes_back_leaves_those_before_it) {
  write([&] {
    let_parts(2);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  ok(store_->begin_transaction());
  write([&] { ASSERT_TRUE(relation("Parts")->insert(part(3)).ok()); });
  ok(store_->begin(true));
  ok(relation("Parts")->erase(1));
  ok(relation("Parts")->update(3, part(8)));
  ok(store_->create("x", "int"));
  store_->rollback();
  store_->rollback();
  expect_rows({0, 1, 3});
  EXPECT_FALSE(store_->find("x")->has_value());
  read([&] {
    std::vector<std::uint64_t> found;
    const auto tree = *index("I")->tree();
    for (const auto id : tree->window({{-1, -1, -1}, {100, 100, 100}})) found.push_back(id);
    EXPECT_EQ(found.size(), 3U);
  });
  ok(store_->commit_transaction());
  expect_rows({0, 1, 3});
}

TEST_F(LongTransactions, geometry_written_before_in_the_transaction_can_be_read_after_it_was_overwritten) {
  for (const std::uint64_t inline_bytes : {std::uint64_t{1} << 20, std::uint64_t{50}}) {
    std::filesystem::remove(path());
    reopen(OpenMode::open_or_create, {.inline_bytes = inline_bytes, .chunk_bytes = 100});
    write([&] { let_parts(2); });
    ok(store_->begin_transaction());
    write([&] {
      ok(relation("Parts")->update(1, part(11)));
      ASSERT_TRUE(relation("Parts")->insert(part(12)).ok());
      let_relation("New", "(tuple ((No int) (Solid volume3d)))", {part(20), part(21)});
    });
    read([&] {
      const RelationPtr parts = relation("Parts");
      const TuplePtr updated = *parts->fetch(1);
      const TuplePtr untouched = *parts->fetch(2);
      const TuplePtr inserted = *parts->fetch(3);
      const TuplePtr created = *relation("New")->fetch(1);
      ok(parts->update(1, part(31)));
      ok(parts->update(1, part(32)));
      ok(parts->erase(2));
      ok(parts->erase(3));
      ok(relation("New")->update(1, part(33)));
      ok(store_->remove("New"));
      EXPECT_EQ(text(*updated), text(part(11)));
      EXPECT_EQ(text(*untouched), text(part(1)));
      EXPECT_EQ(text(*inserted), text(part(12)));
      EXPECT_EQ(text(*created), text(part(20)));
    });
    ok(store_->abort_transaction());
    expect_rows({0, 1});
    store_.reset();
  }
}

TEST_F(LongTransactions, a_scan_sees_the_relation_as_at_its_beginning) {
  write([&] { let_parts(600); });
  ok(store_->begin_transaction());
  write([&] {
    for (int id = 1; id <= 600; id += 2) ok(relation("Parts")->update(id, part(1000 + id)));
  });
  const std::vector<std::string> before = [&] {
    ok(store_->begin(false));
    auto result = rows("Parts");
    ok(store_->commit());
    return result;
  }();
  read([&] {
    const RelationPtr parts = relation("Parts");
    const auto stream = *parts->scan();
    std::vector<std::string> found{text(**stream->next())};
    for (int id = 1; id <= 600; ++id) ok(id % 3 == 0 ? parts->erase(id) : parts->update(id, part(2000 + id)));
    while (true) {
      const auto next = stream->next();
      ASSERT_TRUE(next.ok()) << next.error().text();
      if (*next == nullptr) break;
      found.push_back(text(**next));
    }
    EXPECT_EQ(found, before);
  });
  ok(store_->commit_transaction());
}

TEST_F(LongTransactions, a_relation_assigned_from_itself_twice_keeps_its_geometry) {
  write([&] { let_parts(3); });
  ok(store_->begin_transaction());
  for (int round = 0; round < 3; ++round)
    write([&] { ok(store_->assign("Parts", store_->read("Parts").value(), context_)); });
  expect_rows({0, 1, 2});
  ok(store_->commit_transaction());
  expect_rows({0, 1, 2});
}

TEST_F(LongTransactions, wrong_use_is_an_error_that_says_so) {
  const auto expect_error = [](const Status& status, const std::string& message) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::wrong_usage);
    EXPECT_EQ(status.error().text(), message);
  };
  expect_error(store_->commit_transaction(), "no transaction is running; begin one with begin transaction");
  expect_error(store_->abort_transaction(), "no transaction is running; begin one with begin transaction");
  ok(store_->begin_transaction());
  expect_error(store_->begin_transaction(), "a transaction is running already; commit or abort it first");
  ok(store_->abort_transaction());
}

TEST_F(LongTransactions, a_second_writer_waits_and_is_then_told_while_readers_go_on) {
  write([&] { let_parts(1); });
  const auto other = opened(OpenMode::read_write, {.busy_milliseconds = 10});
  ok(store_->begin_transaction());
  const std::string busy =
      path().string() + ": writing: another process is writing to the database; try again when it has finished";
  EXPECT_EQ(other->begin_transaction().error().text(), busy);
  EXPECT_EQ(other->begin(true).error().text(), busy);
  EXPECT_FALSE(other->is_in_explicit_transaction());
  expect_rows(*other, {0});
  ok(store_->commit_transaction());
  ok(other->begin_transaction());
  ok(other->abort_transaction());
}

TEST_F(LongTransactions, a_store_opened_for_reading_sees_one_state_until_the_end) {
  write([&] { let_parts(1); });
  const auto reader = opened(OpenMode::read_only);
  ok(reader->begin_transaction());
  expect_rows(*reader, {0});
  write([&] { ok(relation("Parts")->erase(1)); });
  expect_rows(*reader, {0});
  EXPECT_EQ(reader->begin(true).error().code, ErrorCode::database_read_only);
  ok(reader->commit_transaction());
  expect_rows(*reader, {});
}

TEST_F(LongTransactions, closing_in_the_middle_is_an_abort) {
  write([&] { let_parts(1); });
  ok(store_->begin_transaction());
  write([&] { ok(relation("Parts")->erase(1)); });
  reopen();
  expect_rows({0});
}

TEST_F(LongTransactions, a_full_disk_undoes_the_statement_and_never_half_of_the_transaction) {
  write([&] { let_parts(3); });
  const std::int64_t pages = std::stoll(sql("PRAGMA page_count"));
  reopen(OpenMode::read_write, {.max_pages = pages + 20});
  ok(store_->begin_transaction());
  write([&] { ok(relation("Parts")->erase(1)); });
  ok(store_->begin(true));
  Status status;
  for (int i = 0; i < 10'000 && status; ++i) {
    const auto inserted = relation("Parts")->insert(part(i));
    if (!inserted) status = inserted.error();
  }
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::disk_full);
  store_->rollback();
  // Either the transaction goes on without the statement or it is gone and says so.
  if (const Status next = store_->begin(false); next) {
    store_->rollback();
    expect_rows({1, 2});
    write([&] { ok(relation("Parts")->erase(2)); });
    ok(store_->commit_transaction());
    expect_rows({2});
  } else {
    EXPECT_EQ(next.error().text(), path().string() +
                                       ": the transaction was undone when a statement in it failed; use "
                                       "abort transaction, then begin again");
    EXPECT_FALSE(store_->commit_transaction().ok());
    expect_rows({0, 1, 2});
  }
}

// Against a model: a map from tuple id to part number, copied where a statement or transaction begins.
TEST_F(LongTransactions, random_statements_agree_with_a_model) {
  write([&] {
    let_parts(5);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  using Model = std::map<TupleId, int>;
  Model committed;
  for (int i = 0; i < 5; ++i) committed[i + 1] = i;
  Model now = committed;
  std::mt19937 random(5);
  for (int step = 0; step < 300; ++step) {
    const auto chance = random() % 10;
    if (chance == 0 && !store_->is_in_explicit_transaction()) {
      ok(store_->begin_transaction());
    } else if (chance == 1 && store_->is_in_explicit_transaction()) {
      ok(store_->commit_transaction());
      committed = now;
    } else if (chance == 2 && store_->is_in_explicit_transaction()) {
      ok(store_->abort_transaction());
      now = committed;
    }
    Model next = now;
    ok(store_->begin(true));
    const RelationPtr parts = relation("Parts");
    for (auto changes = random() % 4; changes > 0; --changes) {
      const int number = static_cast<int>(random() % 1000);
      if (next.empty() || random() % 2 == 0) {
        next[*parts->insert(part(number))] = number;
        continue;
      }
      const auto chosen = std::next(next.begin(), static_cast<std::ptrdiff_t>(random() % next.size()));
      const TuplePtr old = *parts->fetch(chosen->first);
      const int old_number = chosen->second;
      if (random() % 2 == 0) {
        ok(parts->update(chosen->first, part(number)));
        chosen->second = number;
      } else {
        ok(parts->erase(chosen->first));
        next.erase(chosen);
      }
      // A tuple that this statement has itself written before may be lost, and says so.
      const auto loaded = old->attributes[1].loaded();
      if (loaded)
        EXPECT_EQ(text(*loaded), text(part(old_number).attributes[1]));
      else
        EXPECT_EQ(loaded.error().code, ErrorCode::wrong_usage) << loaded.error().text();
    }
    if (random() % 4 == 0) {
      store_->rollback();
    } else {
      ok(store_->commit());
      now = next;
      if (!store_->is_in_explicit_transaction()) committed = now;
    }
    std::vector<int> expected;
    for (const auto& [id, number] : now) expected.push_back(number);
    expect_rows(expected);
    read([&] { EXPECT_EQ(*index("I")->size(), now.size()); });
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace queries
