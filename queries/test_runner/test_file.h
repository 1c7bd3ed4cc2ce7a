#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "algebra3d/base/error.h"
#include "queries/language/command_reader.h"

namespace queries {

/// A line of a test file that begins with `#` and a directive word, continued lines joined.
struct Directive {
  std::string word;      ///< setup, testcase, yields, ...
  std::string argument;  ///< the rest of the line
  int line = 0;
};

/// A test file (language.md 5) as the sequence of its directives and commands.
using TestStep = std::variant<Directive, CommandText>;
std::vector<TestStep> read_test_steps(std::string_view content, const std::string& file);

}  // namespace queries
