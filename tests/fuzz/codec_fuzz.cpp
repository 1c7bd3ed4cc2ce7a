// Any bytes, three ways: as a stored value; as a stored value whose type, lengths and checksum are put right, so that
// the body is reached; and as a bare body. What is accepted must be a value that comes back equal.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <xxhash.h>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/codec.h"

namespace {

using algebra3d::Origin;
using algebra3d::Type;
using algebra3d::Value;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_value(const Value& value) {
  require(compare(value, value) == 0);
  const std::string bytes = encode(value);
  const auto again = decode(value.type(), bytes, Origin::own_store);
  require(again.ok());
  require(compare(value, *again) == 0);
  require(hash(value) == hash(*again));
  require(encode(*again) == bytes);
}

void check(const algebra3d::Result<Value>& value) {
  if (value)
    check_value(*value);
  else
    require(!value.error().text().empty());
}

void put(std::string& bytes, std::size_t offset, std::uint64_t number) {
  for (std::size_t i = 0; i < 8; ++i) bytes[offset + i] = static_cast<char>(number >> (8 * i));
}

/// The bytes with the frame's magic, version, type, stored length and checksum put right.
std::string mended(const Type& type, std::string_view input) {
  std::string bytes(input);
  bytes.resize(std::max(bytes.size(), algebra3d::kCodecHeaderBytes));
  bytes.replace(0, 6,
                std::string_view("\x89"
                                 "A3D\1\0",
                                 6));
  std::string name(type.name());
  name.resize(12);
  bytes.replace(12, 12, name);
  put(bytes, 72, bytes.size() - algebra3d::kCodecHeaderBytes);
  if ((bytes[6] & 2) == 0) put(bytes, 80, bytes.size() - algebra3d::kCodecHeaderBytes);
  put(bytes, 88, XXH3_64bits_withSeed(bytes.data() + 96, bytes.size() - 96, XXH3_64bits(bytes.data(), 88)));
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // The first byte chooses type and way; the rest are the bytes.
  static const auto types = algebra3d::all_types();
  const Type& type = *types[data[0] % 16 % types.size()];
  const int way = data[0] / 16 % 4;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  (void)algebra3d::decode_header(bytes);
  if (way == 0) check(decode(type, bytes, Origin::elsewhere));
  if (way == 1) check(decode(type, mended(type, bytes), Origin::elsewhere));
  if (way == 2) check(decode(type, mended(type, bytes), Origin::own_store));
  // A bare body may repeat points and triangles, which only the frame's checksum keeps from the store.
  if (way == 3) check(type.decode(bytes, data[0] >= 128));
  return 0;
}
