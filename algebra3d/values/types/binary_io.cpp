#include "algebra3d/values/types/binary_io.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "base/interruption_scope.h"

namespace algebra3d {

void ByteWriter::fixed(std::uint64_t value, int width) {
  for (int i = 0; i < width; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
}

void ByteWriter::f64(double value) {
  u64(std::bit_cast<std::uint64_t>(value));
}

void ByteWriter::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) u8(static_cast<std::uint8_t>(value | 0x80U));
  u8(static_cast<std::uint8_t>(value));
}

void ByteWriter::text(std::string_view content) {
  varint(content.size());
  raw(content);
}

void ByteWriter::planes(std::span<const std::uint64_t> values, int min_width) {
  std::uint64_t any = 0;
  for (const std::uint64_t value : values) any |= value;
  const int width = std::max(min_width, (static_cast<int>(std::bit_width(any)) + 7) / 8);
  u8(static_cast<std::uint8_t>(width));
  std::size_t end = bytes_.size();
  bytes_.resize(end + values.size() * static_cast<std::size_t>(width));
  for (int plane = width - 1; plane >= 0; --plane)
    for (const std::uint64_t value : values) {
      poll_interruption_at(end);
      bytes_[end++] = static_cast<char>(value >> (8 * plane));
    }
}

std::uint64_t ByteReader::fixed(std::size_t width) {
  const std::string_view content = raw(width);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < content.size(); ++i)
    value |= std::uint64_t{static_cast<std::uint8_t>(content[i])} << (8 * i);
  return value;
}

double ByteReader::f64() {
  return std::bit_cast<double>(fixed(8));
}

std::uint64_t ByteReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const std::uint64_t byte = u8();
    // The tenth byte has room for one bit only.
    if (shift == 63 && byte > 1) break;
    value |= (byte & 0x7FU) << shift;
    if (byte < 0x80) return value;
  }
  fail("a varint of at most 64 bits");
  return 0;
}

std::string_view ByteReader::raw(std::uint64_t length) {
  if (!ok()) return {};
  if (length > remaining()) {
    fail(fmt::format("{} more bytes, {} are left", length, remaining()));
    return {};
  }
  const std::string_view content = bytes_.substr(position_, static_cast<std::size_t>(length));
  position_ += content.size();
  return content;
}

std::size_t ByteReader::count(std::size_t bytes_each) {
  const std::uint64_t value = varint();
  if (ok() && value > remaining() / bytes_each)
    fail(fmt::format("a count of at most {}, found {}", remaining() / bytes_each, value));
  return ok() ? static_cast<std::size_t>(value) : 0;
}

std::vector<std::uint64_t> ByteReader::planes(std::size_t count, int min_width, int max_width) {
  PlaneReader reader = plane_reader(count, min_width, max_width);
  if (!ok()) return {};
  std::vector<std::uint64_t> values(count);
  for (std::uint64_t& value : values) value = reader.next();
  return values;
}

PlaneReader ByteReader::plane_reader(std::size_t count, int min_width, int max_width) {
  const int width = u8();
  if (ok() && (width < min_width || width > max_width))
    fail(fmt::format("a width of {} to {} bytes, found {}", min_width, max_width, width));
  // No product that could overflow: the count is compared with the number that the bytes at hand can hold.
  if (ok() && width > 0 && count > remaining() / static_cast<std::size_t>(width))
    fail(fmt::format("{} values of {} bytes, {} bytes are left", count, width, remaining()));
  if (!ok()) return {};
  return {raw(count * static_cast<std::size_t>(width)), count};
}

void PlaneReader::fill() {
  assert(filled_ < count_);
  poll_interruption();
  const std::size_t size = std::min(kBlock, count_ - filled_);
  block_.fill(0);
  for (std::size_t start = filled_; start < planes_.size(); start += count_)
    for (std::size_t i = 0; i < size; ++i) block_[i] = block_[i] << 8U | static_cast<std::uint8_t>(planes_[start + i]);
  filled_ += size;
  place_ = 0;
}

void ByteReader::fail_at(std::size_t position, std::string expectation) {
  if (!ok()) return;
  failed_at_ = position;
  expectation_ = std::move(expectation);
}

Status ByteReader::status() const {
  if (ok()) return {};
  return Error{ErrorCode::database_corrupt, "{}: byte {} of the body: expected {}", what_, failed_at_, expectation_};
}

Status ByteReader::finish() {
  if (ok() && remaining() > 0) fail(fmt::format("the end, {} bytes are left over", remaining()));
  return status();
}

}  // namespace algebra3d
