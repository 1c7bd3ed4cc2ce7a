#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/store/store.h"

namespace queries {

/// An operator in an expression, or in a function that it uses, that writes files or changes stored relations.
struct Change {
  const algebra3d::Operator* op = nullptr;
  std::vector<std::string> functions = {};  ///< the functions that lead to it, each used by the one before
  /// "writes a file (exportSTL, by the functions f, g)"
  std::string text() const;
};

/// The first such operator, also in branches that may never be evaluated; nothing if there is none. Functions of the
/// database are followed, whether they are called or named. Of a name that is both an operator's and a function's both
/// count. Functions that cannot be read cannot be called either and count as without changes. Errors: those of the
/// store. Cost: linear in the size of the definitions.
Result<std::optional<Change>> find_change(const Expression& expression, Store& store,
                                          const algebra3d::Registry& registry);

/// Checks that a function with the name of an operator changes nothing, since whoever calls the operator does not
/// expect it: the function may come with data of somebody else. Functions with other names pass. Errors: wrong_usage.
Status check_operator_name(const std::string& name, const Expression& function, Store& store,
                           const algebra3d::Registry& registry);

}  // namespace queries
