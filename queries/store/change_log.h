#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace queries {

/// Counts the changes of one statement; 0 is its beginning.
using ChangeTime = std::uint64_t;

/// Which tuples a statement has erased or overwritten, and when: so that those who read a tuple before still find out
/// what they read.
class ChangeLog {
 public:
  enum class Whereabouts : std::uint8_t {
    current,   ///< as it stands in the database now
    original,  ///< as it stood when the statement began
    lost,      ///< neither: changed before and after that time, or its table has another name since
  };

  ChangeTime now() const { return now_; }
  void clear();
  /// Erased or overwritten.
  void note_tuple(std::int64_t table_number, std::int64_t tuple);
  /// Inserted, with an id above all those before.
  void note_inserted(std::int64_t table_number, std::int64_t tuple) { first_new_.emplace(table_number, tuple); }
  void note_created(std::int64_t table_number) { first_new_.emplace(table_number, 0); }
  /// A dropped table stands until the end of the statement.
  void note_dropped(std::int64_t table_number) { gone_since_.insert_or_assign(table_number, ++now_); }
  void note_renamed(std::int64_t table_number);

  /// Where a tuple is found as it was at `time`.
  Whereabouts where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const;
  /// Tuples with after < id <= last that were changed after `time`, ascending.
  std::vector<std::int64_t> changed_tuples(std::int64_t table_number, std::int64_t after, std::int64_t last,
                                           ChangeTime time) const;
  /// True if the table was dropped or got another name after `time`.
  bool is_gone(std::int64_t table_number, ChangeTime time) const;
  /// True if the tuple was there when the statement began and still is as it was.
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

/// What the statements of a transaction have changed before the one that runs.
class TransactionLog {
 public:
  void clear();
  /// At the end of a statement.
  void add(const ChangeLog& statement);
  /// True if the tuple is as it was when the transaction began: another connection can read it.
  bool is_original(std::int64_t table_number, std::int64_t tuple) const;

 private:
  std::map<std::int64_t, std::set<std::int64_t>> changed_;
  std::map<std::int64_t, std::int64_t> first_new_;
};

}  // namespace queries
