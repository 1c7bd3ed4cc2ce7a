#include "queries/store/detail/column_chunk.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::ByteWriter;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Origin;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::Value;
using algebra3d::ValueColumn;

static_assert(std::endian::native == std::endian::little, "numbers of chunks are little-endian and copied as they are");

constexpr std::uint8_t kHasUndefined = 1;

bool is_integer(AttributeForm form) {
  return form == AttributeForm::integer || form == AttributeForm::boolean;
}

template <typename Number>
Number load(const char* from) {
  Number number;
  std::memcpy(&number, from, sizeof number);
  return number;
}

/// The least number of bytes, 0, 1, 2, 4 or 8, for numbers up to this one.
std::uint8_t width_for(std::uint64_t greatest) {
  if (greatest == 0) return 0;
  if (greatest <= UINT8_MAX) return 1;
  if (greatest <= UINT16_MAX) return 2;
  return greatest <= UINT32_MAX ? 4 : 8;
}

bool is_width(std::uint8_t width) {
  return width == 0 || width == 1 || width == 2 || width == 4 || width == 8;
}

void append_number(std::string& bytes, std::uint64_t number, std::uint8_t width) {
  bytes.append(reinterpret_cast<const char*>(&number), width);  // NOLINT(*-reinterpret-cast)
}

std::uint64_t number_at(const char* numbers, std::uint8_t width, std::size_t index) {
  switch (width) {
    case 1:
      return load<std::uint8_t>(numbers + index);
    case 2:
      return load<std::uint16_t>(numbers + 2 * index);
    case 4:
      return load<std::uint32_t>(numbers + 4 * index);
    case 8:
      return load<std::uint64_t>(numbers + 8 * index);
    default:
      return 0;
  }
}

/// Calls `visit(row, number)` for some rows; the width is chosen once.
template <typename Visit>
void for_each_number(const char* numbers, std::uint8_t width, std::size_t first, std::size_t count, Visit visit) {
  const auto all = [&]<typename Number>(Number /*kind*/) {
    const char* const from = numbers + sizeof(Number) * first;
    for (std::size_t i = 0; i < count; ++i) visit(i, std::uint64_t{load<Number>(from + sizeof(Number) * i)});
  };
  switch (width) {
    case 1:
      return all(std::uint8_t{});
    case 2:
      return all(std::uint16_t{});
    case 4:
      return all(std::uint32_t{});
    case 8:
      return all(std::uint64_t{});
    default:
      for (std::size_t i = 0; i < count; ++i) visit(i, std::uint64_t{0});
  }
}

Error malformed() {
  return {ErrorCode::database_corrupt, "the column chunk does not have the form of one"};
}

Value text_value(const algebra3d::Type& type, std::string_view bytes) {
  if (&type == &algebra3d::TypeOf<algebra3d::Text>::type()) return Value::of(algebra3d::Text{std::string(bytes)});
  return Value::of(std::string(bytes));
}

}  // namespace

bool ValueRange::meets(const std::optional<Value>& low, const std::optional<Value>& high) const {
  if (!is_known) return false;
  const auto is_less = [](std::uint64_t bits, const Value& value) {
    if (&value.type() == &algebra3d::TypeOf<double>::type()) return std::bit_cast<double>(bits) < value.get<double>();
    return static_cast<std::int64_t>(bits) < value.get<std::int64_t>();
  };
  const auto is_greater = [](std::uint64_t bits, const Value& value) {
    if (&value.type() == &algebra3d::TypeOf<double>::type()) return std::bit_cast<double>(bits) > value.get<double>();
    return static_cast<std::int64_t>(bits) > value.get<std::int64_t>();
  };
  return (!low || !is_less(greatest, *low)) && (!high || !is_greater(least, *high));
}

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
std::string ChunkBuilder::head(std::uint8_t form, std::string_view parameters) const {
  std::string bytes;
  ByteWriter writer(bytes);
  writer.u8(form);
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
  chunk.bytes = head(0, parameters);
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
  chunk.bytes = head(1, {});
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
  std::string bytes = head(2, parameters);
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
      head(3, std::string_view(reinterpret_cast<const char*>(&width), 1));  // NOLINT(*-reinterpret-cast)
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
  std::string bytes = head(4, parameters);
  for (const std::uint32_t code : codes) append_number(bytes, code, code_width);
  for (const std::string_view word : words) append_number(bytes, word.size(), length_width);
  for (const std::string_view word : words) bytes += word;
  return bytes;
}

Result<std::shared_ptr<const ColumnChunk>> ColumnChunk::parse(const AttributeColumns& attribute, std::string bytes,
                                                              std::size_t count) {
  std::shared_ptr<ColumnChunk> chunk(new ColumnChunk(attribute));
  A3D_TRY(chunk->take(std::move(bytes), count));
  return std::shared_ptr<const ColumnChunk>(std::move(chunk));
}

/// The next bytes; null if there are fewer.
const char* ColumnChunk::skip(std::size_t bytes) {
  if (bytes > bytes_.size() - position_) return nullptr;
  const char* const begin = bytes_.data() + position_;
  position_ += bytes;
  return begin;
}

template <typename Number>
Number ColumnChunk::number() {
  const char* const from = skip(sizeof(Number));
  return from != nullptr ? load<Number>(from) : Number{};
}

Status ColumnChunk::take(std::string bytes, std::size_t count) {
  bytes_ = std::move(bytes);
  count_ = count;
  constexpr std::size_t kLeastBytes = 2;
  if (bytes_.size() < kLeastBytes || bytes_[0] > 4) return malformed();
  form_ = static_cast<Form>(number<std::uint8_t>());
  const bool is_right_form = is_integer(attribute_form_)              ? form_ == Form::integers
                             : attribute_form_ == AttributeForm::real ? form_ == Form::reals
                                                                      : form_ >= Form::fixed;
  bool is_taken = false;
  switch (form_) {
    case Form::integers:
      is_taken = take_integers();
      break;
    case Form::reals:
      is_taken = take_reals();
      break;
    case Form::fixed:
      is_taken = take_fixed();
      break;
    case Form::texts:
      is_taken = take_texts();
      break;
    case Form::words:
      is_taken = take_words();
  }
  if (!is_right_form || !is_taken || position_ != bytes_.size()) return malformed();
  return {};
}

bool ColumnChunk::take_mask() {
  const auto flags = static_cast<std::uint8_t>(bytes_[1]);
  if (flags > kHasUndefined) return false;
  if (flags == 0) return true;
  mask_ = skip((count_ + 7) / 8);
  return mask_ != nullptr;
}

bool ColumnChunk::take_integers() {
  skip(1);
  width_ = number<std::uint8_t>();
  base_ = number<std::int64_t>();
  if (!is_width(width_) || !take_mask()) return false;
  values_ = skip(width_ * count_);
  const bool is_in_range = attribute_form_ != AttributeForm::boolean || (width_ <= 1 && (base_ == 0 || base_ == 1));
  return values_ != nullptr && is_in_range;
}

bool ColumnChunk::take_reals() {
  skip(1);
  if (!take_mask()) return false;
  values_ = skip(sizeof(double) * count_);
  return values_ != nullptr;
}

bool ColumnChunk::take_fixed() {
  skip(1);
  value_bytes_ = number<std::uint32_t>();
  if (value_bytes_ == 0 || !take_mask() || count_ > bytes_.size() / value_bytes_) return false;
  values_ = skip(value_bytes_ * count_);
  return values_ != nullptr;
}

bool ColumnChunk::take_ends(std::size_t count, std::uint8_t width) {
  if (!is_width(width) || width == 8 || (width > 0 && count > bytes_.size() / width)) return false;
  const char* const lengths = skip(width * count);
  if (lengths == nullptr) return false;
  const std::size_t left = bytes_.size() - position_;
  ends_.resize(count);
  std::uint64_t end = 0;
  for_each_number(lengths, width, 0, count, [&](std::size_t i, std::uint64_t length) {
    end += length;
    ends_[i] = static_cast<std::uint32_t>(std::min<std::uint64_t>(end, UINT32_MAX));
  });
  if (end > left) return false;
  values_ = skip(static_cast<std::size_t>(end));
  return true;
}

bool ColumnChunk::take_texts() {
  skip(1);
  const auto width = number<std::uint8_t>();
  return take_mask() && take_ends(count_, width);
}

bool ColumnChunk::take_words() {
  skip(1);
  width_ = number<std::uint8_t>();
  const auto length_width = number<std::uint8_t>();
  const auto word_count = number<std::uint32_t>();
  if (!is_width(width_) || width_ > 2 || word_count == 0 || word_count > UINT16_MAX + 1U || !take_mask()) return false;
  codes_ = skip(width_ * count_);
  if (codes_ == nullptr || !take_ends(word_count, length_width)) return false;
  bool are_known = true;
  for_each_number(codes_, width_, 0, count_,
                  [&](std::size_t, std::uint64_t code) { are_known = are_known && code < word_count; });
  return are_known;
}

std::int64_t ColumnChunk::integer(std::size_t row) const {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(base_) + number_at(values_, width_, row));
}

double ColumnChunk::real(std::size_t row) const {
  return load<double>(values_ + sizeof(double) * row);
}

std::string_view ColumnChunk::bytes_of(std::size_t row) const {
  if (form_ == Form::fixed) return {values_ + value_bytes_ * row, value_bytes_};
  const std::size_t index = form_ == Form::words ? number_at(codes_, width_, row) : row;
  const std::size_t begin = index == 0 ? 0 : ends_[index - 1];
  return {values_ + begin, ends_[index] - begin};
}

Result<Value> ColumnChunk::decoded(std::size_t row, Origin origin) const {
  if (!is_defined(row)) return Value(*type_);
  switch (attribute_form_) {
    case AttributeForm::integer:
      return Value::of(integer(row));
    case AttributeForm::boolean:
      return Value::of(integer(row) != 0);
    case AttributeForm::real:
      return Value::of(real(row));
    case AttributeForm::string:
    case AttributeForm::text:
      return text_value(*type_, bytes_of(row));
    default:
      return algebra3d::decode_body(*type_, bytes_of(row), origin);
  }
}

Result<Value> ColumnChunk::value(std::size_t row) const {
  return decoded(row, Origin::own_store);
}

Status ColumnChunk::read(std::size_t first, std::size_t count, ValueColumn& column) const {
  if (mask_ != nullptr)
    for (std::size_t i = 0; i < count; ++i)
      if (!is_defined(first + i)) column.set_undefined(i);
  if (form_ == Form::integers && column.holds<std::int64_t>()) {
    std::int64_t* const to = column.data<std::int64_t>();
    const auto base = static_cast<std::uint64_t>(base_);
    for_each_number(values_, width_, first, count,
                    [=](std::size_t i, std::uint64_t offset) { to[i] = static_cast<std::int64_t>(base + offset); });
  } else if (form_ == Form::integers && column.holds<bool>()) {
    std::uint8_t* const to = column.data<bool>();
    const auto base = static_cast<std::uint64_t>(base_);
    for_each_number(values_, width_, first, count,
                    [=](std::size_t i, std::uint64_t offset) { to[i] = (base + offset) != 0 ? 1 : 0; });
  } else if (form_ == Form::reals && column.holds<double>()) {
    std::memcpy(column.data<double>(), values_ + sizeof(double) * first, sizeof(double) * count);
  } else if (attribute_form_ == AttributeForm::string && column.holds<std::string>()) {
    std::string* const to = column.data<std::string>();
    for (std::size_t i = 0; i < count; ++i) to[i].assign(bytes_of(first + i));
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_defined(first + i)) continue;
      A3D_ASSIGN(const Value decoded_value, value(first + i));
      column.set(i, decoded_value);
    }
  }
  return {};
}

Status ColumnChunk::audit(const ValueRange& range) const {
  ValueRange found;
  for (std::size_t row = 0; row < count_; ++row) {
    A3D_ASSIGN(const Value proved, decoded(row, Origin::elsewhere));
    if (!proved.is_defined()) continue;
    if (attribute_form_ == AttributeForm::boolean && (integer(row) < 0 || integer(row) > 1)) return malformed();
    if (attribute_form_ == AttributeForm::integer) {
      const std::int64_t own = integer(row);
      const auto bits = static_cast<std::uint64_t>(own);
      if (!found.is_known) found = {true, bits, bits};
      if (own < static_cast<std::int64_t>(found.least)) found.least = bits;
      if (own > static_cast<std::int64_t>(found.greatest)) found.greatest = bits;
    } else if (attribute_form_ == AttributeForm::real) {
      const auto bits = std::bit_cast<std::uint64_t>(real(row));
      if (!found.is_known) found = {true, bits, bits};
      if (real(row) < std::bit_cast<double>(found.least)) found.least = bits;
      if (real(row) > std::bit_cast<double>(found.greatest)) found.greatest = bits;
    }
  }
  if (found == range) return {};
  return Error{ErrorCode::database_corrupt, "the least and the greatest value are not those of the column chunk"};
}

}  // namespace queries
