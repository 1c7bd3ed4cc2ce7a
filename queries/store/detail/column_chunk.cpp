#include "queries/store/detail/column_chunk.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Origin;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::Value;
using algebra3d::ValueColumn;

static_assert(std::endian::native == std::endian::little, "numbers of chunks are little-endian and copied as they are");

Error malformed() {
  return {ErrorCode::database_corrupt, "the column chunk does not have the form of one"};
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
  return from != nullptr ? load_number<Number>(from) : Number{};
}

Status ColumnChunk::take(std::string bytes, std::size_t count) {
  bytes_ = std::move(bytes);
  count_ = count;
  constexpr std::size_t kLeastBytes = 2;
  if (bytes_.size() < kLeastBytes || bytes_[0] > 4) return malformed();
  form_ = static_cast<ChunkForm>(number<std::uint8_t>());
  const bool is_right_form = is_integer(attribute_form_)              ? form_ == ChunkForm::integers
                             : attribute_form_ == AttributeForm::real ? form_ == ChunkForm::reals
                                                                      : form_ >= ChunkForm::fixed;
  bool is_taken = false;
  switch (form_) {
    case ChunkForm::integers:
      is_taken = take_integers();
      break;
    case ChunkForm::reals:
      is_taken = take_reals();
      break;
    case ChunkForm::fixed:
      is_taken = take_fixed();
      break;
    case ChunkForm::texts:
      is_taken = take_texts();
      break;
    case ChunkForm::words:
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
  return load_number<double>(values_ + sizeof(double) * row);
}

std::string_view ColumnChunk::bytes_of(std::size_t row) const {
  if (form_ == ChunkForm::fixed) return {values_ + value_bytes_ * row, value_bytes_};
  const std::size_t index = form_ == ChunkForm::words ? number_at(codes_, width_, row) : row;
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
  if (form_ == ChunkForm::integers && column.holds<std::int64_t>()) {
    std::int64_t* const to = column.data<std::int64_t>();
    const auto base = static_cast<std::uint64_t>(base_);
    for_each_number(values_, width_, first, count,
                    [=](std::size_t i, std::uint64_t offset) { to[i] = static_cast<std::int64_t>(base + offset); });
  } else if (form_ == ChunkForm::integers && column.holds<bool>()) {
    std::uint8_t* const to = column.data<bool>();
    const auto base = static_cast<std::uint64_t>(base_);
    for_each_number(values_, width_, first, count,
                    [=](std::size_t i, std::uint64_t offset) { to[i] = (base + offset) != 0 ? 1 : 0; });
  } else if (form_ == ChunkForm::reals && column.holds<double>()) {
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

Status ColumnChunk::read(std::span<const RowPlace> places, ValueColumn& column) const {
  const auto each = [&](auto put) {
    for (const RowPlace& place : places) {
      if (is_defined(place.from))
        put(place);
      else
        column.set_undefined(place.to);
    }
  };
  if (form_ == ChunkForm::integers && column.holds<std::int64_t>()) {
    each([&, to = column.data<std::int64_t>()](const RowPlace& place) { to[place.to] = integer(place.from); });
  } else if (form_ == ChunkForm::integers && column.holds<bool>()) {
    each([&, to = column.data<bool>()](const RowPlace& place) { to[place.to] = integer(place.from) != 0 ? 1 : 0; });
  } else if (form_ == ChunkForm::reals && column.holds<double>()) {
    each([&, to = column.data<double>()](const RowPlace& place) { to[place.to] = real(place.from); });
  } else if (attribute_form_ == AttributeForm::string && column.holds<std::string>()) {
    each([&, to = column.data<std::string>()](const RowPlace& place) { to[place.to].assign(bytes_of(place.from)); });
  } else {
    for (const RowPlace& place : places) {
      A3D_ASSIGN(const Value decoded_value, value(place.from));
      column.set(place.to, decoded_value);
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
