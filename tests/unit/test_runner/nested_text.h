#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "algebra3d/values/types/nested_list.h"

namespace queries {

inline algebra3d::NestedList list(const std::string& text) {
  auto parsed = algebra3d::NestedList::parse(text);
  EXPECT_TRUE(parsed.ok()) << text;
  return parsed ? std::move(parsed).value() : algebra3d::NestedList();
}

}  // namespace queries
