#pragma once

#include <optional>
#include <set>
#include <string_view>

#include <sqlite3.h>

#include "queries/store/detail/checked_pages.h"

namespace queries {

/// The name of a VFS of SQLite, registered at the first call, in which each page of a database of version 4 or later is
/// proved by its checksum when it is read, and gets one when it is written: docs/file_format.md, "Database files".
/// A page with a wrong one is SQLITE_CORRUPT, and not an error of input: at such SQLite rolls back the transaction, and
/// a check could not go on. Other databases are read and written as by SQLite's own VFS. Null: SQLite has none.
const char* checked_vfs();

/// Whether pages with wrong checksums are errors: they have checksums, and wrong ones are not tolerated.
bool proves_pages(sqlite3* connection);
/// The page at which the last error of damage occurred, if it was one of a checksum; forgets it.
std::optional<PageFault> take_page_fault(sqlite3* connection);
/// From now on, pages with wrong checksums are read as they are, and noted. For reading only.
void tolerate_page_faults(sqlite3* connection);
/// The pages with wrong checksums that were read since `forget_page_faults`, in order.
std::set<PageFault> page_faults(sqlite3* connection);
void forget_page_faults(sqlite3* connection);

}  // namespace queries
