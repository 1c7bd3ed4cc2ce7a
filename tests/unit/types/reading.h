#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/value.h"

/// Values read from their text, as a statement reads them.
namespace algebra3d {

struct Reading {
  Result<Value> value;
  std::vector<Diagnostics::Entry> diagnostics;
};

inline Reading reading_of(const Type& type, std::string_view text) {
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto list = NestedList::parse(text);
  EXPECT_TRUE(list.ok()) << text;
  auto value = value_from_nested(type, *list, context);
  return {std::move(value), diagnostics.entries()};
}

}  // namespace algebra3d
