#include "algebra3d/values/types/value.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/values/types/type_expr.h"

namespace algebra3d {

namespace {

[[maybe_unused]] bool have_one_order(const Type& a, const Type& b) {
  return &a == &b || (a.storage() == Type::Storage::text && b.storage() == Type::Storage::text);
}

}  // namespace

TypeExpr Type::term() const {
  return {name()};
}

bool Type::is_spatial() const {
  const auto is_of_space = [](Kind kind) { return kind == Kind::spatial2d || kind == Kind::spatial3d; };
  return std::ranges::any_of(kinds(), is_of_space);
}

std::string_view Type::kind_name(Kind kind) {
  switch (kind) {
    case Kind::data:
      return "DATA";
    case Kind::spatial2d:
      return "SPATIAL2D";
    case Kind::spatial3d:
      return "SPATIAL3D";
    case Kind::numeric:
      break;
  }
  return "NUMERIC";
}

std::shared_ptr<const DeferredValue> Value::deferred() const {
  return is_deferred() ? deferred_content() : nullptr;
}

Result<Value> Value::loaded() const {
  if (!is_deferred()) return *this;
  return deferred_content()->load();
}

GeometryHeader Value::header() const {
  assert(is_defined());
  return is_deferred() ? deferred_content()->header() : type_->header(*this);
}

NestedList Value::to_nested() const {
  assert(!is_deferred());
  return is_defined() ? type_->to_nested(*this) : NestedList::symbol("undefined");
}

std::strong_ordering compare(const Value& a, const Value& b) {
  assert(have_one_order(a.type(), b.type()) && !a.is_deferred() && !b.is_deferred());
  if (!a.is_defined() || !b.is_defined()) return a.is_defined() <=> b.is_defined();
  return a.type().compare(a, b);
}

std::size_t hash(const Value& value) {
  assert(!value.is_deferred());
  return value.is_defined() ? value.type().hash(value) : 0;
}

std::size_t heap_bytes(const Value& value) {
  constexpr std::size_t kDeferred = 192;  // where it lies and its header
  if (value.is_deferred()) return kDeferred;
  return value.is_defined() ? value.type().heap_bytes(value) : 0;
}

Result<Value> value_from_nested(const Type& type, const NestedList& list, Context& context) {
  if (list.is_undefined()) return Value(type);
  return type.from_nested(list, context);
}

}  // namespace algebra3d
