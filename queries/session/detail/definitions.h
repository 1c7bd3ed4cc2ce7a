#pragma once

#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/language/used_names.h"
#include "queries/store/store.h"

namespace queries {

/// Parses the stored expression of a function or a derived object. Errors: those of the parser.
Result<ExpressionPtr> kept_expression(const ObjectInfo& info, const algebra3d::Registry& registry);

/// The text of an expression as the store keeps it for a function or a derived object: the nested list. It can be read
/// back. Errors: those of the nested reader, limit_exceeded.
Result<std::string> text_to_keep(const Expression& expression, const algebra3d::Registry& registry);

/// An object that is defined by an expression, or is about to be.
struct Definition {
  std::string name;
  bool is_derived = false;
  UsedNames used;
};
/// Checks that no derived object would depend on itself, directly or through others. Functions may call each other.
/// Errors: wrong_usage with the names of the cycle.
Status check_no_circle(const Definition& definition, Store& store, const algebra3d::Registry& registry);
/// Checks an object of the database in this way; one that is not defined by an expression passes.
Status check_no_circle(const std::string& name, Store& store, const algebra3d::Registry& registry);

}  // namespace queries
