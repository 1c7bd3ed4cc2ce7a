// intstream, transformstream, getDirectory: streams of values.
#include <fnmatch.h>

#include <algorithm>
#include <system_error>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Result<Plan> map_intstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("intstream", arguments);
  RETURN_IF_ERROR(check.type(0, "int"));
  RETURN_IF_ERROR(check.type(1, "int"));
  return Plan{TypeExpr::stream("int"), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const Value& first = given[0].value();
                const Value& last = given[1].value();
                const bool is_empty = !first.is_defined() || !last.is_defined();
                std::int64_t next = is_empty ? 1 : first.get<std::int32_t>();
                const std::int64_t end = is_empty ? 0 : last.get<std::int32_t>();
                return Datum{make_value_stream([next, end, &context]() mutable -> Result<std::optional<Value>> {
                  if (next > end) return std::optional<Value>();
                  if (next % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
                  return std::optional(Value::of<std::int32_t>(static_cast<std::int32_t>(next++)));
                })};
              }};
}

Datum values_as_tuples(const ValueStreamPtr& values) {
  return Datum{make_stream([values]() -> Result<TuplePtr> {
    ASSIGN_OR_RETURN(auto value, values->next());
    if (!value) return TuplePtr();
    return TuplePtr(std::make_shared<const Tuple>(Tuple{{std::move(*value)}}));
  })};
}

Datum tuples_as_values(const TupleStreamPtr& tuples) {
  return Datum{make_value_stream([tuples]() -> Result<std::optional<Value>> {
    ASSIGN_OR_RETURN(const TuplePtr tuple, tuples->next());
    return tuple == nullptr ? std::optional<Value>() : std::optional(tuple->attributes[0]);
  })};
}

Result<Plan> map_transformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("transformstream", arguments);
  const TypeExpr& type = check[0].type;
  if (type.is_tuple_stream() && type.element().attributes().size() == 1)
    return Plan{
        TypeExpr::stream(type.element().attributes()[0].type),
        [](std::vector<Datum> given, Context&) -> Result<Datum> { return tuples_as_values(given[0].tuples()); }};
  if (!type.is_stream() || type.is_tuple_stream())
    return check.expected("a stream of values, or of tuples with one attribute", type);
  return Plan{TypeExpr::stream(TypeExpr::tuple({{"Elem", type.element()}})),
              [](std::vector<Datum> given, Context&) -> Result<Datum> { return values_as_tuples(given[0].values()); }};
}

// Every regular file in the folder and below whose name fits the pattern, as `folder/...`, sorted.
Result<std::vector<std::string>> files_below(const std::filesystem::path& folder, const std::string& shown,
                                             const std::string& pattern, const Context& context) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<std::string> files;
  auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
  if (error)
    return Error{ErrorCode::file_missing, "getDirectory: '{}': {}, expected a folder that can be read", shown,
                 error.message()};
  for (; entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (error) return Error{ErrorCode::io_error, "getDirectory: '{}': {}", shown, error.message()};
    RETURN_IF_ERROR(context.check_cancelled());
    std::error_code ignored;  // a file that has gone meanwhile, or a dangling link, is no file
    if (!entry->is_regular_file(ignored)) continue;
    if (fnmatch(pattern.c_str(), entry->path().filename().c_str(), 0) != 0) continue;
    files.push_back((fs::path(shown) / entry->path().lexically_relative(folder)).string());
  }
  std::ranges::sort(files);
  return files;
}

Result<Plan> map_get_directory(std::span<const ArgumentType> arguments) {
  const MappingCheck check("getDirectory", arguments);
  RETURN_IF_ERROR(check.argument_count(1, 2));
  for (std::size_t place = 0; place < check.count(); ++place) RETURN_IF_ERROR(check.type(place, "text"));
  return Plan{
      TypeExpr::stream("text"), [](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
        std::vector<std::string> words;
        for (const Datum& word : given)
          if (word.value().is_defined()) words.push_back(word.value().get<algebra3d::Text>().content);
        std::vector<std::string> files;
        if (words.size() == given.size()) {
          const std::string pattern = words.size() == 2 ? words[1] : "*";
          ASSIGN_OR_RETURN(files, files_below(context.resolve(words[0]), words[0], pattern, context));
        }
        return Datum{make_value_stream([files, position = std::size_t{0}]() mutable -> Result<std::optional<Value>> {
          if (position == files.size()) return std::optional<Value>();
          return std::optional(Value::of<algebra3d::Text>({files[position++]}));
        })};
      }};
}

}  // namespace

void register_elements(algebra3d::Registry& registry) {
  registry.add({
      .name = "intstream",
      .syntax = "intstream(_, _)",
      .doc = "The ints from the first to the last, both included; none if the first is larger or one is undefined.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_intstream),
      .signatures = {"(int int) -> stream(int)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 5) count", "5"},
                   {"intstream(2, 1) count", "0"},
                   {"intstream([const int value undefined], 1) count", "0"}},
      .errors = {{"query intstream(1, 2.5) count", "intstream: expected int, got real"}},
  });
  registry.add({
      .name = "transformstream",
      .syntax = "_ transformstream",
      .doc = "A stream of values as tuples with the single attribute Elem, or such tuples as a stream of their values.",
      .stream = stream_operator(map_transformstream),
      .signatures = {"(stream(DATA)) -> stream(tuple((Elem DATA)))", "(stream(tuple((NAME DATA)))) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream consume", "((1) (2))"},
                   {"[const rel(tuple([A: int])) value ((7))] feed transformstream transformstream consume", "((7))"},
                   {"[const int value undefined] feed transformstream consume", "((undefined))"}},
      .errors = {{"query 5 transformstream",
                  "transformstream: expected a stream of values, or of tuples with one attribute, got int"}},
  });
  registry.add({
      .name = "getDirectory",
      .syntax = "getDirectory(_ ...)",
      .doc = "The names of the files in a folder and below, sorted; with a pattern (such as '*.stl') only those that "
             "fit it.",
      .detail =
          "The pattern is matched against the file's own name: `*` any characters, `?` one, `[...]` one of a set.",
      .stream = stream_operator(map_get_directory),
      .signatures = {"(text) -> stream(text)", "(text text) -> stream(text)"},
      .handles_undefined = true,
      .examples = {{"getDirectory('.', 'no such file*') count", "0"},
                   {"getDirectory([const text value undefined]) count", "0"}},
      .errors = {{"query getDirectory('/no/such/folder') count",
                  "getDirectory: '/no/such/folder': No such file or directory, expected a folder that can be read"},
                 {"query getDirectory(5) count", "getDirectory: expected text, got int"}},
  });
}

}  // namespace queries
