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

/// A test file (docs/language.md, "Test files") as the sequence of its directives and commands.
using TestStep = std::variant<Directive, CommandText>;
std::vector<TestStep> read_test_steps(std::string_view content, const std::string& file);

/// Reads an `.examples` file (docs/language.md, "Examples") as test steps: a block becomes a test case that yields its
/// result. A further directive is `unjudged REASON`: the commands of the case are run, but not judged. Errors:
/// file_format with the line, what was found and what was expected.
algebra3d::Result<std::vector<TestStep>> read_example_steps(std::string_view content, const std::string& file);

/// The text without white space at its ends.
std::string_view trimmed(std::string_view text);
/// Removes the first line from `content` and returns it without its line end.
std::string_view take_line(std::string_view& content);

}  // namespace queries
