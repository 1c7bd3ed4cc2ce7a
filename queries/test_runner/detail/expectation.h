#pragma once

#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/nested_list.h"
#include "queries/test_runner/detail/comparison.h"

namespace queries {

/// The expected result of the next command, set by `#yields` (docs/language.md, "Test files"). The kinds success and
/// error persist; a value, an error text and an expression hold for one command.
struct Expectation {
  enum class Kind : std::uint8_t { value, set, number, equal, undefined, success, error };
  Kind kind = Kind::value;
  NestedList value = {};     ///< kinds value, set and number; () if none was given
  std::string text = {};     ///< a part of the error message or of the note; the expression of kind equal
  std::string problem = {};  ///< why the directive is malformed; empty if it is not

  /// Parses the argument of `#yields`, except `@FILE` and `*NAME`, which need a session.
  static Expectation parse(const std::string& text);
  static Expectation of_value(NestedList expected) { return {.kind = Kind::value, .value = std::move(expected)}; }
  static Expectation with_problem(std::string why) { return {.problem = std::move(why)}; }

  /// To be called after a command and at the beginning of a test case.
  void use_up();
  /// The text for the report of a failure: "an error that contains "x"". A list is cut to the part around `difference`.
  std::string shown(const Difference& difference) const;
};

/// Whether a command met its expectation.
struct Verdict {
  bool is_right = true;
  std::string why = {};  ///< one line: the first difference
  Difference difference = {};
};

/// Judges the result or error of a command. `notes` are the diagnostics. For the kind `set` both lists must be sorted;
/// the kind `equal` is checked by a separate query.
Verdict judge(const Expectation& expectation, const algebra3d::Result<NestedList>& result,
              const std::vector<std::string>& notes, Tolerance tolerance);

}  // namespace queries
