// Every example of an operator over values is what really happens, called through the registry alone: as any host does.
#include "algebra3d/operators/registry/example_notation.h"

#include <optional>

#include <gtest/gtest.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Kind = ExampleTerm::Kind;

const Registry& examples_registry() {
  static const Registry the_registry = make_registry();
  return the_registry;
}

std::string list_text(const std::vector<std::string>& elements) {
  std::string text;
  for (const std::string& element : elements) text += (text.empty() ? "" : " ") + element;
  return "(" + text + ")";
}

/// What a call gives: a value, or the rows of a table.
struct ExampleAnswer {
  std::optional<Value> value;
  std::vector<std::string> rows;

  std::string text() const { return value ? value->to_nested().print() : list_text(rows); }
};

/// A host of the smallest kind: it evaluates terms, and has no language.
class Host {
 public:
  Result<ExampleAnswer> call(const Operator& op, const std::vector<ExampleTerm>& terms) {
    A3D_ASSIGN(std::vector<Value> values, evaluated(terms));
    std::vector<TypeExpr> types;
    for (const ExampleTerm& term : terms) types.emplace_back(type_of(term, values, types.size())->name());
    if (op.kind() == OperatorKind::aggregate) types.resize(1);
    A3D_ASSIGN(const ResolvedCall resolved, examples_registry().resolve(op, types));
    switch (resolved.overload->kind()) {
      case OperatorKind::aggregate:
        return aggregated(resolved, values);
      case OperatorKind::table:
        return table(resolved, values);
      default: {
        A3D_ASSIGN(Value value, Registry::call(resolved, values, context_));
        return ExampleAnswer{std::move(value), {}};
      }
    }
  }
  /// The value of a view of an answer, as text.
  Result<std::string> viewed(const ExampleTerm& view, ExampleAnswer answer) {
    if (view.kind == Kind::shown_call) return answer.text();
    if (view.kind == Kind::row_count) return std::to_string(answer.rows.size());
    shown_ = std::move(answer);
    A3D_ASSIGN(const Value value, evaluated(view));
    return value.to_nested().print();
  }

 private:
  const Type* type_of(const ExampleTerm& term, const std::vector<Value>& values, std::size_t place) {
    return term.kind == Kind::no_value ? term.type : &values[place].type();
  }
  Result<Value> evaluated(const ExampleTerm& term) {
    if (term.kind == Kind::shown_call) return *shown_.value;
    if (term.kind == Kind::value) return value_from_nested(*term.type, term.value, context_);
    A3D_ASSIGN(ExampleAnswer answer, call(*term.op, term.arguments));
    return *std::move(answer.value);
  }
  Result<std::vector<Value>> evaluated(const std::vector<ExampleTerm>& terms) {
    std::vector<Value> values;
    for (const ExampleTerm& term : terms) {
      if (term.kind == Kind::no_value) continue;
      A3D_ASSIGN(Value value, evaluated(term));
      values.push_back(std::move(value));
    }
    return values;
  }
  Result<ExampleAnswer> aggregated(const ResolvedCall& call, const std::vector<Value>& values) {
    Aggregation aggregation(call);
    for (const Value& value : values) A3D_TRY(aggregation.step(value, context_));
    A3D_ASSIGN(Value result, aggregation.finish(context_));
    return ExampleAnswer{std::move(result), {}};
  }
  Result<ExampleAnswer> table(const ResolvedCall& call, std::vector<Value>& values) {
    A3D_ASSIGN(const RowSourcePtr source, Registry::rows(call, values, context_));
    ExampleAnswer answer;
    while (true) {
      A3D_ASSIGN(const std::optional<Row> row, source->next(context_));
      if (!row) return answer;
      std::vector<std::string> cells;
      for (const Value& cell : *row) cells.push_back(cell.to_nested().print());
      answer.rows.push_back(call.overload->gives_elements ? cells.front() : list_text(cells));
    }
  }

  Diagnostics diagnostics_;
  Context context_{diagnostics_, nullptr, {}};
  ExampleAnswer shown_;
};

std::vector<ExampleTerm> parsed(const std::vector<std::string>& texts) {
  std::vector<ExampleTerm> terms;
  for (const std::string& text : texts) {
    auto term = ExampleTerm::parse(text, examples_registry());
    EXPECT_TRUE(term.ok()) << text << ": " << term.error().text();
    if (term) terms.push_back(*std::move(term));
  }
  return terms;
}

TEST(Examples, give_what_they_say_without_any_language) {
  std::size_t count = 0;
  for (const Operator* op : examples_registry().operators())
    for (const Example& example : op->examples) {
      SCOPED_TRACE(op->name + list_text(example.arguments) + " as " + example.view);
      Host host;
      auto answer = host.call(*op, parsed(example.arguments));
      ASSERT_TRUE(answer.ok()) << answer.error().text();
      const auto found = host.viewed(parsed({example.view}).front(), *std::move(answer));
      ASSERT_TRUE(found.ok()) << found.error().text();
      EXPECT_EQ(*found, example.result);
      ++count;
    }
  EXPECT_GT(count, 400U);
}

TEST(Examples, errors_say_what_they_say) {
  for (const Operator* op : examples_registry().operators())
    for (const ErrorExample& example : op->errors) {
      Host host;
      const auto answer = host.call(*op, parsed(example.arguments));
      ASSERT_FALSE(answer.ok()) << op->name << list_text(example.arguments);
      EXPECT_NE(answer.error().text().find(example.message), std::string::npos) << answer.error().text();
    }
}

TEST(ExampleNotation, is_read) {
  const auto term = ExampleTerm::parse("(translate (point3d (1 2 3)) (makeVector3D 1 0 -0.5))", examples_registry());
  ASSERT_TRUE(term.ok());
  EXPECT_EQ(term->kind, Kind::call);
  EXPECT_EQ(term->op->name, "translate");
  EXPECT_EQ(term->arguments[0].type->name(), "point3d");
  EXPECT_EQ(term->arguments[0].value.print(), "(1 2 3)");
  EXPECT_EQ(term->arguments[1].arguments[2].value.print(), "-0.5");
  EXPECT_EQ(ExampleTerm::parse("(int)", examples_registry())->kind, Kind::no_value);
  EXPECT_EQ(ExampleTerm::parse("(count _)", examples_registry())->arguments[0].kind, Kind::shown_call);
  EXPECT_FALSE(ExampleTerm::parse("(no_such_operator 1)", examples_registry()).ok());
  EXPECT_FALSE(ExampleTerm::parse("()", examples_registry()).ok());
  EXPECT_FALSE(ExampleTerm::parse("undefined", examples_registry()).ok());
}

}  // namespace
}  // namespace algebra3d
