// Several processes on one file, and disks that become full in the middle of a statement.
//
// Clocks that jump do not matter, since no part of the store reads one: whether another process has written is told by
// SQLite's change counter, whether a file was imported by its size and hash, what is newest by ascending numbers, and a
// statement that waits for another one counts how long it has slept.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "base/propagate.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoreProcesses : public StoreTest {
 protected:
  static Datum number(int value) { return Datum{Value::of(std::int64_t{value})}; }

  /// Runs `work` in another process, which tells by its exit status whether all went well.
  template <typename Work>
  pid_t start(Work work) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(work());
    return child;
  }
  static int outcome(pid_t child) {
    int status = -1;
    ::waitpid(child, &status, 0);
    return status;
  }

  // Two numbers that every statement changes together, and a relation with as many tuples.
  void let_counters() {
    write([&] {
      ok(store_->create("a", "int"));
      ok(store_->create("b", "int"));
      ok(store_->assign("a", number(0), context_));
      ok(store_->assign("b", number(0), context_));
      let_relation("R", "(tuple ((No int) (Solid volume3d)))", {});
    });
  }
  Status count_once(Store& store) {
    A3D_ASSIGN(const Datum a, store.read("a"));
    const int next = static_cast<int>(a.value().get<std::int64_t>()) + 1;
    A3D_TRY(store.assign("a", number(next), context_));
    A3D_ASSIGN(const Datum relation, store.read("R"));
    A3D_TRY(relation.relation()->insert(part(next)));
    return store.assign("b", number(next), context_);
  }
  /// Writes `count` statements, every fourth as a transaction of two, every fifth undone. The exit status.
  int write_counts(int count) {
    auto opened_store = open_store(path(), OpenMode::read_write, registry_, {.busy_milliseconds = 60'000});
    if (!opened_store) return 1;
    Store& store = **opened_store;
    for (int i = 0; i < count; ++i) {
      const bool is_long = i % 4 == 0;
      if (is_long && !(store.begin_transaction() && store.begin(true) && count_once(store) && store.commit())) return 2;
      if (!store.begin(true) || !count_once(store)) return 3;
      if (i % 5 == 0)
        store.rollback();
      else if (!store.commit())
        return 4;
      if (is_long && !(i % 5 == 0 ? store.abort_transaction() : store.commit_transaction())) return 5;
    }
    return 0;
  }
  static int counted(int count) {
    int result = 0;
    for (int i = 0; i < count; ++i) result += i % 5 == 0 ? 0 : i % 4 == 0 ? 2 : 1;
    return result;
  }
  /// The state that a reader sees, which must be one that a statement has left: the number, or what is wrong.
  Result<int> consistent_count(Store& store) {
    A3D_TRY(store.begin(false));
    A3D_ASSIGN(const Datum a, store.read("a"));
    A3D_ASSIGN(const Datum relation, store.read("R"));
    A3D_ASSIGN(const auto stream, relation.relation()->scan());
    int tuples_seen = 0;
    while (true) {
      A3D_ASSIGN(const TuplePtr tuple, stream->next());
      if (tuple == nullptr) break;
      ++tuples_seen;
      A3D_ASSIGN(const Value solid, tuple->attributes[1].loaded());
      if (tuple->attributes[0].get<std::int64_t>() != tuples_seen)
        return Error{ErrorCode::internal, "tuple {} has number {}", tuples_seen, text(tuple->attributes[0])};
    }
    A3D_ASSIGN(const Datum b, store.read("b"));
    A3D_TRY(store.commit());
    const auto first = static_cast<int>(a.value().get<std::int64_t>());
    if (first != b.value().get<std::int64_t>() || first != tuples_seen)
      return Error{ErrorCode::internal, "{}, {} and {} tuples", first, text(b.value()), tuples_seen};
    return first;
  }
};

TEST_F(StoreProcesses, two_write_and_others_read_whole_statements_without_waiting) {
  reopen();
  let_counters();
  store_.reset();
  constexpr int kWriters = 2;
  constexpr int kStatements = 60;
  std::vector<pid_t> writers;
  for (int i = 0; i < kWriters; ++i) writers.push_back(start([&] { return write_counts(kStatements); }));
  // A busy timeout of 0: whoever had to wait would get an error.
  auto reader = opened(OpenMode::read_only, {.busy_milliseconds = 0});
  const int expected = kWriters * counted(kStatements);
  int last = 0;
  for (int round = 0; last < expected && round < 100'000; ++round) {
    const auto seen = consistent_count(*reader);
    ASSERT_TRUE(seen.ok()) << seen.error().text();
    ASSERT_GE(*seen, last);
    last = *seen;
    ::usleep(1000);
  }
  for (const pid_t writer : writers) EXPECT_EQ(outcome(writer), 0);
  EXPECT_EQ(last, expected);
  EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
}

TEST_F(StoreProcesses, indexes_and_geometry_in_memory_notice_what_another_process_writes) {
  reopen();
  write([&] {
    let_parts(5);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  read([&] {
    EXPECT_EQ(*index("I")->size(), 5U);
    EXPECT_EQ(rows("Parts").size(), 5U);
  });
  const int status = outcome(start([&] {
    auto other = Store::open(path(), OpenMode::read_write, registry_);
    if (!other || !(*other)->begin(true)) return 1;
    const auto parts = (*other)->read("Parts");
    if (!parts || !parts->relation()->erase(1) || !parts->relation()->update(2, part(40))) return 2;
    return (*other)->commit() ? 0 : 3;
  }));
  ASSERT_EQ(status, 0);
  read([&] {
    EXPECT_EQ(rows("Parts"), (std::vector<std::string>{text(part(40)), text(part(2)), text(part(3)), text(part(4))}));
    std::vector<std::uint64_t> far_away;
    const auto tree = *index("I")->tree();
    for (const auto id : tree->window({{399, -1, -1}, {500, 2, 2}})) far_away.push_back(id);
    EXPECT_EQ(far_away, std::vector<std::uint64_t>{2});
  });
}

// The system refuses to make files longer than a limit, which is what a full disk does to the log of the database.
class FullDisk : public StoreProcesses {
 protected:
  FullDisk() {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() override { make_room(); }
  void fill_disk(std::uintmax_t largest_file) {
    rlimit limit = before_;
    limit.rlim_cur = static_cast<rlim_t>(largest_file);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  void make_room() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  std::uintmax_t log_bytes() const {
    std::error_code error;
    const auto size = std::filesystem::file_size(path().string() + "-wal", error);
    return error ? 0 : size;
  }
  std::string contents() {
    std::string result;
    read([&] {
      for (const std::string& row : rows("Parts")) result += row + "\n";
      const auto objects = store_->objects();
      for (const ObjectInfo& info : *objects) result += info.name + "\n";
    });
    return result;
  }
  void expect_sound() {
    ok(store_->begin(false));
    const auto found = store_->check(context_, {});
    ASSERT_TRUE(found.ok()) << found.error().text();
    EXPECT_TRUE(found->empty()) << found->front().text();
    store_->rollback();
  }
  /// Statements of every kind, some larger than others.
  Status change_something(std::mt19937& random, int round) {
    A3D_ASSIGN(const Datum datum, store_->read("Parts"));
    Relation& parts = *datum.relation();
    const int many = static_cast<int>(random() % 40);
    switch (random() % 4) {
      case 0:
        for (int i = 0; i < many; ++i) A3D_TRY(parts.insert(part(i)));
        return {};
      case 1: {
        std::vector<TupleId> ids;
        for (const TuplePtr& each : tuples(parts)) ids.push_back(each->id);
        for (const TupleId id : ids) A3D_TRY(id % 3 == 0 ? parts.erase(id) : parts.update(id, part(round)));
        return {};
      }
      case 2:
        A3D_TRY(store_->create(fmt::format("v{}", round), "volume3d"));
        return store_->assign(fmt::format("v{}", round), Datum{value("volume3d", solid(round))}, context_);
      default:  // what an import does with each file
        A3D_TRY(parts.insert(part(round)));
        return store_->remember_imported("Parts", {std::string(2000, 'x') + std::to_string(round), 84, 1});
    }
  }

 private:
  rlimit before_{};
};

TEST_F(FullDisk, a_statement_is_wholly_absent_and_later_ones_work) {
  std::mt19937 random(3);
  int full = 0;
  for (int round = 0; round < 80; ++round) {
    if (round % 8 == 0) {
      store_.reset();
      std::filesystem::remove(path());
      reopen();
      write([&] { let_parts(10); });
    }
    const std::string before = contents();
    const bool is_long = round % 3 == 0;
    if (is_long) ok(store_->begin_transaction());
    ok(store_->begin(true));
    fill_disk(log_bytes() + random() % 60'000);
    Status status = change_something(random, round);
    if (status) status = store_->commit();
    if (!status) store_->rollback();
    if (is_long) {
      const Status end = store_->commit_transaction();
      if (status) status = end;
    }
    // While it is full, reading goes on.
    const std::string after = contents();
    make_room();
    if (!status) {
      EXPECT_EQ(status.error().code, ErrorCode::disk_full) << status.error().text();
      EXPECT_EQ(after, before);
      ++full;
    }
    EXPECT_EQ(contents(), after);
    write([&] { ASSERT_TRUE(relation("Parts")->insert(part(1)).ok()); });
    expect_sound();
    if (HasFailure()) return;
  }
  EXPECT_GT(full, 15);
  EXPECT_LT(full, 70);
}

TEST_F(FullDisk, a_transaction_that_cannot_be_committed_is_wholly_absent) {
  reopen();
  write([&] { let_parts(3); });
  const std::string before = contents();
  ok(store_->begin_transaction());
  for (int i = 0; i < 5; ++i)
    write([&] {
      for (int j = 0; j < 20; ++j) ASSERT_TRUE(relation("Parts")->insert(part(j)).ok());
    });
  fill_disk(log_bytes());
  const Status status = store_->commit_transaction();
  make_room();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::disk_full) << status.error().text();
  EXPECT_FALSE(store_->is_in_explicit_transaction());
  EXPECT_EQ(contents(), before);
  expect_sound();
}

// What does not fit into SQLite's cache is written in the middle of a statement. If that fails, SQLite undoes all of
// the transaction: nothing may then run as if the statements before had happened.
TEST_F(FullDisk, a_transaction_that_is_undone_in_the_middle_says_so_until_it_ends) {
  reopen(OpenMode::open_or_create, {.page_cache_kilobytes = 40});
  write([&] { let_parts(3); });
  const std::string before = contents();
  for (const bool ends_with_commit : {false, true}) {
    ok(store_->begin_transaction());
    write([&] { ok(relation("Parts")->erase(1)); });
    ok(store_->begin(true));
    fill_disk(log_bytes() + 20'000);
    Status status;
    for (int i = 0; i < 10'000 && status; ++i)
      if (const auto inserted = relation("Parts")->insert(part(i)); !inserted) status = inserted.error();
    make_room();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::disk_full) << status.error().text();
    store_->rollback();
    const std::string undone = path().string() +
                               ": the transaction was undone when a statement in it failed; use abort "
                               "transaction, then begin again";
    for (int round = 0; round < 2; ++round) {
      EXPECT_EQ(store_->begin(true).error().text(), undone);
      EXPECT_EQ(store_->objects().error().text(), undone);
    }
    EXPECT_TRUE(store_->is_in_explicit_transaction());
    if (ends_with_commit)
      EXPECT_EQ(store_->commit_transaction().error().text(), undone);
    else
      ok(store_->abort_transaction());
    EXPECT_FALSE(store_->is_in_explicit_transaction());
    EXPECT_EQ(contents(), before);
    expect_sound();
  }
}

TEST_F(FullDisk, a_database_that_cannot_be_made_leaves_nothing) {
  fill_disk(5000);
  const auto store = Store::open(path(), OpenMode::create, registry_);
  make_room();
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::disk_full) << store.error().text();
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(FullDisk, an_upgrade_that_cannot_be_written_leaves_the_version_before) {
  std::filesystem::copy_file(std::filesystem::path(ALGEBRA3D_SOURCE) / "tests/unit/store/data/version1.database",
                             path());
  fill_disk(8000);
  const auto store = Store::open(path(), OpenMode::read_write, registry_);
  make_room();
  ASSERT_FALSE(store.ok());
  EXPECT_EQ(store.error().code, ErrorCode::disk_full) << store.error().text();
  EXPECT_EQ(sql("PRAGMA user_version"), "1");
  reopen(OpenMode::read_write);
  read([&] { EXPECT_EQ(rows("Parts").size(), 2U); });
}

}  // namespace
}  // namespace queries
