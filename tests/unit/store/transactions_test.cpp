// All or nothing: rollback, two processes, a full disk, a process that ends in the middle.
#include <sys/wait.h>
#include <unistd.h>

#include "base/propagate.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoreTransactions : public StoreTest {
 protected:
  StoreTransactions() { reopen(); }

  Value number(int value) { return Value::of(std::int64_t{value}); }
  void let_number(const std::string& name, int value) {
    ok(store_->create(name, "int"));
    ok(store_->assign(name, Datum{number(value)}, context_));
  }
  std::vector<std::string> rows_now() {
    std::vector<std::string> result;
    read([&] { result = rows("Parts"); });
    return result;
  }
  /// Gives Parts this many other tuples, as one statement.
  Status replaced(int count) {
    std::vector<TuplePtr> content;
    for (int i = 0; i < count; ++i) content.push_back(std::make_shared<const Tuple>(part(100 + i)));
    const TypeExpr tuple_type = type("(tuple ((No int) (Solid volume3d)))");
    const auto relation = std::make_shared<MemoryRelation>(tuple_type, TupleBuffer(std::move(content)));
    A3D_TRY(store_->begin(true));
    Status status = store_->assign("Parts", Datum{RelationPtr(relation)}, context_);
    const Status end = store_->commit();
    return status ? end : status;
  }
  Status replaced_in_transaction(int count) {
    A3D_TRY(store_->begin_transaction());
    Status status = replaced(count);
    if (status) return store_->commit_transaction();
    // As a script goes on: what follows the failure must not become lasting by itself.
    EXPECT_TRUE(!replaced(1) || store_->is_in_explicit_transaction());
    ok(store_->abort_transaction());
    return status;
  }
};

TEST_F(StoreTransactions, a_rollback_restores_objects_tuples_and_ids) {
  write([&] {
    let_number("x", 1);
    let_parts(3);
  });
  ok(store_->begin(true));
  ok(store_->assign("x", Datum{number(2)}, context_));
  let_number("y", 3);
  ok(relation("Parts")->erase(1));
  EXPECT_EQ(*relation("Parts")->insert(part(9)), 4);
  ok(store_->remove("x"));
  store_->rollback();
  store_->rollback();
  read([&] {
    EXPECT_EQ(text(store_->read("x")->value()), "1");
    EXPECT_FALSE(store_->find("y")->has_value());
    EXPECT_EQ(rows("Parts"), (std::vector<std::string>{text(part(0)), text(part(1)), text(part(2))}));
    EXPECT_EQ(*relation("Parts")->insert(part(5)), 4);
  });
}

TEST_F(StoreTransactions, the_log_is_emptied_once_no_reader_needs_it) {
  write([&] { let_parts(2); });
  const auto log_bytes = [&] { return std::filesystem::file_size(path().string() + "-wal"); };
  const auto reader = opened(OpenMode::read_write);
  ok(reader->begin(false));
  EXPECT_EQ(*reader->read("Parts")->relation()->count(), 2);
  ok(replaced(3));
  EXPECT_GT(log_bytes(), 0);
  EXPECT_FALSE(*store_->empty_log(20));
  EXPECT_GT(log_bytes(), 0);
  EXPECT_EQ(*reader->read("Parts")->relation()->count(), 2);
  ok(reader->commit());
  EXPECT_TRUE(*store_->empty_log(20));
  EXPECT_EQ(log_bytes(), 0);
  EXPECT_EQ(rows_now().size(), 3);
  ok(replaced(4));
  ok(store_->begin(true));
  EXPECT_FALSE(*reader->empty_log(20)) << "a writer is in the way";
  store_->rollback();
  EXPECT_FALSE(*opened(OpenMode::read_only)->empty_log(20));
  EXPECT_EQ(rows_now().size(), 4);
}

TEST_F(StoreTransactions, changes_outside_a_transaction_are_refused) {
  EXPECT_EQ(store_->create("x", "int").error().code, ErrorCode::internal);
  EXPECT_EQ(store_->read("x").error().code, ErrorCode::internal);
  EXPECT_EQ(store_->commit().error().code, ErrorCode::internal);
  ok(store_->begin(false));
  EXPECT_EQ(store_->begin(false).error().code, ErrorCode::internal);
  ok(store_->commit());
}

TEST_F(StoreTransactions, two_connections_see_what_the_other_has_committed) {
  write([&] { let_parts(2); });
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(false));
  EXPECT_EQ(*other->read("Parts")->relation()->count(), 2);
  write([&] { ok(relation("Parts")->update(1, part(5))); });
  // Still the state in which its statement began.
  EXPECT_EQ(text(**other->read("Parts")->relation()->fetch(1)), text(part(0)));
  ok(other->commit());
  ok(other->begin(false));
  EXPECT_EQ(text(**other->read("Parts")->relation()->fetch(1)), text(part(5)));
  ok(other->commit());
}

TEST_F(StoreTransactions, one_writes_and_the_other_is_told_to_wait) {
  write([&] { let_number("x", 1); });
  const auto other = opened(OpenMode::read_write, {.busy_milliseconds = 10});
  ok(store_->begin(true));
  const auto status = other->begin(true);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::database_busy);
  EXPECT_EQ(status.error().text(), path().string() +
                                       ": writing: another process is writing to the database; try again when it has "
                                       "finished");
  store_->rollback();
  ok(other->begin(true));
  other->rollback();
}

TEST_F(StoreTransactions, a_reader_that_turns_writer_too_late_is_told_to_run_again) {
  write([&] { let_parts(1); });
  const auto other = opened(OpenMode::read_write, {.busy_milliseconds = 10});
  ok(other->begin(false));
  write([&] { ok(relation("Parts")->erase(1)); });
  const auto inserted = other->read("Parts")->relation()->insert(part(2));
  ASSERT_FALSE(inserted.ok());
  EXPECT_EQ(inserted.error().code, ErrorCode::database_busy);
  EXPECT_NE(inserted.error().text().find("run it again"), std::string::npos) << inserted.error().text();
  EXPECT_FALSE(other->commit().ok());
  ok(other->begin(false));
  EXPECT_EQ(*other->read("Parts")->relation()->count(), 0);
  ok(other->commit());
}

TEST_F(StoreTransactions, a_full_disk_changes_nothing) {
  write([&] { let_parts(3); });
  const std::int64_t pages = std::stoll(sql("PRAGMA page_count"));
  reopen(OpenMode::read_write, {.max_pages = pages + 5});
  ok(store_->begin(true));
  Status status;
  for (int i = 0; i < 10'000 && status; ++i) {
    const auto inserted = relation("Parts")->insert(part(i));
    if (!inserted) status = inserted.error();
  }
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::disk_full);
  EXPECT_EQ(status.error().text(), path().string() + ": writing: the disk is full");
  EXPECT_FALSE(store_->create("x", "int").ok());
  EXPECT_EQ(store_->commit().error().code, ErrorCode::disk_full);
  read([&] { EXPECT_EQ(rows("Parts").size(), 3U); });
  reopen(OpenMode::read_write);
  read([&] { EXPECT_EQ(rows("Parts").size(), 3U); });
  EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
}

// Where the room ends within a statement, SQLite may roll back the whole transaction, also while an index is written,
// which alone could be done without.
TEST_F(StoreTransactions, wherever_the_disk_is_full_a_statement_is_whole_or_absent) {
  write([&] {
    let_parts(3);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  const std::vector<std::string> before = rows_now();
  store_.reset();
  const std::string original = bytes(path());
  const std::int64_t pages = std::stoll(sql("PRAGMA page_count"));
  int refused = 0;
  for (const bool is_in_transaction : {false, true})
    for (int room = 0; room < 30; ++room) {
      SCOPED_TRACE(room);
      store_.reset();
      write_bytes(path(), original);
      reopen(OpenMode::read_write, {.page_cache_kilobytes = 1, .max_pages = pages + room});
      const Status status = is_in_transaction ? replaced_in_transaction(60) : replaced(60);
      refused += status ? 0 : 1;
      if (!status) {
        EXPECT_EQ(status.error().code, ErrorCode::disk_full) << status.error().text();
      }
      reopen(OpenMode::read_write);
      EXPECT_EQ(rows_now().size(), status ? 60U : before.size());
      EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
    }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, 60);
}

TEST_F(StoreTransactions, a_process_that_ends_in_the_middle_leaves_the_last_commit) {
  write([&] { let_parts(2); });
  store_.reset();
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto store = Store::open(path(), OpenMode::read_write, registry_);
    if (!store || !(*store)->begin(true)) ::_exit(1);
    auto parts = (*store)->read("Parts")->relation();
    for (int i = 0; i < 200; ++i)
      if (!parts->insert(part(i))) ::_exit(2);
    if (!parts->erase(1) || !(*store)->commit() || !(*store)->begin(true)) ::_exit(3);
    if (!parts->erase(2)) ::kill(::getpid(), SIGKILL);
    ::kill(::getpid(), SIGKILL);
  }
  int outcome = 0;
  ASSERT_EQ(::waitpid(child, &outcome, 0), child);
  ASSERT_TRUE(WIFSIGNALED(outcome));
  reopen(OpenMode::read_write);
  read([&] {
    const auto stored = rows("Parts");
    ASSERT_EQ(stored.size(), 201U);
    EXPECT_EQ(stored[0], text(part(1)));
  });
}

TEST_F(StoreTransactions, an_interrupted_assignment_changes_nothing) {
  write([&] { let_parts(2); });
  std::atomic<bool> cancel = true;
  const Context cancelled{diagnostics_, &cancel, {}};
  ok(store_->begin(true));
  const auto status = store_->assign("Parts", store_->read("Parts").value(), cancelled);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
  store_->rollback();
  read([&] { EXPECT_EQ(rows("Parts").size(), 2U); });
}

}  // namespace
}  // namespace queries
