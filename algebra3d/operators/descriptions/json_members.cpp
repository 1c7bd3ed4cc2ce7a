// jsonText, jsonNumber: members of JSON objects, so that properties of features can be used in queries.
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/conversions/json_tree.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

/// A member's kind and text as it is written; strings without quotes and escapes.
struct JsonMember {
  JsonKind kind;
  std::string text;
};

std::string quoted_key(std::string_view key) {
  return fmt::format("\"{}\"", utf8_prefix(one_line(key), 60));
}

Result<Maybe<JsonMember>> json_member(const Context& context, const Text& object, std::string_view key) {
  const auto tree = JsonTree::parse(object.content, 1, context.monitor());
  if (!tree && tree.error().code == ErrorCode::interrupted) return tree.error();
  if (!tree) return Maybe<JsonMember>(Undefined{tree.error().text()});
  if (tree->kind(0) != JsonKind::object) return Maybe<JsonMember>(Undefined{"the text is not a JSON object"});
  const auto member = tree->member(0, key);
  if (!member) return Maybe<JsonMember>(Undefined{"the object has no member " + quoted_key(key)});
  const JsonKind kind = tree->kind(*member);
  return Maybe<JsonMember>(
      JsonMember{kind, kind == JsonKind::string ? tree->content(*member) : compact_json(tree->text(*member))});
}

Result<Maybe<Text>> json_text(Context& context, const Text& object, const Text& name) {
  const std::string& key = name.content;
  A3D_ASSIGN(auto member, json_member(context, object, key));
  if (!member) return Maybe<Text>(Undefined{member.reason()});
  if (const std::size_t at = first_no_text(member->text); at != std::string::npos)
    return Maybe<Text>(Undefined{"the member " + quoted_key(key) + ": " + no_text_message(member->text[at])});
  return Maybe<Text>(Text{std::move(member->text)});
}

Result<Maybe<double>> json_number(Context& context, const Text& object, const Text& name) {
  const std::string& key = name.content;
  A3D_ASSIGN(const auto member, json_member(context, object, key));
  if (!member) return Maybe<double>(Undefined{member.reason()});
  if (member->kind != JsonKind::number)
    return Maybe<double>(Undefined{"the member " + quoted_key(key) + " is not a number"});
  const auto number = parse_real(member->text);
  if (!number) return Maybe<double>(Undefined{"the member " + quoted_key(key) + " is beyond the range of doubles"});
  return Maybe<double>(*number);
}

}  // namespace

void register_json_members(OperatorGroup& group) {
  group.add({
      .name = "jsonText",
      .syntax = "jsonText(_, _)",
      .doc = "The member of this name of a JSON object: a string unchanged, any other value as JSON.",
      .detail =
          "Of several members with the name the last one is taken. JSON has no white space between its parts; null "
          "is 'null'. Undefined if there is no such member, if the text is not a JSON object, or for a string with a "
          "zero character, which texts cannot have.",
      .sources = {"rfc8259"},
      .overloads = {overload<&json_text>("object", "name")},
      .examples = {{{R"('{"name": "Green Park", "trees": [3, 4]}')", R"("name")"}, "'Green Park'"},
                   {{R"('{"name": "Green Park", "trees": [3, 4]}')", "'trees'"}, "'[3,4]'"},
                   {{R"('{"name": "Green Park"}')", R"("Name")"}, "undefined"},
                   {{"(text undefined)", R"("name")"}, "undefined"},
                   {{R"('"name"')", R"('{"name": 1}')"}, "undefined"}},
      .errors = {{{R"('{"a": 1}')", "1"}, "jsonText: expected (text text), got (text int)"}},
  });
  group.add({
      .name = "jsonNumber",
      .syntax = "jsonNumber(_, _)",
      .doc = "The number of this name in a JSON object, as the nearest real.",
      .detail = "Undefined if there is no such member, if it is not a number or beyond the range of reals, or if the "
                "text is not a JSON object. Of several members with the name the last one is taken.",
      .exactness = Exactness::rounded_once,
      .sources = {"rfc8259"},
      .overloads = {overload<&json_number>("object", "name")},
      .examples = {{{R"('{"name": "Green Park", "trees": 1e2}')", R"("trees")"}, "100.0"},
                   {{R"('{"trees": 7}')", "'trees'"}, "7.0"},
                   {{R"('{"name": "Green Park"}')", R"("name")"}, "undefined"},
                   {{"(text undefined)", R"("name")"}, "undefined"}},
      .errors = {{{R"('{"a": 1}')", "1"}, "jsonNumber: expected (text text), got (text int)"}},
  });
}

}  // namespace algebra3d
