#include "queries/streams/detail/json_values.h"

#include <utility>

#include <fmt/format.h>

#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "queries/streams/plain_text.h"

namespace queries {

using algebra3d::Context;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::JsonKind;
using algebra3d::JsonTree;
using algebra3d::NestedList;
using algebra3d::NestedRelationType;
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

// Value lists are no deeper than their types, but the input may be: it is refused there.
Result<NestedList> list_of_array(const JsonTree& tree, std::size_t array, std::size_t depth) {
  constexpr std::size_t kDeepest = 20;
  if (depth > kDeepest) return Error{ErrorCode::invalid_value, "arrays are nested deeper than any value"};
  NestedList::List elements;
  for (std::size_t part = JsonTree::first(array); part != tree.end(array); part = tree.after(part)) {
    A3D_ASSIGN(NestedList element,
               tree.kind(part) == JsonKind::array ? list_of_array(tree, part, depth + 1) : list_of_element(tree, part));
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

/// The JSON texts of the attributes of a tuple: an object with their names, where members may be missing, or an array.
Result<std::vector<std::string_view>> texts_of_tuple(const NestedRelationType& type, const JsonTree& tree,
                                                     std::size_t tuple) {
  std::vector<std::string_view> texts;
  if (tree.kind(tuple) == JsonKind::object) {
    for (const auto& attribute : type.attributes()) {
      const auto member = tree.member(tuple, attribute.name);
      texts.push_back(member ? tree.text(*member) : "null");
    }
    return texts;
  }
  if (tree.kind(tuple) == JsonKind::array)
    for (std::size_t part = JsonTree::first(tuple); part != tree.end(tuple); part = tree.after(part))
      texts.push_back(tree.text(part));
  if (texts.size() == type.attributes().size()) return texts;
  return Error{ErrorCode::invalid_value, "expected an object or an array of {} values", type.attributes().size()};
}

// Recursion, by value_of_json, follows the nesting of the type.
Result<Value> nested_of_json(const NestedRelationType& type, const JsonTree& tree, Context& context) {
  std::vector<Value> values;
  std::size_t number = 0;
  for (std::size_t tuple = JsonTree::first(0); tuple != tree.end(0); tuple = tree.after(tuple)) {
    if (++number % 256 == 0) A3D_TRY(context.check_cancelled());
    const auto texts = texts_of_tuple(type, tree, tuple);
    if (!texts) return Error{texts.error().code, "arel: tuple {}: {}", number, texts.error().message};
    for (std::size_t i = 0; i < texts->size(); ++i) {
      auto value = value_of_json(*type.attributes()[i].type, (*texts)[i], context);
      if (!value)
        return Error{value.error().code, "arel: tuple {}, attribute {}: {}", number, type.attributes()[i].name,
                     value.error().message};
      values.push_back(std::move(value).value());
    }
  }
  return type.value_of(std::move(values));
}

}  // namespace

Result<Value> value_of_json(const Type& type, std::string_view json, Context& context) {
  A3D_ASSIGN(const JsonTree tree, JsonTree::parse(json, JsonTree::kWholeDepth, context.monitor()));
  const NestedRelationType* const nested = algebra3d::as_nested_relation(type);
  if (nested != nullptr && tree.kind(0) == JsonKind::array) return nested_of_json(*nested, tree, context);
  A3D_ASSIGN(const NestedList list, list_of_json(type, tree));
  return algebra3d::value_from_nested(type, list, context);
}

}  // namespace queries
