#pragma once

#include <string>
#include <string_view>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The origin of bytes. Values from elsewhere are proved to be valid again.
enum class Origin : bool { own_store, elsewhere };

/// Encodes a value in binary form, with version and checksum, the same in every host: docs/file_format.md describes
/// each field. Deterministic. Requires a loaded value, which may be undefined.
std::string encode(const Value& value);

/// Encodes a value that is to be stored, which must also be readable as a literal. Errors: limit_exceeded for numbers
/// of more than kMaxNumberDigits digits.
Result<std::string> encode_to_store(const Value& value);

/// Appends the body alone of a defined value that is to be stored. Errors: as `encode_to_store`.
Status append_body_to_store(const Value& value, std::string& bytes);
/// Decodes such a body. Safe for any bytes. Errors: database_corrupt.
Result<Value> decode_body(const Type& type, std::string_view body, Origin origin);

/// Decodes the bytes of `encode`. Safe for any bytes. Errors: database_corrupt with the position and the expectation,
/// also for an invalid mesh from elsewhere; database_version for a newer format.
Result<Value> decode(const Type& type, std::string_view bytes, Origin origin);

/// Box and count of an encoded spatial value, from its first bytes only.
Result<GeometryHeader> decode_header(std::string_view first_bytes);
inline constexpr std::size_t kCodecHeaderBytes = 96;

}  // namespace algebra3d
