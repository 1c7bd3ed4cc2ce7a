#include "queries/streams/detail/join_table.h"

#include <algorithm>
#include <functional>
#include <string_view>
#include <type_traits>

#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/detail/key_hash.h"

namespace queries {
namespace {

std::size_t hash_of_element(const std::string& characters) {
  return std::hash<std::string_view>()(characters);
}
// As a string: the two are comparable.
std::size_t hash_of_element(const Value& value) {
  const bool is_text = &value.type() == &algebra3d::TypeOf<algebra3d::Text>::type();
  return is_text ? hash_of_element(algebra3d::characters_of(value)) : hash(value);
}
template <typename Element>
std::size_t hash_of_element(const Element& number) {
  return hash_of_number(number);
}

/// How many keys ahead the table is loaded into the cache.
constexpr std::size_t kAhead = 16;

/// Appends the hashes of rows with defined keys; 0 for the others.
void append_hashes(const ValueColumn& keys, const SelectedRows& rows, std::vector<std::size_t>& hashes) {
  keys.visit([&](const auto* values) {
    rows.for_each([&](std::size_t row) { hashes.push_back(keys.is_defined(row) ? hash_of_element(values[row]) : 0); });
  });
}

}  // namespace

Result<bool> JoinTable::add(const Batch& batch) {
  attribute_count_ = batch.columns.size();
  A3D_ASSIGN(const Batch* const loaded, keys_.with_keys(batch));
  const ValueColumn& keys = *loaded->columns[keys_.attribute(0)];
  selected_.clear();
  loaded->rows.for_each([&](std::size_t row) {
    if (keys.is_defined(row)) selected_.push_back(static_cast<std::uint32_t>(row));
  });
  Batch defined = *loaded;
  defined.rows = {selected_.data(), selected_.size()};
  append_hashes(keys, defined.rows, hashes_);
  tuples_.add(defined);
  return !tuples_.is_full();
}

void JoinTable::finish() {
  std::vector<std::uint32_t> counts(hashes_.size());  // of the entries up to one that have its hash
  for (std::size_t entry = 0; entry < counts.size(); ++entry) {
    chains_.add(hashes_[counts.size() - 1 - entry]);
    const std::uint32_t before = chains_.before(static_cast<std::uint32_t>(entry));
    counts[entry] = before == HashChains::kNone ? 1 : counts[before] + 1;
    most_of_a_key_ = std::max<std::size_t>(most_of_a_key_, counts[entry]);
  }
  hashes_ = {};
}

void JoinTable::clear() {
  tuples_.clear();
  chains_.clear();
  hashes_ = {};
}

void JoinSearch::start(const ValueColumn& keys, const SelectedRows& rows) {
  keys_ = &keys;
  rows_ = rows;
  hashes_.clear();
  append_hashes(keys, rows, hashes_);
  buckets_.clear();
  for (std::size_t i = 0; i < hashes_.size(); ++i) {
    if (i + kAhead < hashes_.size()) table_.chains_.prefetch_bucket(hashes_[i + kAhead]);
    buckets_.push_back(table_.chains_.bucket(hashes_[i]));
  }
  next_row_ = 0;
  is_row_begun_ = false;
}

template <typename IsEqual>
bool JoinSearch::find_equal(std::size_t most, std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& places,
                            IsEqual is_equal) {
  const HashChains& chains = table_.chains_;
  const auto last = static_cast<std::uint32_t>(table_.size()) - 1;
  for (; next_row_ < rows_.count; ++next_row_, is_row_begun_ = false) {
    const std::size_t row = rows_[next_row_];
    if (!is_row_begun_)
      entry_ = keys_->is_defined(row) ? chains.with_hash(hashes_[next_row_], buckets_[next_row_]) : HashChains::kNone;
    is_row_begun_ = true;
    for (; entry_ != HashChains::kNone; entry_ = chains.before(entry_)) {
      if (!is_equal(row, last - entry_)) continue;
      if (most-- == 0) return true;
      rows.push_back(static_cast<std::uint32_t>(row));
      places.push_back(last - entry_);
    }
  }
  return false;
}

bool JoinSearch::find(std::size_t most, std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& places) {
  if (table_.size() == 0 || keys_ == nullptr) return false;
  const std::size_t key = table_.keys_.attribute(0);
  return keys_->visit([&]<typename Element>(const Element* values) {
    return table_.tuples_.visit(key, [&](const auto& kept) {
      constexpr bool kIsOneType = std::is_same_v<Element, std::remove_cvref_t<decltype(kept[0])>>;
      // Different numbers have different hashes.
      if constexpr (kIsOneType && std::is_arithmetic_v<Element>)
        return find_equal(most, rows, places, [](std::size_t, std::uint32_t) { return true; });
      else if constexpr (kIsOneType && std::is_same_v<Element, std::string>)
        return find_equal(most, rows, places,
                          [&](std::size_t row, std::uint32_t place) { return values[row] == kept[place]; });
      else
        return find_equal(most, rows, places, [&](std::size_t row, std::uint32_t place) {
          return compare(keys_->value(row), table_.tuples_.value(key, place)) == 0;
        });
    });
  });
}

}  // namespace queries
