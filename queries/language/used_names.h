#pragma once

#include <set>
#include <string>

#include "queries/language/syntax_tree.h"

namespace queries {

/// The names of objects, operators and types that an expression refers to.
struct UsedNames {
  std::set<std::string> objects;    ///< including function objects, without parameters of functions in the expression
  std::set<std::string> calls;      ///< operators that are called; function objects may have these names
  std::set<std::string> operators;  ///< all operators, also those that are called
  std::set<std::string> types;      ///< including built-in types
};

/// Collects the names of an expression. Cost: linear. Recursion depth: its height, which the parser limits.
UsedNames used_names(const Expression& expression);

}  // namespace queries
