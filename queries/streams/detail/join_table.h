#pragma once

#include <cstdint>
#include <vector>

#include "queries/streams/column_buffer.h"
#include "queries/streams/detail/hash_table.h"
#include "queries/streams/detail/loaded_keys.h"

namespace queries {

/// The build side of a hash join, in columns within the work memory: its tuples with defined keys, and a hash table of
/// the keys. Filled first, then searched.
class JoinTable {
 public:
  /// `key`: an attribute of the tuples.
  JoinTable(std::size_t key, const algebra3d::Context& context)
      : keys_({key}), tuples_(context.memory, HashChains::kBytesPerEntry + 2 * sizeof(std::uint64_t)) {}

  /// Adds the tuples of a batch; false if the work memory is exhausted now. Errors: those of loading.
  Result<bool> add(const Batch& batch);
  /// To be called once all tuples have been added.
  void finish();
  /// The number of tuples of the key that has most of them, or more.
  std::size_t most_of_a_key() const { return most_of_a_key_; }

  std::size_t size() const { return tuples_.size(); }
  std::size_t attribute_count() const { return attribute_count_; }
  TuplePtr tuple(std::uint32_t place) const { return tuples_.tuple(place, attribute_count_); }
  /// The tuples in columns.
  const ColumnBuffer& tuples() const { return tuples_; }
  void clear();

 private:
  friend class JoinSearch;

  LoadedKeys keys_;
  ColumnBuffer tuples_;
  std::size_t attribute_count_ = 0;
  std::vector<std::size_t> hashes_;  // until the end
  HashChains chains_;                // of the tuples, the last one first: so a search finds them in their order
  std::size_t most_of_a_key_ = 0;
  std::vector<std::uint32_t> selected_;
};

/// The search of a column of keys in a JoinTable.
class JoinSearch {
 public:
  explicit JoinSearch(const JoinTable& table) : table_(table) {}
  /// Begins with the keys of these rows. The column stands as long as the search; its type is that of the table's
  /// keys or comparable with it.
  void start(const ValueColumn& keys, const SelectedRows& rows);
  /// Appends pairs of a row and the place of a tuple with an equal key, `most` at most: row by row, and the tuples of a
  /// row in their order. False at the end of the pairs.
  bool find(std::size_t most, std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& places);

 private:
  template <typename IsEqual>
  bool find_equal(std::size_t most, std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& places,
                  IsEqual is_equal);

  const JoinTable& table_;
  const ValueColumn* keys_ = nullptr;
  SelectedRows rows_;
  std::vector<std::size_t> hashes_;     // of the rows
  std::vector<std::uint32_t> buckets_;  // of them
  std::size_t next_row_ = 0;
  std::uint32_t entry_ = HashChains::kNone;  // the next one for that row
  bool is_row_begun_ = false;
};

}  // namespace queries
