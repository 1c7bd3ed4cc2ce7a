// Any bytes: the parser gives a list whose print reads back to an equal list, or an error with a place inside the
// bytes. What is a list is also read as a type term and as a value of every type, without a crash.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/type_expr.h"

namespace {

using algebra3d::NestedList;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_print(const NestedList& list) {
  const auto text = list.print();
  const auto again = NestedList::parse(text);
  require(again.ok());
  require(*again == list);
  require(again->print() == text);
  require(list.print_short(20).size() <= 23);
}

void check_type_term(const NestedList& list) {
  const auto type = algebra3d::TypeExpr::from_nested(list);
  if (!type) return;
  require(type->to_nested() == list);
}

void check_value(const algebra3d::Type& type, const NestedList& list) {
  algebra3d::Diagnostics diagnostics;
  algebra3d::Context context{diagnostics, nullptr, {}};
  const auto value = value_from_nested(type, list, context);
  if (!value) {
    require(!value.error().text().empty());
    return;
  }
  require(value->is_defined() || list.is_undefined() || !diagnostics.empty());
  const auto printed = NestedList::parse(value->to_nested().print());
  require(printed.ok());
  const auto again = value_from_nested(type, *printed, context);
  require(again.ok());
  require(compare(*value, *again) == 0);
  require(hash(*value) == hash(*again));
}

void check_values(const NestedList& list) {
  using algebra3d::TypeOf;
  check_value(TypeOf<std::int64_t>::type(), list);
  check_value(TypeOf<double>::type(), list);
  check_value(TypeOf<bool>::type(), list);
  check_value(TypeOf<std::string>::type(), list);
  check_value(TypeOf<algebra3d::Text>::type(), list);
  check_value(TypeOf<algebra3d::Point3d>::type(), list);
  check_value(TypeOf<algebra3d::Vector3d>::type(), list);
  check_value(TypeOf<algebra3d::Points3d>::type(), list);
  check_value(TypeOf<algebra3d::Plane3d>::type(), list);
  check_value(TypeOf<algebra3d::Box3>::type(), list);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view source(reinterpret_cast<const char*>(data), size);
  const auto list = NestedList::parse(source);
  if (!list) {
    require(!list.error().text().empty());
    require(list.error().place.line >= 1 && list.error().place.column >= 1);
    require(static_cast<std::size_t>(list.error().place.column) <= size + 1);
    return 0;
  }
  check_print(*list);
  check_type_term(*list);
  check_values(*list);
  return 0;
}
