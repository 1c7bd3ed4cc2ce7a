// A million boxes from memory to a committed index: our stored R-tree beside SQLite's own, each in a new file with a
// write-ahead log that is synchronised at the commit. Both start with an array of boxes and one open transaction. The
// steps of ours are measured by themselves, too. Compare the lines `to_a_committed_index`.
#include <sqlite3.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "queries/store/detail/stored_tree.h"
#include "queries/store/detail/tables.h"

namespace {

namespace fs = std::filesystem;
using algebra3d::Box3;
using algebra3d::Vec3;
using queries::SqliteConnection;
using Tree = rtree::RTree<std::uint64_t>;
using Entries = std::vector<rtree::Entry<std::uint64_t>>;

constexpr std::int64_t kOwner = 1;

// Cubes of side 1 in a cube of side 1000.
Entries random_entries(std::int64_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(0, 1000);
  Entries entries;
  for (std::int64_t i = 0; i < count; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    entries.push_back({{{x, y, z}, {x + 1, y + 1, z + 1}}, static_cast<std::uint64_t>(i)});
  }
  return entries;
}

/// A folder for the file of one run, which is removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "algebra3d_bench_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  std::string file() const { return (path_ / "index.db").string(); }

 private:
  fs::path path_;
};

/// An empty database in which a transaction is open.
std::unique_ptr<SqliteConnection> begun(const std::string& file) {
  auto connection = SqliteConnection::open(file, SqliteConnection::Access::create, 1000).value();
  for (const char* sql :
       {"PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL", queries::kCreateIndexPages, "BEGIN"})
    if (!connection->execute(sql)) std::abort();
  return connection;
}

queries::RelationState state_of(const Entries& entries) {
  const auto count = static_cast<std::int64_t>(entries.size());
  return {1, 0, count, count + 1, 0};
}

void to_a_committed_index_ours(benchmark::State& state) {
  const Entries entries = random_entries(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    const Folder folder;
    const auto connection = begun(folder.file());
    state.ResumeTiming();
    Tree tree = Tree::bulk_load(entries, rtree::Filling::room_for_changes);
    const bool is_done =
        queries::store_tree(*connection, kOwner, state_of(entries), tree, true) && connection->execute("COMMIT");
    state.PauseTiming();
    if (!is_done || !queries::has_tree(*connection, kOwner, state_of(entries)).value())
      state.SkipWithError("not stored");
    state.ResumeTiming();
  }
}

void bulk_load_ours(benchmark::State& state) {
  const Entries entries = random_entries(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Tree::bulk_load(entries, rtree::Filling::room_for_changes));
}

void to_a_committed_index_sqlite(benchmark::State& state) {
  const Entries entries = random_entries(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    const Folder folder;
    sqlite3* connection = nullptr;
    sqlite3_open(folder.file().c_str(), &connection);
    const auto execute = [&](const char* sql) {
      if (sqlite3_exec(connection, sql, nullptr, nullptr, nullptr) != SQLITE_OK) state.SkipWithError(sql);
    };
    for (const char* sql : {"PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL",
                            "CREATE VIRTUAL TABLE b USING rtree(id, minx, maxx, miny, maxy, minz, maxz)", "BEGIN"})
      execute(sql);
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(connection, "INSERT INTO b VALUES(?, ?, ?, ?, ?, ?, ?)", -1, &insert, nullptr);
    state.ResumeTiming();
    for (const auto& [box, payload] : entries) {
      sqlite3_bind_int64(insert, 1, static_cast<sqlite3_int64>(payload));
      for (int axis = 0; axis < 3; ++axis) {
        sqlite3_bind_double(insert, 2 + 2 * axis, box.min[static_cast<std::size_t>(axis)]);
        sqlite3_bind_double(insert, 3 + 2 * axis, box.max[static_cast<std::size_t>(axis)]);
      }
      sqlite3_step(insert);
      sqlite3_reset(insert);
    }
    execute("COMMIT");
    state.PauseTiming();
    sqlite3_finalize(insert);
    sqlite3_close(connection);
    state.ResumeTiming();
  }
}

BENCHMARK(bulk_load_ours)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(to_a_committed_index_ours)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(to_a_committed_index_sqlite)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
