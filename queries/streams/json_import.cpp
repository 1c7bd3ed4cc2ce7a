// importJSON: the records of a JSON file as tuples.

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/conversions/json_tree.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "algebra3d/values/types/value.h"
#include "base/error_subject.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/import_columns.h"
#include "queries/streams/detail/json_layout.h"
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

/// Converts a JSON value to a value of `type`. null is undefined; a string is itself for string and text, and is parsed
/// by list_of_text for other types; arrays are value lists, `[1, 2, 3]` for `(1 2 3)`. The tuples of a nested relation
/// are objects or arrays. Every JSON value can become a text or a string: objects and arrays are then JSON without
/// white space. Errors: invalid_value with what was found and expected.
algebra3d::Result<algebra3d::Value> value_of_json(const algebra3d::Type& type, std::string_view json,
                                                  algebra3d::Context& context);

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
    auto texts = texts_of_tuple(type, tree, tuple);
    if (!texts) return std::move(texts).error().about(fmt::format("arel: tuple {}", number));
    for (std::size_t i = 0; i < texts->size(); ++i) {
      auto value = value_of_json(*type.attributes()[i].type, (*texts)[i], context);
      if (!value)
        return std::move(value).error().about(
            fmt::format("arel: tuple {}, attribute {}", number, type.attributes()[i].name));
      values.push_back(std::move(value).value());
    }
  }
  return type.value_of(std::move(values));
}

Result<Value> value_of_json(const Type& type, std::string_view json, Context& context) {
  A3D_ASSIGN(const JsonTree tree, JsonTree::parse(json, JsonTree::kWholeDepth, context.monitor()));
  const NestedRelationType* const nested = algebra3d::as_nested_relation(type);
  if (nested != nullptr && tree.kind(0) == JsonKind::array) return nested_of_json(*nested, tree, context);
  A3D_ASSIGN(const NestedList list, list_of_json(type, tree));
  return algebra3d::value_from_nested(type, list, context);
}

/// `place`: where in the file.
Error in_json_file(const std::string& name, Error error, const std::string& place = {}) {
  if (error.code == ErrorCode::interrupted) return error;
  // Errors of the system are about the file.
  if (error.code == ErrorCode::file_missing || error.code == ErrorCode::io_error)
    return std::move(error).about("importJSON");
  if (!place.empty()) error = std::move(error).about(place);
  return algebra3d::in_text_of(name, std::move(error)).about("importJSON");
}

// A member is found by its name, or by the attribute name that is made from it.
std::unordered_map<std::string, std::size_t> positions_of(const JsonLayout& layout) {
  std::unordered_map<std::string, std::size_t> positions;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) positions.emplace(layout.columns[i], i);
  return positions;
}

/// The tuples of a JSON file, read as they are asked for.
class JsonTuples final : public TupleStream {
 public:
  JsonTuples(std::string name, JsonRecords records, const JsonLayout& layout, bool errors_are_undefined,
             Context& context)
      : name_(std::move(name)),
        records_(std::move(records)),
        columns_(layout.columns),
        types_(attribute_types(layout.tuple)),
        positions_(positions_of(layout)),
        errors_are_undefined_(errors_are_undefined),
        context_(context) {}

  Result<TuplePtr> next() override {
    A3D_TRY(context_.check_cancelled());
    const auto has_record = records_.next(record_);
    if (!has_record) return in_json_file(name_, has_record.error());
    if (!*has_record) return TuplePtr();
    const auto tree = tree_of_record(record_, context_);
    if (!tree) return in_json_file(name_, tree.error());
    Tuple made;
    for (const Type* type : types_) made.attributes.emplace_back(*type);
    A3D_TRY(fill(*tree, made));
    return std::make_shared<const Tuple>(std::move(made));
  }

 private:
  Status fill(const JsonTree& tree, Tuple& made) {
    if (tree.kind(0) != JsonKind::object) {
      const auto position = position_of(std::string(kJsonValueColumn));
      return position ? set(*position, tree.text(0), made) : Status();
    }
    std::vector<std::size_t> keys(types_.size());  // of each attribute, as parts of the tree; 0 if there is none
    for (std::size_t key = JsonTree::first(0); key != tree.end(0);) {
      const std::size_t value = tree.after(key);
      if (const auto position = position_of(tree.content(key))) {
        if (const std::size_t other = std::exchange(keys[*position], key); other != 0)
          return in_json_file(
              name_, {ErrorCode::file_format, "line {}, record {}: the members {} and {} both mean {}", record_.line,
                      record_.number, tree.text(other), tree.text(key), columns_[*position]});
        A3D_TRY(set(*position, tree.text(value), made));
      }
      key = tree.after(value);
    }
    return {};
  }

  Status set(std::size_t position, std::string_view json, Tuple& made) {
    const Type& type = *types_[position];
    auto value = value_of_json(type, json, context_);
    if (value) {
      made.attributes[position] = std::move(value).value();
      return {};
    }
    const std::string place = fmt::format("line {}, member {}", record_.line, columns_[position]);
    if (!errors_are_undefined_ || value.error().code == ErrorCode::interrupted)
      return in_json_file(name_, std::move(value).error(), place);
    made.attributes[position] = Value(type);
    context_.diagnostics.report_undefined("importJSON: " + value.error().text(), name_ + " " + place);
    return {};
  }

  // Members that no attribute stands for are remembered, too.
  std::optional<std::size_t> position_of(const std::string& member) {
    constexpr auto kNone = static_cast<std::size_t>(-1);
    auto found = positions_.find(member);
    if (found == positions_.end()) {
      const auto named = positions_.find(attribute_names_of({member}).front());
      const std::size_t position = named == positions_.end() ? kNone : named->second;
      if (positions_.size() >= kMostMembers) return position == kNone ? std::nullopt : std::optional(position);
      found = positions_.emplace(member, position).first;
    }
    return found->second == kNone ? std::nullopt : std::optional(found->second);
  }

  static constexpr std::size_t kMostMembers = 100'000;

  std::string name_;
  JsonRecords records_;
  std::vector<std::string> columns_;
  std::vector<const Type*> types_;
  std::unordered_map<std::string, std::size_t> positions_;
  bool errors_are_undefined_;
  Context& context_;
  JsonRecord record_;
};

TupleStreamPtr no_json_tuples() {
  return make_stream([]() -> Result<TuplePtr> { return TuplePtr(); });
}

JsonLayout stated_json_layout(const TypeExpr& tuple) {
  JsonLayout layout;
  layout.tuple = tuple;
  for (const auto& attribute : tuple.attributes()) layout.columns.push_back(attribute.name);
  return layout;
}

Result<JsonLayout> guessed_json_layout(const MappingCheck& check, const JsonOptions& options, Context& context) {
  A3D_ASSIGN(const std::string name, constant_file_name(check, "importJSON"));
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(name));
  auto layout = guess_json_layout(path, options, context);
  if (!layout) return in_json_file(name, layout.error());
  std::vector<std::string> attributes;
  for (const auto& attribute : layout->tuple.attributes()) attributes.push_back(attribute.name);
  const std::string note = renaming_note("importJSON", layout->columns, attributes);
  if (!note.empty()) context.diagnostics.report(note);
  return layout;
}

Result<BoundOperator> map_import_json(std::span<const ArgumentType> arguments, Context& context) {
  const MappingCheck check("importJSON", arguments);
  A3D_ASSIGN(const ImportArguments given, import_arguments(check));
  const auto options = parse_json_options(given.options);
  if (!options) return check.error(options.error().text());
  auto layout = given.tuple ? Result<JsonLayout>(stated_json_layout(*given.tuple))
                            : guessed_json_layout(check, *options, context);
  if (!layout) return std::move(layout).error();
  return BoundOperator{
      TypeExpr::stream(layout->tuple),
      [options = *options, layout = *layout](const std::vector<Datum>& values, Context& running) -> Result<Datum> {
        const Value& file = values[0].value();
        if (!file.is_defined()) return Datum{no_json_tuples()};
        const std::string& name = algebra3d::characters_of(file);
        A3D_ASSIGN(const std::filesystem::path path, running.resolve(name));
        auto opened = TextFile::open(path);
        if (!opened) return in_json_file(name, opened.error());
        if (const auto same = opened->check_state(layout.guessed_from); !same) return in_json_file(name, same.error());
        return Datum{
            TupleStreamPtr(std::make_shared<JsonTuples>(name, JsonRecords(std::move(opened).value(), options.path),
                                                        layout, options.errors_are_undefined, running))};
      }};
}

}  // namespace

void register_json_import(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "importJSON",
      .syntax = "importJSON(_ ...)",
      .doc = "The records of a JSON file as tuples, in order; types are guessed or those of a given relation.",
      .detail =
          "Records are the elements of the array that is the file, or values that follow each other (JSON lines); "
          "with the option 'records=data.items' those of the array that is the member items of the member data. "
          "`importJSON(FILE)` reads the file when the command is checked: its attributes are the members of all "
          "records, of type int, real, bool or string; objects and arrays are texts, for jsonText and jsonNumber. "
          "`importJSON(FILE, R)` takes attributes and types from the relation R, whose tuples are ignored; other "
          "members are ignored. Arrays are value lists there, as in [1, 2, 3] for a point3d, or texts such as \"(1 2 "
          "3)\". A member that is missing or null is undefined; a record that is not an object becomes the attribute "
          "Value. With the option 'errors=undefined' a value of another type is undefined, with a diagnostic that "
          "gives the line; else it is an error. Relative names start at the folder of the session.",
      .exactness = algebra3d::Exactness::exact,
      .frame_use = algebra3d::FrameUse::coordinates,
      .is_pure = false,
      .reads_files = true,
      .sources = {"rfc8259"},
      .stream = reading_stream_operator(map_import_json),
      .signatures = {"(text) -> stream(tuple)", "(text rel) -> stream(tuple)", "(text text) -> stream(tuple)",
                     "(text rel text) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"importJSON([const text value undefined], [const rel(tuple([Name: string])) value ()]) count",
                          "0"}},
      .query_errors = {{"query importJSON(5) count", "importJSON: expected text, got int"},
                       {"query importJSON('no such file.json') count", "no such file.json: No such file or directory"},
                       {"query importJSON('a.json', 'header=no') count",
                        "importJSON: unknown option 'header'; there are records and errors"}},
  });
}

}  // namespace queries
