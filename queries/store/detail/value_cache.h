#pragma once

#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <vector>

#include "algebra3d/values/types/value.h"

namespace queries {

/// The location of a large value: table of the relation, tuple and attribute.
struct ValuePlace {
  std::int64_t table_number = 0;
  std::int64_t tuple = 0;
  std::size_t attribute = 0;

  friend auto operator<=>(const ValuePlace&, const ValuePlace&) = default;
};

/// A cache of loaded values with a limit in bytes, or a third of the remaining memory if that is less; it outlives
/// statements. A change of a stored value must erase it here. Used under the lock of its owner.
///
/// Two lists, each by last use: values that were asked for again since they came are kept for as long as there are no
/// newer ones of this kind; new values share a quarter of the limit once the cache is full. So a scan of more than the
/// cache holds drops its own values and not what it finds here the next time; in a plain list by last use it would find
/// nothing. One in kPromoted of the values that leave the new ones unasked is kept too, in place of values that are no
/// longer used. Source: [johnson1994] for the two lists, [qureshi2007] for the rare promotion.
class ValueCache {
 public:
  explicit ValueCache(std::uint64_t limit) : limit_(limit) {}

  std::optional<algebra3d::Value> find(const ValuePlace& place);
  /// Adds `value`, which stays even if it is larger than the cache. `bytes` is an estimate. Returns what had to leave:
  /// the caller may destroy it after it has released the lock, since that takes long for large values.
  std::vector<algebra3d::Value> add(const ValuePlace& place, const algebra3d::Value& value, std::uint64_t bytes);
  /// Removes the values of a tuple.
  void erase(std::int64_t table_number, std::int64_t tuple);
  void erase_table(std::int64_t table_number);
  void clear();
  /// Returns what has to leave since less memory is left than there was.
  std::vector<algebra3d::Value> shrink();

  std::uint64_t bytes() const { return new_.bytes + kept_.bytes; }

 private:
  struct Entry {
    ValuePlace place;
    algebra3d::Value value;
    std::uint64_t bytes;
    bool is_kept = false;  ///< in `kept_`
  };
  using Entries = std::list<Entry>;
  struct Order {
    Entries entries;  ///< most recently used first
    std::uint64_t bytes = 0;
  };
  using Places = std::map<ValuePlace, Entries::iterator>;
  static constexpr std::uint32_t kPromoted = 32;

  void keep(Entries::iterator entry, Entries::iterator before);
  std::uint64_t limit() const;
  void erase(Places::iterator first, Places::iterator last);

  std::uint64_t limit_;
  Order new_, kept_;
  Places places_;
  std::uint32_t unasked_count_ = 0;
};

}  // namespace queries
