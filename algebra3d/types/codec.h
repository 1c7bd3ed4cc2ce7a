#pragma once

#include <string>
#include <string_view>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// Where bytes come from decides whether validity is proved again.
enum class Origin : bool { own_store, elsewhere };

/// The versioned, checksummed binary form of a value, the same in every host: docs/file_format.md has each field.
/// The same value from the same command gives the same bytes. Requires a loaded value; undefined is encoded too.
std::string encode(const Value& value);

/// The same for a value that is to be stored, and so must be readable as a literal too. Errors: limit_exceeded for
/// numbers of more than kMaxNumberDigits digits.
Result<std::string> encode_to_store(const Value& value);

/// Reads what `encode` wrote. Never crashes on any bytes. Errors: database_corrupt with the byte and the expectation,
/// database_version for a newer format. A mesh from elsewhere that is not valid is an error, not undefined.
Result<Value> decode(const Type& type, std::string_view bytes, Origin origin);

/// Box and count of an encoded value of a spatial type, from its first bytes alone.
Result<GeometryHeader> decode_header(std::string_view first_bytes);
inline constexpr std::size_t kCodecHeaderBytes = 96;

}  // namespace algebra3d
