#pragma once

#include <string>
#include <string_view>

#include <sqlite3.h>

#include "algebra3d/base/error.h"
#include "queries/store/detail/checked_pages.h"

namespace queries {

/// The error for a SQLite result code, with the file, the operation, and SQLite's message. `connection` may be null if
/// there is none. The only place that translates SQLite's codes.
algebra3d::Error sqlite_error(sqlite3* connection, int code, std::string_view file, std::string_view doing);

/// The error for a page with a wrong checksum, with what the user can do.
algebra3d::Error page_fault_error(std::string_view file, const PageFault& fault);
/// The end of that message.
inline constexpr std::string_view kPageFaultRemedy =
    "; bytes of the file were changed, or another program has written to it; use a saved copy, or run check database "
    "to see what is not damaged";
/// The part of that message about the page.
std::string page_fault_text(const PageFault& fault);

/// Text of a damaged file for messages: characters other than printable ASCII become question marks.
std::string ascii_text(std::string_view text);

}  // namespace queries
