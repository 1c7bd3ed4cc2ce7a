// The C++ interface to databases beside that of SQLite: what a statement costs, and what a row costs.
#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "algebra3d/database/database.h"

namespace {

using algebra3d::database::Database;
using algebra3d::database::Row;

constexpr int kTuples = 100'000;

Database filled_database() {
  Database database = *Database::temporary();
  const auto status = database.execute(
      "let Numbers = intstream(1, $count) transformstream extend[Half: .Elem / 2, Name: num2string(.Elem)] consume",
      {{"count", kTuples}});
  if (!status) std::abort();
  return database;
}

void statement_ours(benchmark::State& state) {
  Database database = *Database::temporary();
  for (auto _ : state) benchmark::DoNotOptimize(database.value("query $n + 1", {{"n", 1}}));
}

void rows_ours(benchmark::State& state) {
  Database database = filled_database();
  for (auto _ : state) {
    std::int64_t sum = 0;
    auto rows = database.query("query Numbers");
    const auto status = rows->for_each([&](const Row& row) { sum += *row[0].get<std::int64_t>(); });
    if (!status || sum != std::int64_t{kTuples} * (kTuples + 1) / 2) state.SkipWithError("wrong sum");
  }
  state.SetItemsProcessed(state.iterations() * kTuples);
}

/// The relation of the benchmarks in SQLite's own tables.
class Sqlite {
 public:
  Sqlite() {
    sqlite3_open(":memory:", &connection_);
    const std::string fill =
        "CREATE TABLE n(a INTEGER, b REAL, c TEXT);"
        "WITH RECURSIVE i(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM i WHERE x < " +
        std::to_string(kTuples) + ") INSERT INTO n SELECT x, x / 2.0, CAST(x AS TEXT) FROM i;";
    sqlite3_exec(connection_, fill.c_str(), nullptr, nullptr, nullptr);
  }
  ~Sqlite() { sqlite3_close(connection_); }
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  /// Calls `visit` with the statement at each row.
  template <typename Visit>
  void run(const char* text, const Visit& visit) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(connection_, text, -1, &statement, nullptr);
    if (sqlite3_bind_parameter_count(statement) > 0) sqlite3_bind_int64(statement, 1, 1);
    while (sqlite3_step(statement) == SQLITE_ROW) visit(statement);
    sqlite3_finalize(statement);
  }

 private:
  sqlite3* connection_ = nullptr;
};

void statement_sqlite(benchmark::State& state) {
  Sqlite sqlite;
  for (auto _ : state)
    sqlite.run("SELECT ? + 1", [](sqlite3_stmt* row) { benchmark::DoNotOptimize(sqlite3_column_int64(row, 0)); });
}

void rows_sqlite(benchmark::State& state) {
  Sqlite sqlite;
  for (auto _ : state) {
    std::int64_t sum = 0;
    std::size_t characters = 0;
    sqlite.run("SELECT * FROM n", [&](sqlite3_stmt* row) {
      sum += sqlite3_column_int64(row, 0);
      benchmark::DoNotOptimize(sqlite3_column_double(row, 1));
      characters += std::string(reinterpret_cast<const char*>(sqlite3_column_text(row, 2))).size();
    });
    if (sum != std::int64_t{kTuples} * (kTuples + 1) / 2) state.SkipWithError("wrong sum");
    benchmark::DoNotOptimize(characters);
  }
  state.SetItemsProcessed(state.iterations() * kTuples);
}

// Statements run on a thread of their own, so the time of the clock counts.
BENCHMARK(statement_ours)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(statement_sqlite)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(rows_ours)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(rows_sqlite)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
