#pragma once

#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/types/nested_list.h"
#include "queries/test_runner/comparison.h"

namespace queries {

/// What the next command is to give (language.md 5.1, 5.2): the state that `#yields` sets. The kinds success and error
/// persist; a value, an error text and an expression are used up by a command.
struct Expectation {
  enum class Kind : std::uint8_t { value, set, number, equal, undefined, success, error };
  Kind kind = Kind::value;
  NestedList value = {};     ///< kinds value, set and number; () if none was given
  std::string text = {};     ///< a part of the error message or of the note; the expression of kind equal
  std::string problem = {};  ///< why the directive could not be understood; empty if it could

  /// Reads what `#yields` says, but for `@FILE` and `*NAME`, which need a session.
  static Expectation parse(const std::string& text);
  static Expectation of_value(NestedList expected) { return {.kind = Kind::value, .value = std::move(expected)}; }
  static Expectation with_problem(std::string why) { return {.problem = std::move(why)}; }

  /// After a command, and at the beginning of a test case.
  void use_up();
  /// For the report of a failure: "an error that contains "x"". A list is cut to the neighbourhood of `difference`.
  std::string shown(const Difference& difference) const;
};

/// Whether a command gave what was expected.
struct Verdict {
  bool is_right = true;
  std::string why = {};  ///< one line: the first difference
  Difference difference = {};
};

/// Judges a result, or the error of the command. `notes` are the diagnostics. Of the kind `set` both lists are sorted
/// already; of the kind `equal` there is nothing to judge, since that is asked as a query of its own.
Verdict judge(const Expectation& expectation, const algebra3d::Result<NestedList>& result,
              const std::vector<std::string>& notes, Tolerance tolerance);

}  // namespace queries
