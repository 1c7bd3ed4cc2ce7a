#pragma once

namespace queries {

/// Has the memory of SQLite counted as the process's (base/memory_limit.h), not as that of the user whose statement
/// runs: most of it is the page cache, which stays. A request beyond a limit is refused: out of memory, which SQLite
/// bears. To be called once, before any database is opened; a matter of the program. Does nothing if SQLite is in use
/// already.
void count_sqlite_memory();

/// Whether SQLite was refused memory for a limit on this thread since the last call.
bool take_sqlite_refusal();

}  // namespace queries
