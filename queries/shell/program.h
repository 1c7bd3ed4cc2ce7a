#pragma once

namespace queries {

/// Runs the program `algebra3d` and returns its exit status (docs/language.md): 0 success, 1 a command failed, 2 wrong
/// usage, 130 interrupted.
int run_program(int argc, char** argv);

}  // namespace queries
