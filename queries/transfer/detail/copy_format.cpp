#include "queries/transfer/detail/copy_format.h"

#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

using namespace std::string_view_literals;
constexpr std::string_view kSignature = "PGCOPY\n\377\r\n\0"sv;
constexpr std::string_view kBeginning =
    "PGCOPY\n\377\r\n\0"
    "\0\0\0\0\0\0\0\0"sv;
constexpr std::string_view kEnd = "\377\377"sv;
constexpr std::uint32_t kNullLength = 0xFFFF'FFFF;

Error bad_copy(std::string_view what) {
  return {ErrorCode::database_corrupt, "the server sends what is not COPY in binary format: {}", what};
}

/// Takes the next `size` bytes of `rest`.
Result<std::string_view> taken(std::string_view& rest, std::uint64_t size) {
  if (rest.size() < size) return bad_copy(fmt::format("{} bytes are missing", size - rest.size()));
  const std::string_view bytes = rest.substr(0, size);
  rest.remove_prefix(size);
  return bytes;
}

Result<std::uint64_t> taken_number(std::string_view& rest, std::size_t size) {
  A3D_ASSIGN(const std::string_view bytes, taken(rest, size));
  return big_endian(bytes);
}

Status take_beginning(std::string_view& rest) {
  A3D_ASSIGN(const std::string_view signature, taken(rest, kSignature.size()));
  if (signature != kSignature) return bad_copy("another signature");
  A3D_ASSIGN(const std::uint64_t flags, taken_number(rest, 4));
  if (flags != 0) return bad_copy("unknown flags");
  A3D_ASSIGN(const std::uint64_t extension, taken_number(rest, 4));
  A3D_TRY(taken(rest, extension));
  return {};
}

}  // namespace

void append_big_endian(std::string& bytes, std::uint64_t number, std::size_t size) {
  for (std::size_t i = size; i > 0; --i) bytes += static_cast<char>(number >> (8 * (i - 1)) & 0xFFU);
}

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char byte : bytes) number = number << 8U | static_cast<unsigned char>(byte);
  return number;
}

std::string_view copy_beginning() {
  return kBeginning;
}

std::string_view copy_end() {
  return kEnd;
}

void append_copy_row(std::string& bytes, const std::vector<std::optional<std::string>>& fields) {
  append_big_endian(bytes, fields.size(), 2);
  for (const auto& field : fields) {
    append_big_endian(bytes, field ? field->size() : kNullLength, 4);
    if (field) bytes += *field;
  }
}

Result<const CopyReader::Fields*> CopyReader::take(std::string_view message) {
  if (!has_begun_) A3D_TRY(take_beginning(message));
  has_begun_ = true;
  if (message.empty()) return static_cast<const Fields*>(nullptr);
  if (has_ended_) return bad_copy("bytes behind the end");
  has_ended_ = message == kEnd;
  if (has_ended_) return static_cast<const Fields*>(nullptr);
  A3D_ASSIGN(const std::uint64_t count, taken_number(message, 2));
  if (count != fields_.size()) return bad_copy(fmt::format("{} fields, expected {}", count, fields_.size()));
  for (auto& field : fields_) {
    A3D_ASSIGN(const std::uint64_t size, taken_number(message, 4));
    field.reset();
    if (size == kNullLength) continue;
    A3D_ASSIGN(field, taken(message, size));
  }
  if (!message.empty()) return bad_copy(fmt::format("{} bytes behind a row", message.size()));
  return static_cast<const Fields*>(&fields_);
}

}  // namespace queries
