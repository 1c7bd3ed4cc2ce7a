#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "queries/store/detail/integrity_check.h"

namespace queries {

/// The keys of an attribute, in any order.
struct KeySum {
  std::int64_t count = 0;
  std::uint64_t sum = 0;

  void add(TupleId id, const Cell& key);
  friend bool operator==(const KeySum&, const KeySum&) = default;
};

/// A relation that is being read.
struct IntegrityCheck::Walk {
  const CatalogueEntry& entry;
  std::shared_ptr<const RelationLayout> layout;
  std::int64_t count = 0;
  std::uint64_t sum = 0;
  bool are_rows_sound = true;
  TupleId last = 0;
  /// Tuples that cannot be read, in ascending order; the last ones may be without an end.
  struct Gap {
    TupleId first = 0;
    TupleId last = 0;
  };
  std::vector<Gap> gaps = {};
  // By attribute, of those that have a tree in memory.
  std::map<std::size_t, Entries> boxes = {};
  std::map<std::size_t, std::vector<OrderedTree::Entry>> keys = {};
  // By attribute, of those that have a key table.
  std::map<std::size_t, KeySum> key_sums = {};
};

}  // namespace queries
