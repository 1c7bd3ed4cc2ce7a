#include "queries/streams/detail/key_table.h"

#include <bit>
#include <functional>
#include <type_traits>

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

std::uint32_t KeyTable::number_of(const Batch& batch, std::size_t row) {
  key_.clear();
  for (const std::size_t attribute : keys_) append_key(*batch.columns[attribute], row);
  const std::size_t hash = std::hash<std::string_view>()(key_);
  for (std::uint32_t entry = chains_.last(hash); entry != HashChains::kNone; entry = chains_.before(entry))
    if (key(entry) == key_) return entry;
  const std::size_t bytes = HashChains::kBytesPerEntry + 2 * (key_.size() + sizeof(std::size_t)) + more_bytes_;
  is_full_ = is_full_ || chains_.is_full() || (!account_.take(bytes) && size() > 0);
  if (is_full_) return kNoRoom;
  chains_.add(hash);
  bytes_ += key_;
  ends_.push_back(bytes_.size());
  return static_cast<std::uint32_t>(size() - 1);
}

void KeyTable::clear() {
  chains_.clear();
  bytes_ = std::string();
  ends_ = {};
  account_.clear();
}

}  // namespace queries
