#include "algebra3d/operators/registry/conversion.h"

#include <array>
#include <cassert>

#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

struct Conversion {
  std::string_view from, to;
  std::size_t cost;
};

constexpr std::array kConversions = {Conversion{"int", "real", 1}, Conversion{"string", "text", 1},
                                     Conversion{"text", "string", 100}};

}  // namespace

std::optional<std::size_t> conversion_cost(const TypeExpr& from, std::string_view to) {
  if (!from.arguments().empty()) return std::nullopt;
  if (from.is(to)) return 0;
  for (const Conversion& each : kConversions)
    if (from.is(each.from) && to == each.to) return each.cost;
  return std::nullopt;
}

Value converted(const Value& value, const Type& to) {
  if (&value.type() == &to) return value;
  assert(conversion_cost(TypeExpr(value.type().name()), to.name()));
  if (!value.is_defined()) return Value(to);
  if (&to == &TypeOf<double>::type()) return Value::of(static_cast<double>(value.get<std::int64_t>()));
  if (&to == &TypeOf<Text>::type()) return Value::of(Text{characters_of(value)});
  return Value::of(characters_of(value));
}

}  // namespace algebra3d
