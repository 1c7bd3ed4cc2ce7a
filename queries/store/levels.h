#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/value.h"

/// Levels of detail beside stored values: bytes that somebody has made of a value and wants to find again in another
/// process. A level belongs to the very bytes of its value: it is found for no others, and goes when its value is
/// changed or removed. It is never needed: whatever keeps it from being read or kept, it can be made again.
///
/// The functions take deferred values of a store, also after the end of their statement. They use connections of their
/// own: neither a transaction that is held for reading nor one of another writer is in the way, and kept levels are
/// seen at once. May be called by any thread.
namespace queries {

/// True for a value that levels can be kept for, if the file can be written: a large value of a stored relation or
/// object, not loaded yet.
bool is_stored(const algebra3d::Value& value);

/// The level `number` of a value; nothing if none was kept, or if it is damaged. Errors: database_busy, io_error.
algebra3d::Result<std::optional<std::string>> level_of(const algebra3d::Value& value, std::uint64_t number);
/// Reads a level without a copy: calls `visit` with the bytes, which are valid during the call. False, without a call,
/// if there is no level. Errors: also those of `visit`.
algebra3d::Result<bool> with_level(const algebra3d::Value& value, std::uint64_t number,
                                   const std::function<algebra3d::Status(std::string_view bytes)>& visit);

/// Keeps bytes as the level `number` of a value, in place of earlier ones. False if they cannot be kept: the store is
/// read-only, the value is not in the file any more (or not yet: its transaction is running), another process writes
/// for seconds, or the bytes are more than a row of SQLite holds (10^9). Errors: disk_full, io_error.
algebra3d::Result<bool> keep_level(const algebra3d::Value& value, std::uint64_t number, std::string_view bytes);

}  // namespace queries
