#include "queries/session/detail/own_result.h"

#include "algebra3d/values/types/scalars.h"
#include "base/diagnostics.h"

namespace queries {

using About = algebra3d::Diagnostics::About;

OwnResult::OwnResult(const algebra3d::Context& context)
    : diagnostics_(context.diagnostics),
      unreadable_before_(diagnostics_.count(About::unreadable)),
      unwritten_before_(diagnostics_.count(About::unwritten)) {}

std::string_view OwnResult::failure(const Datum& value) const {
  const auto* single = std::get_if<Value>(&value.content);
  if (single == nullptr) return "";
  if (!single->is_defined()) return diagnostics_.count(About::unreadable) > unreadable_before_ ? "undefined" : "";
  const bool is_false = &single->type() == &algebra3d::TypeOf<bool>::type() && !single->get<bool>();
  return is_false && diagnostics_.count(About::unwritten) > unwritten_before_ ? "FALSE" : "";
}

}  // namespace queries
