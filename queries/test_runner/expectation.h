#pragma once

#include <string>

#include "algebra3d/types/nested_list.h"

namespace queries {

/// How far two reals may differ to count as equal.
struct Tolerance {
  double value = 0;          ///< 0: exact
  bool is_relative = false;  ///< of the expected magnitude; `value` is then a fraction, with a floor of 1e-15

  bool accepts(double expected, double found) const;
};

/// The first place where two nested lists differ, in words; empty if they agree. Atoms of different kinds never agree.
std::string first_difference(const algebra3d::NestedList& expected, const algebra3d::NestedList& found,
                             Tolerance tolerance);

/// A relation `(T (t1 t2 ...))` with its tuples sorted by their text; other results as they are.
algebra3d::NestedList with_sorted_tuples(algebra3d::NestedList result);

}  // namespace queries
