#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/value_column.h"
#include "queries/store/detail/chunk_form.h"
#include "queries/store/detail/column_chunk.h"

namespace queries {

/// The bytes of a column chunk, and the range of its values.
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
  std::string head(ChunkForm form, std::string_view parameters) const;

  const AttributeColumns* attribute_;
  std::vector<std::uint8_t> undefined_;  // by row
  bool has_undefined_ = false;
  std::vector<std::int64_t> integers_;  // of ints and truth values
  std::vector<double> reals_;
  std::string bytes_;  // of all other types: one value behind the other
  std::vector<std::size_t> ends_;
};

}  // namespace queries
