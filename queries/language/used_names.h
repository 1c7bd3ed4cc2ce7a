#pragma once

#include <set>
#include <string>

#include "queries/language/syntax_tree.h"

namespace queries {

/// What an expression refers to beyond itself.
struct UsedNames {
  std::set<std::string> objects;  ///< functions among them; the parameters of functions in the expression are none
  std::set<std::string> calls;    ///< operators, of which functions may have the names
  std::set<std::string> types;    ///< all that are named, built-in ones too
};

/// Cost: linear in the expression. Recursion follows its height, which the parser bounds.
UsedNames used_names(const Expression& expression);

}  // namespace queries
