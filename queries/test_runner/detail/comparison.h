#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/values/types/nested_list.h"

namespace queries {

using algebra3d::NestedList;

/// The tolerance for comparing reals.
struct Tolerance {
  double value = 0;          ///< 0: exact
  bool is_relative = false;  ///< `value` is a fraction of the expected magnitude, at least 1e-15

  bool accepts(double expected, double found) const;
  /// Parses `X`, or `%X` for a relative tolerance in percent; nothing for other texts and negative numbers.
  static std::optional<Tolerance> parse(const std::string& text);
};

/// The first place where two nested lists differ.
struct Difference {
  std::vector<std::size_t> path;  ///< positions from the outermost list inwards, counted from 0; empty: the whole
  std::string what;               ///< "expected 4, found 3"

  /// "at /2/1: expected 4, found 3"; positions count from 1.
  std::string text() const;
};

/// Compares structure and atoms; nothing if the lists agree. An integer agrees with a real of the same value; other
/// atoms of different kinds never agree.
std::optional<Difference> first_difference(const NestedList& expected, const NestedList& found, Tolerance tolerance);

/// The list as text if it is short; else the part around the path, after the path.
std::string excerpt(const NestedList& list, const std::vector<std::size_t>& path);

/// A relation `(T (t1 t2 ...))` with its tuples sorted by their text; other results as they are.
NestedList with_sorted_tuples(NestedList result);

}  // namespace queries
