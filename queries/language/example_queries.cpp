#include "queries/language/example_queries.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/operators/registry/example_notation.h"
#include "algebra3d/operators/registry/operator.h"

namespace queries {
namespace {

using algebra3d::ExampleTerm;
using algebra3d::Operator;
using algebra3d::OperatorKind;
using algebra3d::QueryError;
using algebra3d::QueryExample;
using algebra3d::Registry;
using algebra3d::SyntaxPattern;
using Shape = SyntaxPattern::Shape;

/// The text of an operand, and whether it needs parentheses beside operators.
struct Written {
  std::string text;
  bool is_infix = false;

  std::string as_operand() const { return is_infix ? "(" + text + ")" : text; }
};

Written written_value(const ExampleTerm& term) {
  if (term.is_plain_atom) return {term.value.print()};
  return {fmt::format("[const {} value {}]", term.type->name(), term.value.print())};
}

std::string joined(const std::vector<Written>& parts, std::size_t begin, std::string_view separator) {
  std::string text;
  for (std::size_t i = begin; i < parts.size(); ++i) text += (i > begin ? std::string(separator) : "") + parts[i].text;
  return text;
}

Written written_call(const SyntaxPattern& pattern, const std::vector<Written>& arguments) {
  if (pattern.shape == Shape::prefix) return {pattern.name + "(" + joined(arguments, 0, ", ") + ")"};
  if (pattern.shape == Shape::infix && arguments.size() == 1) return {pattern.name + arguments[0].as_operand(), true};
  if (pattern.shape == Shape::infix)
    return {arguments.at(0).as_operand() + " " + pattern.name + " " + arguments.at(1).as_operand(), true};
  std::string text;
  for (std::size_t i = 0; i < pattern.operand_count; ++i) text += arguments.at(i).as_operand() + " ";
  text += pattern.name;
  if (pattern.has_brackets) text += "[" + joined(arguments, pattern.operand_count, ", ") + "]";
  return {std::move(text)};
}

/// Writes the terms of one example.
class Writer {
 public:
  /// `shown` stands where a view has `_`.
  explicit Writer(const Registry& registry, Written shown = {}) : registry_(registry), shown_(std::move(shown)) {}

  Written write(const ExampleTerm& term) const {
    switch (term.kind) {
      case ExampleTerm::Kind::value:
      case ExampleTerm::Kind::no_value:
        return written_value(term);
      case ExampleTerm::Kind::call:
        return written_call(registry_.syntax(*term.op), write(term.arguments));
      case ExampleTerm::Kind::shown_call:
        return shown_;
      case ExampleTerm::Kind::row_count:
        return {write(term.arguments.front()).as_operand() + " count"};
    }
    return {};
  }
  std::vector<Written> write(const std::vector<ExampleTerm>& terms) const {
    std::vector<Written> all;
    all.reserve(terms.size());
    for (const ExampleTerm& term : terms) all.push_back(write(term));
    return all;
  }

 private:
  const Registry& registry_;
  Written shown_;
};

// The registry is our own text; registry_sanity_test parses every example.
ExampleTerm parsed(const std::string& text, const Registry& registry) {
  auto term = ExampleTerm::parse(text, registry);
  assert(term.ok());
  return term ? std::move(term).value() : ExampleTerm();
}

std::vector<ExampleTerm> parsed(const std::vector<std::string>& texts, const Registry& registry) {
  std::vector<ExampleTerm> terms;
  terms.reserve(texts.size());
  for (const std::string& text : texts) terms.push_back(parsed(text, registry));
  return terms;
}

/// A stream of tuples whose attribute A has these values: a constant relation, or the values one after the other.
std::string written_stream(const std::vector<ExampleTerm>& values, const Writer& writer) {
  if (std::ranges::all_of(values, [](const ExampleTerm& each) { return each.kind != ExampleTerm::Kind::call; })) {
    std::string rows;
    for (const ExampleTerm& each : values)
      if (each.kind == ExampleTerm::Kind::value) rows += (rows.empty() ? "(" : " (") + each.value.print() + ")";
    return fmt::format("[const rel(tuple([A: {}])) value ({})] feed", values.front().type->name(), rows);
  }
  std::string text;
  for (const ExampleTerm& each : values)
    text += (text.empty() ? "" : " ") + writer.write(each).as_operand() + " feed" + (text.empty() ? "" : " concat");
  return text + " namedtransformstream[A]";
}

Written written_example_call(const Operator& op, const std::vector<std::string>& texts, const Registry& registry) {
  const Writer writer(registry);
  const std::vector<ExampleTerm> arguments = parsed(texts, registry);
  if (op.kind() == OperatorKind::aggregate) return {written_stream(arguments, writer) + " " + op.name + "[A]"};
  return written_call(registry.syntax(op), writer.write(arguments));
}

// An aggregate takes values; in the language they are those of an attribute (`bind_aggregate`).
std::string in_the_language(std::string message) {
  constexpr std::string_view kValues = "expected values of type";
  if (const auto at = message.find(kValues); at != std::string::npos)
    message.replace(at, kValues.size(), "expected an attribute of type");
  return message;
}

// Rows as one list.
std::string with_all_rows(const Operator& op, const std::string& call) {
  if (op.kind() != OperatorKind::table) return call;
  return call + (op.overloads.front().gives_elements ? " collect_vector" : " consume");
}

}  // namespace

std::vector<QueryExample> example_queries(const Registry& registry, const Operator& op) {
  std::vector<QueryExample> queries = op.query_examples;
  for (const algebra3d::Example& example : op.examples) {
    Written call = written_example_call(op, example.arguments, registry);
    const ExampleTerm view = parsed(example.view, registry);
    std::string query = view.kind == ExampleTerm::Kind::shown_call ? with_all_rows(op, call.text)
                                                                   : Writer(registry, std::move(call)).write(view).text;
    queries.push_back({std::move(query), example.result});
  }
  return queries;
}

std::vector<QueryError> failing_queries(const Registry& registry, const Operator& op) {
  std::vector<QueryError> queries = op.query_errors;
  for (const algebra3d::ErrorExample& example : op.errors) {
    const std::string call = written_example_call(op, example.arguments, registry).text;
    queries.push_back({"query " + with_all_rows(op, call), in_the_language(example.message)});
  }
  return queries;
}

}  // namespace queries
