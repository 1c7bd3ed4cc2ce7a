#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/work_memory.h"
#include "queries/streams/batch.h"

namespace queries {

/// Appends order_prefix of the values of these rows, which are loaded.
void append_prefixes(const ValueColumn& column, const SelectedRows& rows, std::vector<std::uint64_t>& prefixes);

/// Tuples kept in columns, within the work memory: each has a place, numbered from 0. What is read of them is read by
/// their places. Large values stay deferred. Attributes that nobody reads take no memory.
class ColumnBuffer {
 public:
  /// `memory`: null, if the caller counts it. `more_bytes`: what the caller keeps for each tuple.
  explicit ColumnBuffer(algebra3d::WorkMemory* memory, std::size_t more_bytes = 0)
      : account_(memory), more_bytes_(more_bytes) {}

  /// Adds the tuples of a batch, which all have the attributes of the first batch.
  void add(const Batch& batch);
  /// True if the work memory or the numbers of places are exhausted: then nothing more should be added.
  bool is_full() const { return is_full_; }
  std::size_t size() const { return size_; }
  /// Keeps the tuples at these places alone, which are ascending. They are numbered from 0 again.
  void keep(std::span<const std::uint32_t> places);
  /// Removes all tuples, and gives their memory back.
  void clear();

  std::size_t attribute_count() const { return columns_.size(); }
  const algebra3d::Type& type(std::size_t attribute) const { return *columns_[attribute].type; }
  Value value(std::size_t attribute, std::uint32_t place) const { return columns_[attribute].value(place); }
  /// Appends order_prefix of all values of an attribute, which are loaded.
  void append_prefixes(std::size_t attribute, std::vector<std::uint64_t>& prefixes) const;
  /// Compares loaded values as `compare` does.
  std::strong_ordering compare(std::size_t attribute, std::uint32_t a, std::uint32_t b) const;

  /// Calls `visit` with the array of an attribute, whose element at a place, if it is defined, is that of its tuple: of
  /// std::int64_t, double, std::uint8_t (a bool), std::string or Value.
  template <typename Visit>
  decltype(auto) visit(std::size_t attribute, Visit visit) const {
    return std::visit(visit, columns_[attribute].content);
  }
  TupleId id(std::uint32_t place) const { return place < ids_.size() ? ids_[place] : 0; }
  /// The tuple at a place with its first `attribute_count` attributes.
  TuplePtr tuple(std::uint32_t place, std::size_t attribute_count) const;
  /// Makes `size` rows of a column, and puts an attribute of the tuples at these places into the rows `into`, one each;
  /// leaves it without rows if nobody reads it.
  void gather(std::size_t attribute, std::span<const std::uint32_t> places, std::size_t size, const SelectedRows& into,
              ValueColumn& to) const;

 private:
  /// An array that grows without moving its elements.
  template <typename T>
  class Chunks {
   public:
    static constexpr unsigned kBits = 8;
    static constexpr std::size_t kSize = std::size_t{1} << kBits;

    T& operator[](std::size_t place) { return chunks_[place >> kBits][place & (kSize - 1)]; }
    const T& operator[](std::size_t place) const { return chunks_[place >> kBits][place & (kSize - 1)]; }
    /// Makes room for `count` elements, new ones equal `fill`; the bytes that were added.
    std::size_t reserve(std::size_t count, const T& fill) {
      std::size_t bytes = 0;
      for (; chunks_.size() << kBits < count; bytes += kSize * sizeof(T)) chunks_.emplace_back(kSize, fill);
      return bytes;
    }

   private:
    std::vector<std::vector<T>> chunks_;
  };
  // A bool is a byte, as in ValueColumn.
  using Content =
      std::variant<Chunks<std::int64_t>, Chunks<double>, Chunks<std::uint8_t>, Chunks<std::string>, Chunks<Value>>;

  struct Column {
    explicit Column(const algebra3d::Type& of);
    bool is_defined(std::size_t place) const { return is_read && (place >= undefined.size() || undefined[place] == 0); }
    void set_undefined(std::size_t place);
    Value value(std::size_t place) const;

    const algebra3d::Type* type;
    bool is_read = false;  // else all are undefined
    Content content;
    std::vector<std::uint8_t> undefined;  // up to the last one
  };

  void add_to(Column& column, const ValueColumn& from, const SelectedRows& rows);
  void keep_in(Column& column, std::span<const std::uint32_t> places);
  void charge();

  algebra3d::MemoryAccount account_;
  std::size_t more_bytes_;
  std::vector<Column> columns_;
  std::vector<TupleId> ids_;  // none, if the tuples have none
  std::size_t size_ = 0;
  std::size_t array_bytes_ = 0;  // of the arrays
  std::size_t heap_bytes_ = 0;   // of what the elements refer to
  bool is_full_ = false;
};

}  // namespace queries
