#include "queries/store/stored_form.h"

#include <memory>
#include <utility>

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/formed_value.h"
#include "queries/store/detail/stored_value.h"

namespace queries {
namespace {

/// The only value that this source has.
class FormedSource final : public algebra3d::DeferredSource {
 public:
  FormedSource(const algebra3d::Type& type, std::shared_ptr<const FormedValue> value)
      : type_(type), value_(std::move(value)) {}

  bool is_same_as(const DeferredSource& other) const override {
    const auto* const one = dynamic_cast<const FormedSource*>(&other);
    return one != nullptr && one->value_ == value_;
  }
  Value value(std::string_view /*reference*/) const override { return {type_, value_}; }

 private:
  const algebra3d::Type& type_;
  std::shared_ptr<const FormedValue> value_;
};

}  // namespace

std::shared_ptr<const algebra3d::DeferredSource> FormedValue::source() const {
  return std::make_shared<FormedSource>(value_.type(), shared_from_this());
}

Result<std::string> stored_form(const Value& value) {
  if (const auto deferred = value.deferred()) {
    if (const auto* stored = dynamic_cast<const StoredValue*>(deferred.get())) return stored->encoded();
    if (const auto* formed = dynamic_cast<const FormedValue*>(deferred.get())) return formed->form();
  }
  A3D_ASSIGN(const Value loaded, value.loaded());
  return algebra3d::encode_to_store(loaded);
}

Value with_form(const Value& value, std::string bytes) {
  return {value.type(), std::make_shared<FormedValue>(value, std::move(bytes))};
}

}  // namespace queries
