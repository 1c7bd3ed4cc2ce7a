#include "queries/streams/detail/json_values.h"

#include <utility>

#include <fmt/format.h>

#include "algebra3d/types/utf8.h"
#include "queries/streams/plain_text.h"

namespace queries {

using algebra3d::Context;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::JsonKind;
using algebra3d::JsonTree;
using algebra3d::NestedList;
using algebra3d::Result;
using algebra3d::Type;
using algebra3d::Value;

namespace {

bool is_fraction(std::string_view text) {
  return text.find('/') != std::string_view::npos && text.find_first_not_of("0123456789-/") == std::string_view::npos;
}

// Fractions within lists are symbols.
Result<NestedList> list_of_element(const JsonTree& tree, std::size_t part) {
  switch (tree.kind(part)) {
    case JsonKind::string: {
      std::string content = tree.content(part);
      return is_fraction(content) ? NestedList::symbol(std::move(content)) : NestedList(std::move(content));
    }
    case JsonKind::number:
      return NestedList::parse(tree.text(part));
    case JsonKind::boolean:
      return NestedList(tree.text(part) == "true");
    case JsonKind::null:
      return NestedList::symbol("undefined");
    default:
      return Error{ErrorCode::invalid_value, "expected numbers, strings and arrays, found an object"};
  }
}

// Value lists are no deeper than their types, but what is read may be: it is refused there.
Result<NestedList> list_of_array(const JsonTree& tree, std::size_t array, std::size_t depth) {
  constexpr std::size_t kDeepest = 20;
  if (depth > kDeepest) return Error{ErrorCode::invalid_value, "arrays are nested deeper than any value"};
  NestedList::List elements;
  for (std::size_t part = JsonTree::first(array); part != tree.end(array); part = tree.after(part)) {
    ALGEBRA3D_ASSIGN_OR_RETURN(NestedList element, tree.kind(part) == JsonKind::array
                                                       ? list_of_array(tree, part, depth + 1)
                                                       : list_of_element(tree, part));
    elements.push_back(std::move(element));
  }
  return NestedList(std::move(elements));
}

Result<NestedList> list_of_json(const Type& type, const JsonTree& tree) {
  const JsonKind kind = tree.kind(0);
  const bool is_characters = type.storage() == Type::Storage::text;
  if (kind == JsonKind::null) return NestedList::symbol("undefined");
  if (kind == JsonKind::string) {
    const std::string content = tree.content(0);
    if (const std::size_t at = algebra3d::first_no_text(content); at != std::string::npos)
      return Error{ErrorCode::invalid_value, "{}", algebra3d::no_text_message(content[at])};
    return list_of_text(type, content);
  }
  if (is_characters) return list_of_text(type, algebra3d::compact_json(tree.text(0)));
  if (kind == JsonKind::array) return list_of_array(tree, 0, 0);
  if (kind == JsonKind::object)
    return Error{ErrorCode::invalid_value, "expected {} as an array or a text, found an object", type.name()};
  return type.storage() == Type::Storage::bytes ? list_of_element(tree, 0) : list_of_text(type, tree.text(0));
}

}  // namespace

Result<Value> value_of_json(const Type& type, std::string_view json, Context& context) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const JsonTree tree, JsonTree::parse(json, JsonTree::kWholeDepth, context.monitor()));
  ALGEBRA3D_ASSIGN_OR_RETURN(const NestedList list, list_of_json(type, tree));
  return algebra3d::value_from_nested(type, list, context);
}

}  // namespace queries
