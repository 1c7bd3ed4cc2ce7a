#include "algebra3d/types/value.h"

#include <algorithm>
#include <cassert>

namespace algebra3d {

bool Type::is_spatial() const {
  const auto all = kinds();
  return std::find(all.begin(), all.end(), Kind::spatial3d) != all.end();
}

// Not in the header: GCC 12 with AddressSanitizer takes the unused part of the variant for an uninitialised read.
Value::Value(const Type& type) : type_(&type) {}

std::shared_ptr<const DeferredValue> Value::deferred() const {
  const auto* const deferred = std::get_if<std::shared_ptr<const DeferredValue>>(&content_);
  return deferred != nullptr ? *deferred : nullptr;
}

Result<Value> Value::loaded() const {
  const auto* const deferred = std::get_if<std::shared_ptr<const DeferredValue>>(&content_);
  if (deferred == nullptr) return *this;
  return (*deferred)->load();
}

GeometryHeader Value::header() const {
  assert(is_defined());
  const auto* const deferred = std::get_if<std::shared_ptr<const DeferredValue>>(&content_);
  return deferred != nullptr ? (*deferred)->header() : type_->header(*this);
}

NestedList Value::to_nested() const {
  assert(!is_deferred());
  return is_defined() ? type_->to_nested(*this) : NestedList::symbol("undefined");
}

std::strong_ordering compare(const Value& a, const Value& b) {
  assert(&a.type() == &b.type() && !a.is_deferred() && !b.is_deferred());
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
