#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace queries {

/// A number of changes since the beginning of a statement.
using ChangeTime = std::uint64_t;

/// The tuples that a statement has erased or overwritten, with the times, so that a stream of the statement can still
/// read the tuples as they were when it began.
class ChangeLog {
 public:
  enum class Whereabouts : std::uint8_t {
    current,   ///< in the database as it is now
    original,  ///< in the database as it was when the statement began
    lost,      ///< nowhere: changed before and after that time, or its table was renamed since
  };

  ChangeTime now() const { return now_; }
  void clear();
  /// Records that a tuple was erased or overwritten.
  void note_tuple(std::int64_t table_number, std::int64_t tuple);
  /// Records that tuples, ascending, were erased or overwritten at once.
  void note_tuples(std::int64_t table_number, std::span<const std::int64_t> tuples);
  /// Records an inserted tuple; its id is greater than all earlier ones.
  void note_inserted(std::int64_t table_number, std::int64_t tuple) { first_new_.emplace(table_number, tuple); }
  void note_created(std::int64_t table_number) { first_new_.emplace(table_number, 0); }
  /// Records a dropped table, which stays in the file until the end of the statement.
  void note_dropped(std::int64_t table_number) { gone_since_.insert_or_assign(table_number, ++now_); }
  void note_renamed(std::int64_t table_number);

  /// Where the state of a tuple at `time` can be read.
  Whereabouts where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const;
  /// Tuples with after < id <= last that were changed after `time`, ascending.
  std::vector<std::int64_t> changed_tuples(std::int64_t table_number, std::int64_t after, std::int64_t last,
                                           ChangeTime time) const;
  /// The tables of which tuples were erased or overwritten, or that were dropped or renamed.
  std::set<std::int64_t> tables() const;
  /// True if the table was dropped or renamed after `time`.
  bool is_gone(std::int64_t table_number, ChangeTime time) const;
  /// True if the tuple existed when the statement began and has not changed.
  bool is_untouched(std::int64_t table_number, std::int64_t tuple) const;

 private:
  friend class TransactionLog;
  struct Span {
    ChangeTime first, last;
  };
  bool is_new(std::int64_t table_number, std::int64_t tuple) const;
  const Span* find(std::int64_t table_number, std::int64_t tuple) const;

  ChangeTime now_ = 0;
  std::map<std::int64_t, std::map<std::int64_t, Span>> tuples_;
  std::map<std::int64_t, std::int64_t> first_new_;  // per table the first tuple of this statement; 0: all of them
  std::map<std::int64_t, ChangeTime> gone_since_;
  std::set<std::int64_t> renamed_;
};

/// The changes of earlier statements of the running transaction.
class TransactionLog {
 public:
  void clear();
  /// Adds the changes of a statement at its end.
  void add(const ChangeLog& statement);
  /// True if the tuple has not changed since the transaction began, so that another connection can read it.
  bool is_original(std::int64_t table_number, std::int64_t tuple) const;

 private:
  std::map<std::int64_t, std::set<std::int64_t>> changed_;
  std::map<std::int64_t, std::int64_t> first_new_;
};

}  // namespace queries
