#pragma once

#include <cstddef>
#include <string>

#include "algebra3d/values/types/nested_list.h"

namespace queries {

/// The result list of an inquiry `(inquiry (WHAT (...)))` for people: objects, types, operators and counters as tables
/// of at most `columns`, a plan as an indented tree, findings and names one per line.
std::string inquiry_text(const algebra3d::NestedList& result, std::size_t columns);
/// A type for people: `rel: Name string, Solid volume3d`.
std::string readable_type(const algebra3d::NestedList& type);

}  // namespace queries
