#include "queries/store/detail/chunk_builder.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "algebra3d/values/types/binary_io.h"
#include "base/propagate.h"

namespace queries {

using algebra3d::ByteWriter;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Origin;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::Value;
using algebra3d::ValueColumn;

Status ChunkBuilder::add(const Value& value) {
  if (&value.type() != attribute_->type)
    return Error{ErrorCode::internal, "a value of type {} for '{}', expected {}", value.type().term().text(),
                 attribute_->name, attribute_->type->term().text()};
  if (!value.is_defined()) return add_undefined(), Status();
  A3D_ASSIGN(const Value loaded, value.loaded());
  switch (attribute_->form) {
    case AttributeForm::integer:
      integers_.push_back(loaded.get<std::int64_t>());
      break;
    case AttributeForm::boolean:
      integers_.push_back(loaded.get<bool>() ? 1 : 0);
      break;
    case AttributeForm::real:
      reals_.push_back(loaded.get<double>());
      break;
    case AttributeForm::string:
      add_bytes(loaded.get<std::string>());
      break;
    case AttributeForm::text:
      add_bytes(loaded.get<algebra3d::Text>().content);
      break;
    default:
      A3D_TRY(algebra3d::append_body_to_store(loaded, bytes_));
      ends_.push_back(bytes_.size());
  }
  undefined_.push_back(0);
  return {};
}

void ChunkBuilder::add_undefined() {
  if (is_integer(attribute_->form))
    integers_.push_back(0);
  else if (attribute_->form == AttributeForm::real)
    reals_.push_back(0);
  else
    ends_.push_back(bytes_.size());
  undefined_.push_back(1);
  has_undefined_ = true;
}

void ChunkBuilder::add_bytes(std::string_view bytes) {
  bytes_ += bytes;
  ends_.push_back(bytes_.size());
}

Status ChunkBuilder::add(const ValueColumn& column, algebra3d::SelectedRows rows) {
  const bool is_typed =
      column.holds<std::int64_t>() || column.holds<double>() || column.holds<bool>() || column.holds<std::string>();
  if (&column.type() != attribute_->type || !is_typed || column.size() == 0) {
    for (std::size_t i = 0; i < rows.count; ++i) A3D_TRY(add(column.value(rows[i])));
    return {};
  }
  const auto each = [&](const auto* array, auto put) {
    rows.for_each([&](std::size_t row) {
      if (!column.is_defined(row)) return add_undefined();
      put(array[row]);
      undefined_.push_back(0);
    });
  };
  column.visit([&]<typename Element>(const Element* array) {
    if constexpr (std::is_same_v<Element, std::int64_t> || std::is_same_v<Element, std::uint8_t>)
      each(array, [&](Element value) { integers_.push_back(value); });
    else if constexpr (std::is_same_v<Element, double>)
      each(array, [&](double value) { reals_.push_back(value); });
    else if constexpr (std::is_same_v<Element, std::string>)
      each(array, [&](const std::string& value) { add_bytes(value); });
  });
  return {};
}

std::size_t ChunkBuilder::byte_count() const {
  return integers_.size() * sizeof(std::int64_t) + reals_.size() * sizeof(double) + bytes_.size();
}

std::string_view ChunkBuilder::bytes_of(std::size_t row) const {
  const std::size_t begin = row == 0 ? 0 : ends_[row - 1];
  return std::string_view(bytes_).substr(begin, ends_[row] - begin);
}

Result<Value> ChunkBuilder::value(std::size_t row) const {
  if (undefined_[row] != 0) return Value(*attribute_->type);
  switch (attribute_->form) {
    case AttributeForm::integer:
      return Value::of(integers_[row]);
    case AttributeForm::boolean:
      return Value::of(integers_[row] != 0);
    case AttributeForm::real:
      return Value::of(reals_[row]);
    case AttributeForm::string:
    case AttributeForm::text:
      return text_value(*attribute_->type, bytes_of(row));
    default:
      return algebra3d::decode_body(*attribute_->type, bytes_of(row), Origin::own_store);
  }
}

void ChunkBuilder::clear() {
  undefined_.clear();
  has_undefined_ = false;
  integers_.clear();
  reals_.clear();
  bytes_.clear();
  ends_.clear();
}

EncodedChunk ChunkBuilder::encode() const {
  if (is_integer(attribute_->form)) return encode_integers();
  if (attribute_->form == AttributeForm::real) return encode_reals();
  std::size_t width = 0;
  bool has_width = true;
  for (std::size_t row = 0; row < size(); ++row) {
    if (undefined_[row] != 0) continue;
    const std::size_t own = bytes_of(row).size();
    has_width = has_width && own > 0 && (width == 0 || width == own);
    width = own;
  }
  std::vector<std::string_view> words;
  std::vector<std::uint32_t> codes;
  if (find_words(words, codes)) return {encode_words(words, codes), {}};
  if (has_width && width > 0) return {encode_fixed(width), {}};
  return {encode_texts(), {}};
}

/// Form, flags, the parameters of the form, and the mask of undefined values if there are any.
std::string ChunkBuilder::head(ChunkForm form, std::string_view parameters) const {
  std::string bytes;
  ByteWriter writer(bytes);
  writer.u8(static_cast<std::uint8_t>(form));
  writer.u8(has_undefined_ ? kHasUndefined : 0);
  writer.raw(parameters);
  if (!has_undefined_) return bytes;
  const std::size_t begin = bytes.size();
  bytes.resize(begin + (size() + 7) / 8);
  for (std::size_t row = 0; row < size(); ++row)
    if (undefined_[row] != 0) bytes[begin + row / 8] = static_cast<char>(bytes[begin + row / 8] | (1 << (row % 8)));
  return bytes;
}

EncodedChunk ChunkBuilder::encode_integers() const {
  EncodedChunk chunk;
  std::int64_t least = INT64_MAX;
  std::int64_t greatest = INT64_MIN;
  for (std::size_t row = 0; row < size(); ++row) {
    if (undefined_[row] != 0) continue;
    least = std::min(least, integers_[row]);
    greatest = std::max(greatest, integers_[row]);
  }
  const bool has_values = least <= greatest;
  if (!has_values) least = greatest = 0;
  if (has_values && attribute_->form == AttributeForm::integer)
    chunk.range = {true, static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(greatest)};
  const auto base = static_cast<std::uint64_t>(least);
  const std::uint8_t width = width_for(static_cast<std::uint64_t>(greatest) - base);
  std::string parameters;
  ByteWriter writer(parameters);
  writer.u8(width);
  writer.u64(base);
  chunk.bytes = head(ChunkForm::integers, parameters);
  const std::size_t begin = chunk.bytes.size();
  chunk.bytes.resize(begin + width * size());
  char* to = chunk.bytes.data() + begin;
  for (std::size_t row = 0; row < size() && width > 0; ++row, to += width) {
    const std::uint64_t offset = undefined_[row] != 0 ? 0 : static_cast<std::uint64_t>(integers_[row]) - base;
    std::memcpy(to, &offset, width);
  }
  return chunk;
}

EncodedChunk ChunkBuilder::encode_reals() const {
  EncodedChunk chunk;
  chunk.bytes = head(ChunkForm::reals, {});
  chunk.bytes.append(reinterpret_cast<const char*>(reals_.data()),  // NOLINT(*-reinterpret-cast)
                     reals_.size() * sizeof(double));
  for (std::size_t row = 0; row < size(); ++row) {
    if (undefined_[row] != 0) continue;
    const auto bits = std::bit_cast<std::uint64_t>(reals_[row]);
    if (!chunk.range.is_known) chunk.range = {true, bits, bits};
    if (reals_[row] < std::bit_cast<double>(chunk.range.least)) chunk.range.least = bits;
    if (reals_[row] > std::bit_cast<double>(chunk.range.greatest)) chunk.range.greatest = bits;
  }
  return chunk;
}

std::string ChunkBuilder::encode_fixed(std::size_t width) const {
  std::string parameters;
  ByteWriter(parameters).u32(static_cast<std::uint32_t>(width));
  std::string bytes = head(ChunkForm::fixed, parameters);
  bytes.reserve(bytes.size() + width * size());
  for (std::size_t row = 0; row < size(); ++row) {
    if (undefined_[row] != 0)
      bytes.append(width, '\0');
    else
      bytes += bytes_of(row);
  }
  return bytes;
}

std::string ChunkBuilder::encode_texts() const {
  std::size_t longest = 0;
  for (std::size_t row = 0; row < size(); ++row) longest = std::max(longest, bytes_of(row).size());
  const std::uint8_t width = width_for(longest);
  std::string bytes =
      head(ChunkForm::texts, std::string_view(reinterpret_cast<const char*>(&width), 1));  // NOLINT(*-reinterpret-cast)
  for (std::size_t row = 0; row < size(); ++row) append_number(bytes, bytes_of(row).size(), width);
  return bytes += bytes_;
}

/// The different values in the order of their first rows, and the number of that of each row; false if there are too
/// many for it to pay.
bool ChunkBuilder::find_words(std::vector<std::string_view>& words, std::vector<std::uint32_t>& codes) const {
  constexpr std::size_t kSample = 256;
  std::unordered_map<std::string_view, std::uint32_t> known;
  codes.reserve(size());
  for (std::size_t row = 0; row < size(); ++row) {
    if (undefined_[row] != 0) {
      codes.push_back(0);
      continue;
    }
    const auto [place, is_new] = known.try_emplace(bytes_of(row), static_cast<std::uint32_t>(words.size()));
    if (is_new) words.push_back(place->first);
    codes.push_back(place->second);
    if ((row == kSample && words.size() > kSample / 2) || words.size() > UINT16_MAX) return false;
  }
  std::size_t word_bytes = 0;
  for (const std::string_view word : words) word_bytes += word.size() + 4;
  return !words.empty() && word_bytes + size() * width_for(words.size() - 1) < bytes_.size() + size() / 2;
}

std::string ChunkBuilder::encode_words(const std::vector<std::string_view>& words,
                                       const std::vector<std::uint32_t>& codes) const {
  std::size_t longest = 0;
  for (const std::string_view word : words) longest = std::max(longest, word.size());
  const std::uint8_t length_width = width_for(longest);
  const std::uint8_t code_width = width_for(words.size() - 1);
  std::string parameters;
  ByteWriter writer(parameters);
  writer.u8(code_width);
  writer.u8(length_width);
  writer.u32(static_cast<std::uint32_t>(words.size()));
  std::string bytes = head(ChunkForm::words, parameters);
  for (const std::uint32_t code : codes) append_number(bytes, code, code_width);
  for (const std::string_view word : words) append_number(bytes, word.size(), length_width);
  for (const std::string_view word : words) bytes += word;
  return bytes;
}

}  // namespace queries
