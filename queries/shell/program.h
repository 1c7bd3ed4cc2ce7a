#pragma once

namespace queries {

/// The program `algebra3d`: reads the command line, runs what it asks for, gives the exit status of docs/language.md:
/// 0 all went well, 1 a command failed, 2 wrong usage, 130 interrupted.
int run_program(int argc, char** argv);

}  // namespace queries
