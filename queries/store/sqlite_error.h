#pragma once

#include <string>
#include <string_view>

#include <sqlite3.h>

#include "algebra3d/base/error.h"

namespace queries {

/// The error for a SQLite result code, with file, what was being done, and SQLite's own words. `connection` may be null
/// if there is none. The only place that translates SQLite's codes.
algebra3d::Error sqlite_error(sqlite3* connection, int code, std::string_view file, std::string_view doing);

/// Text of a damaged file as messages show it: each character that is not printable ASCII is a question mark.
std::string ascii_text(std::string_view text);

}  // namespace queries
