#pragma once

#include <string>

#include "queries/session/session.h"

namespace queries {

/// The text of `result_list`, made value by value: the list of large geometry takes many times the memory.
Result<std::string> result_text(const TypeExpr& type, const Datum& value, Context& context);
/// The text of `value_list`, likewise.
Result<std::string> value_text(const TypeExpr& type, const Datum& value, Context& context);

}  // namespace queries
