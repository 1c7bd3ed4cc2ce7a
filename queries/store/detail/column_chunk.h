#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/value_column.h"
#include "algebra3d/values/types/codec.h"
#include "queries/store/detail/chunk_form.h"
#include "queries/store/detail/relation_layout.h"

namespace queries {

// Column chunks: the values of one attribute of a row group as bytes. docs/file_format.md, "Row groups".

/// The least and the greatest value of a column chunk, as bits of an int or a double. The zone map of a row group.
struct ValueRange {
  bool is_known = false;  ///< false: of other types, or without a defined value
  std::uint64_t least = 0;
  std::uint64_t greatest = 0;

  /// Whether it has a value between these bounds, which are ints or reals as the values are; a missing one is infinite.
  bool meets(const std::optional<algebra3d::Value>& low, const std::optional<algebra3d::Value>& high) const;

  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// A row of a column chunk, and the row of a column that its value goes to.
struct RowPlace {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// A column chunk that was read: gives single values, and rows into columns. Immutable.
class ColumnChunk {
 public:
  /// Takes the bytes of `count` rows. Errors: database_corrupt if they do not have the form of a chunk.
  static algebra3d::Result<std::shared_ptr<const ColumnChunk>> parse(const AttributeColumns& attribute,
                                                                     std::string bytes, std::size_t count);

  bool is_defined(std::size_t row) const { return mask_ == nullptr || ((mask_[row / 8] >> (row % 8)) & 1) == 0; }
  algebra3d::Result<algebra3d::Value> value(std::size_t row) const;
  /// Puts the values of some rows into the first rows of `column`, which has room. Errors: database_corrupt.
  algebra3d::Status read(std::size_t first, std::size_t count, algebra3d::ValueColumn& column) const;
  /// Puts the values of single rows into rows of `column`. Errors: database_corrupt.
  algebra3d::Status read(std::span<const RowPlace> places, algebra3d::ValueColumn& column) const;
  std::size_t heap_bytes() const { return bytes_.size() + ends_.size() * sizeof(ends_[0]) + sizeof(ColumnChunk); }
  /// Whether the values are what `encode` may have written, and in this range. Errors: what is wrong.
  algebra3d::Status audit(const ValueRange& range) const;

 private:
  explicit ColumnChunk(const AttributeColumns& attribute) : type_(attribute.type), attribute_form_(attribute.form) {}
  algebra3d::Status take(std::string bytes, std::size_t count);
  bool take_integers();
  bool take_reals();
  bool take_fixed();
  bool take_texts();
  bool take_words();
  bool take_mask();
  bool take_ends(std::size_t count, std::uint8_t width);
  const char* skip(std::size_t bytes);
  template <typename Number>
  Number number();
  std::int64_t integer(std::size_t row) const;
  double real(std::size_t row) const;
  std::string_view bytes_of(std::size_t row) const;
  algebra3d::Result<algebra3d::Value> decoded(std::size_t row, algebra3d::Origin origin) const;

  const algebra3d::Type* type_;
  AttributeForm attribute_form_;
  std::string bytes_;
  std::size_t position_ = 0;  // while it is taken
  std::size_t count_ = 0;
  ChunkForm form_ = ChunkForm::integers;
  const char* mask_ = nullptr;
  std::uint8_t width_ = 0;       // of integers and codes
  std::int64_t base_ = 0;        // of integers
  std::size_t value_bytes_ = 0;  // of fixed
  const char* values_ = nullptr;
  const char* codes_ = nullptr;      // of words
  std::vector<std::uint32_t> ends_;  // of texts or words, in values_
};

}  // namespace queries
