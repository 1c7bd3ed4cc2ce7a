#include "queries/shell/interactive.h"

#include <editline/readline.h>

#include <cstdlib>
#include <iostream>
#include <memory>

#include "queries/shell/interruption.h"

namespace queries {
namespace {

void print_banner(const Session&, bool has_database) {
  std::cout << "algebra3d: exact solids in a database\n"
               "Commands end with ';'. `help` lists the operators, `help volume` explains one, `quit` leaves.\n";
  if (!has_database) std::cout << "No database is open: try `create database parts; open database parts;`\n";
}

}  // namespace

void run_interactive(Session& session, StatementRunner& runner) {
  print_banner(session, session.store() != nullptr);
  CommandReader reader;
  while (true) {
    std::cout.flush();  // the prompt goes through the C library, behind the back of cout
    using Line = std::unique_ptr<char, decltype(&std::free)>;
    const Line line(readline(reader.is_pending() ? "      ...> " : "algebra3d> "), &std::free);
    if (Interruption::flag().exchange(false)) {
      reader = CommandReader();
      std::cout << "\n";
      continue;
    }
    if (line == nullptr) break;
    if (*line != '\0') add_history(line.get());
    for (const CommandText& command : reader.add_line(line.get()))
      if (runner.run(command) == RunResult::quit) return;
  }
  std::cout << "\n";
}

}  // namespace queries
