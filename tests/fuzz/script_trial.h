#pragma once

#include <string>
#include <string_view>

#include "fuzz/script_world.h"

namespace queries::fuzz {

/// Most commands of a script that are looked at, and the longest script.
inline constexpr std::size_t kMaxCommands = 8;
inline constexpr std::size_t kMaxScriptBytes = 2000;

/// The commands of a script, as the shell would cut them. Those that the shell carries out itself are left out.
std::vector<std::string> commands_of(std::string_view script);

/// Runs a script in a session of its own and ends the process if something does not hold that always holds:
///   a command that fails leaves the objects, and what they hold, as they were;
///   `abort transaction` brings back what was there at its beginning;
///   a query that changes nothing gives the same answer when it is asked again;
///   the nested form of a query, printed and read back, is the same, and gives the same answer;
///   at the end `check database` finds nothing, and the file holds what the session saw;
///   the database, saved and restored under another name, has the same values (of every fourth script).
/// What takes longer than the deadline is interrupted and then ends the script.
void try_script(std::string_view script, const ScriptWorld& world, Deadline& deadline);

}  // namespace queries::fuzz
