// Kernels give what calls with Values give: for every operator that has one, the same values, undefined values and
// notes, row by row, on all rows and on selected ones; and aggregates of rows give what they give of Values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/operators/registry/value_column.h"
#include "base/diagnostics.h"

namespace algebra3d {
namespace {

constexpr std::size_t kRows = 64;

class Kernels : public testing::Test {
 protected:
  Value random_value(const Type& type) {
    static const std::vector<std::int64_t> ints{0,         1, -1, 2, 3, 7, 100, INT64_MAX, INT64_MIN, INT64_MIN + 1,
                                                1LL << 53U};
    static const std::vector<double> reals{0.0, -0.0, 1, -1, 0.5, 1e308, -1e308, 5e-324, 9007199254740993.0, 3.25};
    static const std::vector<std::string> texts{
        "", "a", "ab", "b", std::string(1, '\0'), "a much longer text than others"};
    const auto one_of = [&](const auto& choices) { return choices[random_() % choices.size()]; };
    if (random_() % 5 == 0) return Value(type);
    if (&type == &TypeOf<std::int64_t>::type()) return Value::of(one_of(ints));
    if (&type == &TypeOf<double>::type()) return Value::of(one_of(reals));
    if (&type == &TypeOf<bool>::type()) return Value::of<bool>(random_() % 2 == 0);
    return Value::of(one_of(texts));
  }

  ValueColumn random_column(const Type& type) {
    ValueColumn column(type);
    column.restart(kRows);
    const bool is_in_column = &type == &TypeOf<std::int64_t>::type() || &type == &TypeOf<double>::type() ||
                              &type == &TypeOf<bool>::type() || &type == &TypeOf<std::string>::type();
    for (std::size_t row = 0; row < kRows; ++row) column.set(row, is_in_column ? random_value(type) : Value(type));
    return column;
  }

  static std::vector<std::string> texts_of(const Diagnostics& notes) {
    std::vector<std::string> texts;
    for (const auto& entry : notes.entries()) texts.push_back(entry.text + " " + std::to_string(entry.count));
    return texts;
  }

  void compare(const ResolvedCall& call, SelectedRows rows) {
    SCOPED_TRACE(call.op->name + " " + call.overload->signature());
    std::vector<ValueColumn> columns;
    for (const Parameter& parameter : call.overload->parameters) columns.push_back(random_column(*parameter.type));
    std::vector<const ValueColumn*> arguments;
    for (const ValueColumn& column : columns) arguments.push_back(&column);
    ValueColumn result(*call.overload->result);
    result.restart(kRows);
    Diagnostics notes_of_kernel, notes_of_calls;
    Context of_kernel{.diagnostics = notes_of_kernel, .folder = {}},
        of_calls{.diagnostics = notes_of_calls, .folder = {}};
    const std::function<void(const Undefined&)> report = [&](const Undefined& undefined) {
      report_undefined(call, undefined, of_kernel);
    };
    call.overload->kernel({arguments, rows, result, report});
    for (std::size_t i = 0; i < rows.count; ++i) {
      std::vector<Value> values;
      for (const ValueColumn& column : columns) values.push_back(column.value(rows[i]));
      const auto expected = Registry::call(call, values, of_calls);
      ASSERT_TRUE(expected.ok()) << expected.error().text();
      const Value found = result.value(rows[i]);
      EXPECT_EQ(found.to_nested().print(), expected->to_nested().print()) << "row " << rows[i];
    }
    EXPECT_EQ(texts_of(notes_of_kernel), texts_of(notes_of_calls));
  }

  Registry registry_ = make_registry();
  std::mt19937 random_{5};
};

TEST_F(Kernels, give_what_calls_give) {
  const std::vector<std::uint32_t> some{3, 4, 9, 60, 63};
  std::size_t count = 0;
  for (const Operator* op : registry_.operators())
    for (const Overload& overload : op->overloads) {
      if (overload.kernel == nullptr) continue;
      ++count;
      for (int round = 0; round < 4; ++round) compare({op, &overload}, {nullptr, kRows});
      compare({op, &overload}, {some.data(), some.size()});
      compare({op, &overload}, {});
      if (HasFailure()) return;
    }
  EXPECT_GT(count, 100U);
}

TEST_F(Kernels, exist_for_numbers_and_strings) {
  for (const char* name : {"+", "-", "*", "/", "div", "mod", "=", "#", "<", "<=", ">", ">=", "between", "not"}) {
    const Operator* const op = registry_.find_operator(name);
    ASSERT_NE(op, nullptr) << name;
    EXPECT_TRUE(std::ranges::any_of(op->overloads, [](const Overload& each) { return each.kernel != nullptr; }))
        << name;
  }
}

TEST_F(Kernels, aggregates_of_rows_are_those_of_values) {
  const std::vector<std::uint32_t> some{0, 5, 6, 7, 40, 63};
  for (const char* name : {"sum", "avg", "min", "max"})
    for (const Type* type : {&TypeOf<std::int64_t>::type(), &TypeOf<double>::type(), &TypeOf<bool>::type(),
                             &TypeOf<std::string>::type()}) {
      const std::vector<TypeExpr> types{type->term()};
      const auto call = registry_.resolve(*registry_.find_operator(name), types);
      if (!call || call->overload->parameters.front().type != type) continue;
      SCOPED_TRACE(std::string(name) + " of " + std::string(type->name()));
      for (const SelectedRows rows : {SelectedRows{nullptr, kRows}, {some.data(), some.size()}, {}}) {
        const ValueColumn column = random_column(*type);
        Diagnostics notes, other_notes;
        Context context{.diagnostics = notes, .folder = {}}, other{.diagnostics = other_notes, .folder = {}};
        Aggregation of_rows(*call), of_values(*call);
        ASSERT_TRUE(of_rows.step_rows(column, rows, context).ok());
        for (std::size_t i = 0; i < rows.count; ++i) ASSERT_TRUE(of_values.step(column.value(rows[i]), other).ok());
        const auto found = of_rows.finish(context);
        const auto expected = of_values.finish(other);
        ASSERT_TRUE(found.ok() && expected.ok());
        EXPECT_EQ(found->to_nested().print(), expected->to_nested().print());
        EXPECT_EQ(texts_of(notes), texts_of(other_notes));
      }
    }
}

}  // namespace
}  // namespace algebra3d
