#pragma once

#include "unit/session/random_driver.h"

// Random commands that change the database.
namespace queries::random_changes {

inline void let_relation(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  Rows rows;
  for (int count = driver.below(6); count > 0; --count) rows.push_back(driver.row());
  const std::string command = "let " + name + " = [const rel(tuple([K: int, V: int])) value " + text_of(rows) + "]";
  if (driver.expect_change(command, !driver.model().has(name))) driver.model().relations[name] = rows;
}

inline void let_number(RandomDriver& driver) {
  const std::string name = driver.number_name();
  const int number = driver.below(1000);
  if (driver.expect_change(fmt::format("let {} = {} + 0", name, number), !driver.model().has(name)))
    driver.model().numbers[name] = number;
}

// The new relation has no indexes.
inline void let_again(RandomDriver& driver) {
  const std::string target = driver.relation_name();
  const std::string source = driver.relation_name();
  const int limit = driver.below(60) - 30;
  const Rows* rows = driver.find(source);
  const auto command = fmt::format("let_ {} = {} feed filter[.V > {}] consume", target, source, limit);
  if (!driver.expect_change(command, rows != nullptr)) return;
  Rows kept;
  std::ranges::copy_if(*rows, std::back_inserter(kept), [&](const Row& row) { return row.value > limit; });
  driver.model().remove(target);
  driver.model().relations[target] = kept;
}

inline void derive(RandomDriver& driver) {
  const std::string name = driver.derived_name();
  const std::string source = driver.relation_name();
  const Rows* rows = driver.find(source);
  if (!driver.expect_change(fmt::format("derive {} = {} feed count", name, source),
                            rows != nullptr && !driver.model().has(name)))
    return;
  driver.model().derived[name] = {source, static_cast<int>(rows->size())};
  driver.expect(fmt::format("update {} := 5", name), "error");
}

inline void make_index(RandomDriver& driver) {
  const std::string name = driver.index_name();
  const std::string source = driver.relation_name();
  if (driver.expect_change(fmt::format("let {} = {} createbtree[K]", name, source),
                           driver.find(source) != nullptr && !driver.model().has(name)))
    driver.model().indexes[name] = source;
}

inline void insert_tuple(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const Row row = driver.row();
  driver.expect_query(fmt::format("{} inserttuple[{}, {}] count", name, row.key, row.value),
                      driver.find(name) != nullptr, "1");
  if (driver.find(name) != nullptr) driver.model().relations[name].push_back(row);
}

// Also into the relation that is being read.
inline void insert_stream(RandomDriver& driver) {
  const std::string source = driver.relation_name();
  const std::string target = driver.relation_name();
  const Rows* rows = driver.find(source);
  const bool is_possible = rows != nullptr && driver.find(target) != nullptr && rows->size() < 40;
  if (rows != nullptr && rows->size() >= 40) return;
  driver.expect_query(fmt::format("{} feed {} insert count", source, target), is_possible,
                      is_possible ? std::to_string(rows->size()) : "");
  if (!is_possible) return;
  const Rows copy = *rows;
  Rows& changed = driver.model().relations[target];
  changed.insert(changed.end(), copy.begin(), copy.end());
}

inline void erase_equal(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const int key = driver.below(4);
  const char* op = driver.below(2) == 0 ? "deletesearch" : "deletedirect";
  const Rows* rows = driver.find(name);
  const std::size_t count = rows == nullptr ? 0 : rows_with(*rows, key, key).size();
  driver.expect_query(fmt::format("{0} feed filter[.K = {1}] {0} {2} count", name, key, op), rows != nullptr,
                      std::to_string(count));
  if (rows != nullptr) std::erase_if(driver.model().relations[name], [&](const Row& row) { return row.key == key; });
}

inline void erase_first(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const int key = driver.below(4);
  const Rows* rows = driver.find(name);
  const bool is_there = rows != nullptr && !rows_with(*rows, key, key).empty();
  driver.expect_query(fmt::format("{0} deletebyid[{0} feed filter[.K = {1}] addid extract[TID]] count", name, key),
                      rows != nullptr, is_there ? "1" : "0");
  if (!is_there) return;
  Rows& changed = driver.model().relations[name];
  changed.erase(std::ranges::find(changed, key, &Row::key));
}

inline void update_tuples(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const int key = driver.below(4);
  const int by = driver.below(9) - 4;
  const int new_key = driver.below(4);
  const Rows* rows = driver.find(name);
  const std::size_t count = rows == nullptr ? 0 : rows_with(*rows, key, key).size();
  driver.expect_query(
      fmt::format("{0} feed filter[.K = {1}] {0} updatedirect[V: .V + {2}, K: {3}] count", name, key, by, new_key),
      rows != nullptr, std::to_string(count));
  if (rows == nullptr) return;
  for (Row& row : driver.model().relations[name])
    if (row.key == key) row = {new_key, row.value + by};
}

inline void update_first(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const int key = driver.below(4);
  const Row row = driver.row();
  const Rows* rows = driver.find(name);
  const bool is_there = rows != nullptr && !rows_with(*rows, key, key).empty();
  driver.expect_query(fmt::format("{0} updatebyid[{0} feed filter[.K = {1}] addid extract[TID]; K: {2}, V: {3}] "
                                  "project[K, V, K_old] consume",
                                  name, key, row.key, row.value),
                      rows != nullptr, is_there ? fmt::format("(({} {} {}))", row.key, row.value, key) : "()");
  if (is_there) *std::ranges::find(driver.model().relations[name], key, &Row::key) = row;
}

inline void remove(RandomDriver& driver) {
  const int kind = driver.below(5);
  const std::string name = kind == 0   ? driver.number_name()
                           : kind == 1 ? driver.derived_name()
                           : kind == 2 ? driver.index_name()
                                       : driver.relation_name();
  driver.expect_change((driver.below(2) == 0 ? "delete " : "kill ") + name, driver.model().has(name));
  driver.model().remove(name);
}

inline void rename(RandomDriver& driver) {
  const bool is_index = driver.below(4) == 0;
  const std::string from = is_index ? driver.index_name() : driver.relation_name();
  const std::string to = is_index ? driver.index_name() : driver.relation_name();
  if (from == to) return;
  if (driver.expect_change("changename " + from + " to " + to, driver.model().has(from) && !driver.model().has(to)))
    driver.model().rename(from, to);
}

inline void update_number(RandomDriver& driver) {
  const std::string name = driver.number_name();
  const int by = driver.below(10);
  const auto found = driver.model().numbers.find(name);
  const bool is_there = found != driver.model().numbers.end();
  if (driver.expect_change(fmt::format("update {0} := {0} + {1}", name, by), is_there)) found->second += by;
  driver.expect_query(name, is_there, is_there ? std::to_string(found->second) : "");
}

// Each fails in the middle of its work; nothing of it may stay.
inline void fail(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  driver.expect(fmt::format("query {} inserttuple[1, 2] projecttransform[V] count", name), "error");
  driver.expect(fmt::format("let_ {0} = {0} inserttuple[1, 2] K_is_no_attribute", name), "error");
  driver.expect(fmt::format("query {0} feed {0} updatedirect[V: {0} feed nothing] count", name), "error");
  driver.expect(fmt::format("query ({0} inserttuple[1, 2] count) + ([const rel(tuple([K: int])) value ((2) (1))] feed "
                            "[const rel(tuple([L: int])) value ((1))] feed mergejoin[K, L] count)",
                            name),
                "error");
  driver.expect("{ let temporary = 1 | update temporary := nothing }", "error");
  driver.expect("delete temporary", "");
}

inline void transaction(RandomDriver& driver) {
  if (!driver.is_in_transaction()) {
    if (driver.below(6) == 0) driver.expect(driver.below(2) == 0 ? "commit transaction" : "abort transaction", "error");
    driver.begin();
    return driver.expect("begin transaction", "");
  }
  if (driver.below(6) == 0) driver.expect("begin transaction", "error");
  const bool keeps = driver.below(2) == 0;
  driver.expect(keeps ? "commit transaction" : "abort transaction", "");
  driver.end(keeps);
}

// Not in the middle of a transaction.
inline void reopen(RandomDriver& driver) {
  if (driver.below(4) != 0) return;
  if (driver.is_in_transaction()) {
    driver.expect("close database", "error");
    driver.expect("abort transaction", "");
    driver.end(false);
  }
  driver.expect("close database", "");
  driver.expect("open database d", "");
  driver.expect("check database", "(inquiry (findings ()))");
}

inline void save_and_restore_database(RandomDriver& driver) {
  if (driver.is_in_transaction() || driver.below(4) != 0) return;
  driver.expect("save database to 'saved.txt'", "");
  driver.expect("close database", "");
  // In place of the existing database it does nothing if it would lose something.
  if (driver.model().has_underivable()) {
    driver.expect("restore database d from 'saved.txt'", "error");
    driver.expect("delete database d", "");
    driver.expect("restore database d from 'saved.txt'", "error");
  } else {
    driver.expect("restore database d from 'saved.txt'", "");
  }
  driver.model().restore();
  driver.expect("check database", "(inquiry (findings ()))");
}

// The file is there whatever becomes of the transaction.
inline void save_or_restore_relation(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  const Rows* rows = driver.find(name);
  if (driver.below(2) == 0) {
    if (driver.expect_change("save " + name + " to 'one.txt'", rows != nullptr)) driver.saved = *rows;
    return;
  }
  if (driver.expect_change("restore " + name + " from 'one.txt'", driver.saved && rows == nullptr))
    driver.model().relations[name] = *driver.saved;
}

inline constexpr RandomStep kSteps[] = {
    {4, let_relation},
    {1, let_number},
    {2, let_again},
    {1, derive},
    {2, make_index},
    {3, insert_tuple},
    {1, insert_stream},
    {2, erase_equal},
    {1, erase_first},
    {2, update_tuples},
    {1, update_first},
    {3, remove},
    {2, rename},
    {2, update_number},
    {1, fail},
    {3, transaction},
    {2, reopen},
    {1, save_and_restore_database},
    {2, save_or_restore_relation},
};

}  // namespace queries::random_changes
