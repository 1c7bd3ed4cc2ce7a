#pragma once

#include <cstddef>

#include "base/disjoint_sets.h"

namespace algebra3d {

/// DisjointSets of ids of one kind, from 0 to count - 1.
template <typename Id>
class DisjointIds {
 public:
  explicit DisjointIds(std::size_t count) : sets_(count) {}

  /// Adds a set of one new id, the next one.
  Id add() { return Id(sets_.add()); }
  Id find(Id member) { return Id(sets_.find(member.index())); }
  void unite(Id a, Id b) { sets_.unite(a.index(), b.index()); }
  std::size_t size() const { return sets_.size(); }

 private:
  DisjointSets sets_;
};

}  // namespace algebra3d
