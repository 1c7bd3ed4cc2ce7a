#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "algebra3d/base/error.h"
#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d::detail {

/// Converts between the shapes of the interface and the values of the operators.
struct ShapeAccess {
  // The constructors are explicit. NOLINTBEGIN(modernize-return-braced-init-list)
  static Solid outer(Volume3d content) { return Solid(std::make_shared<const Volume3d>(std::move(content))); }
  static Surface outer(Surface3d content) { return Surface(std::make_shared<const Surface3d>(std::move(content))); }
  // NOLINTEND(modernize-return-braced-init-list)
  template <typename Content>
  static auto outer(Result<Content> content) -> Result<decltype(outer(*std::move(content)))> {
    if (!content) return std::move(content).error();
    return outer(*std::move(content));
  }

  template <typename Derived, typename Content>
  static const Content& content(const Shape<Derived, Content>& shape) {
    return shape.content();
  }
  template <typename Derived, typename Content>
  static Value value(const Shape<Derived, Content>& shape) {
    return Value::of<Content>(shape.content());
  }
};

}  // namespace algebra3d::detail
