#include "queries/streams/detail/key_table.h"

#include <bit>
#include <functional>
#include <type_traits>

#include "queries/streams/detail/key_hash.h"

namespace queries {
namespace {

template <typename Number>
void append_number(Number number, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

}  // namespace

// Equal values have equal bytes, and those of one list cannot be taken for those of another one.
void KeyTable::append_key(const ValueColumn& column, std::size_t row) {
  const bool is_defined = column.is_defined(row);
  key_ += is_defined ? '\1' : '\0';
  if (!is_defined) return;
  column.visit([&]<typename Element>(const Element* values) {
    if constexpr (std::is_same_v<Element, std::string>) {
      append_number(values[row].size(), key_);
      key_ += values[row];
    } else if constexpr (std::is_same_v<Element, double>) {
      append_number(values[row] == 0 ? 0.0 : values[row], key_);
    } else if constexpr (!std::is_same_v<Element, Value>) {
      append_number(values[row], key_);
    }
  });
}

std::string_view KeyTable::key(std::size_t number) const {
  const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
  return std::string_view(bytes_).substr(begin, ends_[number] - begin);
}

bool KeyTable::has_room_for(std::size_t bytes) {
  is_full_ = is_full_ || chains_.is_full() || (!account_.take(bytes + more_bytes_) && size() > 0);
  return !is_full_;
}

std::uint32_t KeyTable::number_of_bytes() {
  const std::size_t hash = std::hash<std::string_view>()(key_);
  for (std::uint32_t entry = chains_.last(hash); entry != HashChains::kNone; entry = chains_.before(entry))
    if (key(entry) == key_) return entry;
  if (!has_room_for(HashChains::kBytesPerEntry + 2 * (key_.size() + sizeof(std::size_t)))) return kNoRoom;
  chains_.add(hash);
  bytes_ += key_;
  ends_.push_back(bytes_.size());
  return static_cast<std::uint32_t>(size() - 1);
}

// Different numbers have different hashes, so that nothing else is compared. Undefined has one that no number needs to
// have: it is found by itself.
template <typename Element>
void KeyTable::find_words(const ValueColumn& column, const Element* values, const SelectedRows& rows,
                          std::vector<std::uint32_t>& numbers) {
  const auto add = [&](std::size_t hash) {
    if (!has_room_for(HashChains::kBytesPerEntry)) return kNoRoom;
    chains_.add(hash);
    return static_cast<std::uint32_t>(size() - 1);
  };
  hashes_.clear();
  rows.for_each([&](std::size_t row) { hashes_.push_back(column.is_defined(row) ? hash_of_number(values[row]) : 0); });
  for (std::size_t i = 0; i < hashes_.size(); ++i) {
    // The table is loaded into the cache some keys ahead.
    constexpr std::size_t kToBucket = 16, kToLink = 8;
    if (i + kToBucket < hashes_.size()) chains_.prefetch_bucket(hashes_[i + kToBucket]);
    if (i + kToLink < hashes_.size()) static_cast<void>(chains_.bucket(hashes_[i + kToLink]));
    if (column.is_defined(rows[i])) {
      std::uint32_t number = chains_.last(hashes_[i]);
      if (number == undefined_) number = chains_.before(number);
      numbers.push_back(number != HashChains::kNone ? number : add(hashes_[i]));
    } else if (undefined_) {
      numbers.push_back(*undefined_);
    } else {
      numbers.push_back(add(0));
      if (numbers.back() != kNoRoom) undefined_ = numbers.back();
    }
  }
}

void KeyTable::find_numbers(const Batch& batch, std::vector<std::uint32_t>& numbers) {
  numbers.clear();
  if (keys_.size() == 1) {
    const ValueColumn& column = *batch.columns[keys_.front()];
    const bool are_numbers = column.visit([&]<typename Element>(const Element* values) {
      constexpr bool kIsNumber = !std::is_same_v<Element, std::string> && !std::is_same_v<Element, Value>;
      if constexpr (kIsNumber) find_words(column, values, batch.rows, numbers);
      return kIsNumber;
    });
    if (are_numbers) return;
  }
  for (std::size_t i = 0; i < batch.rows.count; ++i) {
    key_.clear();
    for (const std::size_t attribute : keys_) append_key(*batch.columns[attribute], batch.rows[i]);
    numbers.push_back(number_of_bytes());
  }
}

void KeyTable::clear() {
  chains_.clear();
  undefined_.reset();
  bytes_ = std::string();
  ends_ = {};
  account_.clear();
}

}  // namespace queries
