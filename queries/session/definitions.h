#pragma once

#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/language/used_names.h"
#include "queries/store/store.h"

namespace queries {

/// The expression that a function or a derived object keeps. Errors: those of the parser.
Result<ExpressionPtr> kept_expression(const ObjectInfo& info, const algebra3d::Registry& registry);

/// The text that a function or a derived object keeps of its expression: the nested list. It can be read back; an
/// expression for which that fails is refused. Errors: those of the nested reader, limit_exceeded.
Result<std::string> text_to_keep(const Expression& expression, const algebra3d::Registry& registry);

/// Something that is defined by an expression, or is about to be.
struct Definition {
  std::string name;
  bool is_derived = false;
  UsedNames used;
};
/// Refuses what would make a derived object depend on itself, be it by way of others: nothing could derive it again.
/// Functions alone may call each other. Errors: wrong_usage with the names on the way.
Status check_no_circle(const Definition& definition, Store& store, const algebra3d::Registry& registry);
/// The same for what an object of the database is defined by; objects with a value of their own are none.
Status check_no_circle(const std::string& name, Store& store, const algebra3d::Registry& registry);

}  // namespace queries
