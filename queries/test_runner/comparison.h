#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/types/nested_list.h"

namespace queries {

using algebra3d::NestedList;

/// How far two reals may differ to count as equal.
struct Tolerance {
  double value = 0;          ///< 0: exact
  bool is_relative = false;  ///< of the expected magnitude; `value` is then a fraction, with a floor of 1e-15

  bool accepts(double expected, double found) const;
  /// Reads `X`, or `%X` for a relative one in percent; nothing for what is no number, or a negative one.
  static std::optional<Tolerance> parse(const std::string& text);
};

/// The first place where two nested lists differ.
struct Difference {
  std::vector<std::size_t> path;  ///< positions from the outermost list inwards, counted from 0; empty: the whole
  std::string what;               ///< "expected 4, found 3"

  /// "at /2/1: expected 4, found 3"; positions count from 1.
  std::string text() const;
};

/// Compares structure and atoms. An integer agrees with a real of the same value, other atoms of different kinds never
/// agree. Nothing if the lists agree.
std::optional<Difference> first_difference(const NestedList& expected, const NestedList& found, Tolerance tolerance);

/// The list as text, if it is short; otherwise the neighbourhood of the place, after its path.
std::string excerpt(const NestedList& list, const std::vector<std::size_t>& path);

/// A relation `(T (t1 t2 ...))` with its tuples sorted by their text; other results as they are.
NestedList with_sorted_tuples(NestedList result);

}  // namespace queries
