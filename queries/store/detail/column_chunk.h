#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/value_column.h"
#include "algebra3d/values/types/codec.h"
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

struct EncodedChunk {
  std::string bytes;
  ValueRange range;
};

/// Collects values of an attribute, row by row, and encodes them. Filled again after `clear`, without new memory.
class ChunkBuilder {
 public:
  explicit ChunkBuilder(const AttributeColumns& attribute) : attribute_(&attribute) {}

  /// Errors: limit_exceeded for a number with too many digits; internal for a value of another type; those of loading.
  algebra3d::Status add(const algebra3d::Value& value);
  /// Adds these rows of a column of the same type.
  algebra3d::Status add(const algebra3d::ValueColumn& column, algebra3d::SelectedRows rows);
  std::size_t size() const { return undefined_.size(); }
  /// About as many bytes as the chunk will have.
  std::size_t byte_count() const;
  algebra3d::Result<algebra3d::Value> value(std::size_t row) const;
  EncodedChunk encode() const;
  void clear();

 private:
  void add_undefined();
  void add_bytes(std::string_view bytes);
  std::string_view bytes_of(std::size_t row) const;
  EncodedChunk encode_integers() const;
  EncodedChunk encode_reals() const;
  std::string encode_fixed(std::size_t width) const;
  std::string encode_texts() const;
  bool find_words(std::vector<std::string_view>& words, std::vector<std::uint32_t>& codes) const;
  std::string encode_words(const std::vector<std::string_view>& words, const std::vector<std::uint32_t>& codes) const;
  std::string head(std::uint8_t form, std::string_view parameters) const;

  const AttributeColumns* attribute_;
  std::vector<std::uint8_t> undefined_;  // by row
  bool has_undefined_ = false;
  std::vector<std::int64_t> integers_;  // of ints and truth values
  std::vector<double> reals_;
  std::string bytes_;  // of all other types: one value behind the other
  std::vector<std::size_t> ends_;
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
  std::size_t heap_bytes() const { return bytes_.size() + ends_.size() * sizeof(ends_[0]) + sizeof(ColumnChunk); }
  /// Whether the values are what `encode` may have written, and in this range. Errors: what is wrong.
  algebra3d::Status audit(const ValueRange& range) const;

 private:
  enum class Form : std::uint8_t { integers, reals, fixed, texts, words };

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
  Form form_ = Form::integers;
  const char* mask_ = nullptr;
  std::uint8_t width_ = 0;       // of integers and codes
  std::int64_t base_ = 0;        // of integers
  std::size_t value_bytes_ = 0;  // of fixed
  const char* values_ = nullptr;
  const char* codes_ = nullptr;      // of words
  std::vector<std::uint32_t> ends_;  // of texts or words, in values_
};

}  // namespace queries
