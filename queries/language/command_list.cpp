#include "queries/language/command_list.h"

#include <algorithm>
#include <array>

namespace queries {
namespace {

constexpr auto kCommands = std::to_array<CommandDescription>({
    {"query EXPRESSION", "Show the value of an expression (also `querynt`)"},
    {"explain EXPRESSION", "Show its operators, with indexes and estimated tuples, without running it"},
    {"explain query EXPRESSION", "Run it, and show its operators with calls, tuples, times and stages"},
    {"let NAME = EXPRESSION", "Make an object"},
    {"let_ NAME = EXPRESSION", "Make an object, or replace the one of this name"},
    {"derive NAME = EXPRESSION", "Make an object that is computed again when the database is restored"},
    {"create NAME : TYPE", "Make an object without a value"},
    {"update OBJECT := EXPRESSION", "Give an object a new value"},
    {"delete OBJECT", "Remove an object"},
    {"kill OBJECT", "Remove an object whose value may be damaged"},
    {"changename OBJECT to NAME", "Give an object another name"},
    {"type NAME = TYPE", "Give a type a name"},
    {"delete type TYPE", "Remove the name of a type"},
    {"save OBJECT to FILE", "Write an object to a file"},
    {"restore NAME from FILE", "Make an object from a saved file"},
    {"create database NAME", "Make a database: the file NAME.db"},
    {"open database DATABASE", "Open a database"},
    {"close database", "Close the open database"},
    {"delete database DATABASE", "Remove a database and its file"},
    {"save database to FILE", "Write the whole database to a file"},
    {"restore database NAME from FILE", "Make a database from a saved file"},
    {"check database", "Check the whole database and list its defects"},
    {"begin transaction", "Begin a transaction over several commands"},
    {"commit transaction", "Commit its changes"},
    {"abort transaction", "Undo its changes"},
    {"list databases", "List the databases in the folder"},
    {"list objects", "objects of the open database with their types"},
    {"list types", "named types of the open database"},
    {"list type constructors", "types of the language"},
    {"list operators", "operators"},
    {"list counters", "counters of exact arithmetic"},
    {"list algebras", "algebras"},
    {"if EXPRESSION then COMMAND else COMMAND endif", "Run one command or the other"},
    {"while EXPRESSION do COMMAND endwhile", "Run a command as long as the condition holds"},
    {"{ COMMAND | COMMAND }", "Run commands up to the first error; {{ ... }} goes on after errors"},
    // Commands of the shell:
    {"set \"timing\" = BOOL", "TRUE: show the time of each statement"},
    {"set \"paging\" = BOOL", "FALSE: never send long results through the pager"},
    {"set \"memory\" = INT", "Memory limit of the session in megabytes"},
    {"@FILE", "Run a script; @@FILE stops at its first error; @%FILE, @&FILE: the same, without // and /* */"},
    {"repeat INT COMMAND", "Run a command several times"},
    {"help OPERATOR", "Explain an operator, a command or a family of operators, or find a word (also `? NAME`)"},
    {"help families", "List the families of operators"},
    {"quit", "Leave (also `q`, `exit`, or Ctrl-D on an empty line)"},
});

}  // namespace

std::span<const CommandDescription> command_list() {
  return kCommands;
}

std::span<const CommandDescription> language_commands() {
  const auto* const first_of_shell =
      std::ranges::find_if(kCommands, [](const auto& command) { return command.syntax.starts_with("set "); });
  return {kCommands.begin(), first_of_shell};
}

}  // namespace queries
