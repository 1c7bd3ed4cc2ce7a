#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace queries {

/// Counts the changes of one statement; 0 is its beginning.
using ChangeTime = std::uint64_t;

/// Which tuples a statement has erased or overwritten, and when: so that those who read a tuple before still find out
/// what they read. Inserted tuples are not listed.
class ChangeLog {
 public:
  enum class Whereabouts : std::uint8_t {
    current,   ///< as it stands in the database now
    original,  ///< as it stood when the statement began
    lost,      ///< neither: changed before and after that time
  };

  ChangeTime now() const { return now_; }
  void clear();
  void note_tuple(std::int64_t table_number, std::int64_t tuple);
  void note_created(std::int64_t table_number) { created_.insert(table_number); }
  void note_dropped(std::int64_t table_number);

  /// Where a tuple is found as it was at `time`.
  Whereabouts where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const;
  /// Tuples with after < id <= last that were changed after `time`, ascending.
  std::vector<std::int64_t> changed_tuples(std::int64_t table_number, std::int64_t after, std::int64_t last,
                                           ChangeTime time) const;
  /// True if the table is gone.
  bool is_dropped(std::int64_t table_number) const { return dropped_.contains(table_number); }

 private:
  struct Span {
    ChangeTime first, last;
  };

  ChangeTime now_ = 0;
  std::map<std::int64_t, std::map<std::int64_t, Span>> tuples_;
  std::set<std::int64_t> dropped_;
  std::set<std::int64_t> created_;
};

}  // namespace queries
