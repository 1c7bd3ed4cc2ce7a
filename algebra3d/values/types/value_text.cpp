#include "algebra3d/values/types/value_text.h"

namespace algebra3d {

void append_text(const Value& value, std::string& text) {
  const auto* const direct = value.is_defined() ? dynamic_cast<const DirectText*>(&value.type()) : nullptr;
  if (direct != nullptr)
    direct->append_text(value, text);
  else
    value.to_nested().print_to(text);
}

}  // namespace algebra3d
