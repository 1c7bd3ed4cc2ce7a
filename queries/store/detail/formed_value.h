#pragma once

#include <memory>
#include <string>
#include <utility>

#include "algebra3d/values/types/value.h"

namespace queries {

/// A value in memory beside its binary form, which need not be the one that encoding it would give.
class FormedValue final : public algebra3d::DeferredValue, public std::enable_shared_from_this<FormedValue> {
 public:
  FormedValue(algebra3d::Value value, std::string form) : value_(std::move(value)), form_(std::move(form)) {}

  algebra3d::GeometryHeader header() const override { return value_.header(); }
  algebra3d::Result<algebra3d::Value> load() const override { return value_; }
  std::shared_ptr<const algebra3d::DeferredSource> source() const override;
  void append_reference(std::string& bytes) const override { bytes.push_back('\0'); }
  const std::string& form() const { return form_; }

 private:
  algebra3d::Value value_;
  std::string form_;
};

}  // namespace queries
