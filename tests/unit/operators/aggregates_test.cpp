// However the input of an aggregate is divided into consecutive parts, the parts combined give the same result.
#include "algebra3d/operators/registry/aggregate.h"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "unit/operators/call_operator.h"
#include "unit/operators/range_samples.h"

namespace algebra3d {
namespace {

const Registry& aggregates_registry() {
  static const Registry the_registry = make_registry();
  return the_registry;
}

struct Outcome {
  std::string value;
  std::vector<std::string> notes;
  bool operator==(const Outcome&) const = default;
};

/// The result of runs over the parts between the given ends, combined one after the other, or as a balanced tree.
class Division {
 public:
  Division(const ResolvedCall& call, const std::vector<Value>& values) : call_(call), values_(values) {}

  Outcome in_one() { return finished(run(0, values_.size())); }
  Outcome from_the_left(const std::vector<std::size_t>& ends) {
    Aggregation all(call_);
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      Aggregation part = run(std::exchange(begin, end), end);
      EXPECT_TRUE(all.combine(part, context_).ok());
    }
    return finished(std::move(all));
  }
  Outcome as_a_tree() { return finished(tree(0, values_.size())); }

 private:
  Aggregation run(std::size_t begin, std::size_t end) {
    Aggregation part(call_);
    for (std::size_t i = begin; i < end; ++i) EXPECT_TRUE(part.step(values_[i], context_).ok());
    return part;
  }
  Aggregation tree(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return run(begin, end);
    Aggregation left = tree(begin, (begin + end) / 2);
    Aggregation right = tree((begin + end) / 2, end);
    EXPECT_TRUE(left.combine(right, context_).ok());
    return left;
  }
  Outcome finished(Aggregation all) {
    Diagnostics diagnostics;
    Context context{diagnostics, nullptr, {}};
    const auto value = all.finish(context);
    if (!value) return {value.error().text(), {}};
    return {value->to_nested().print(), diagnostics.summary()};
  }

  ResolvedCall call_;
  const std::vector<Value>& values_;
  Diagnostics diagnostics_;
  Context context_{diagnostics_, nullptr, {}};
};

/// Numbers of all sizes, points that make simple and crossing polygons, and samples of the other types.
std::optional<Value> random_value(const Type& type, std::mt19937& random) {
  const auto bits = std::uint64_t{random()} << 32U | random();
  if (type.name() == "int") return Value::of(static_cast<std::int64_t>(bits) >> (bits % 64));
  if (type.name() == "real") {
    const auto number = std::bit_cast<double>(bits);
    return std::isfinite(number) ? std::optional(Value::of<double>(number)) : std::nullopt;
  }
  if (type.name() == "point")
    return ranges::read(
        type, NestedList::list(NestedList(static_cast<double>(bits % 5)), NestedList(static_cast<double>(bits % 7))));
  return ranges::read(type, ranges::sample(type, random()));
}

std::vector<Value> random_values(const Type& type, std::mt19937& random) {
  std::vector<Value> values;
  const std::size_t count = random() % 9;
  for (std::size_t i = 0; i < count; ++i) {
    auto value = random_value(type, random);
    values.push_back(value && random() % 5 != 0 ? *std::move(value) : Value(type));
  }
  return values;
}

std::vector<std::size_t> random_ends(std::size_t count, std::mt19937& random) {
  std::vector<std::size_t> ends = {count};
  for (std::size_t i = random() % 5; i > 0; --i) ends.push_back(random() % (count + 1));
  std::ranges::sort(ends);
  return ends;
}

TEST(Aggregates, any_division_gives_the_same) {
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same numbers each time
  std::size_t overloads = 0;
  for (const Operator* op : aggregates_registry().operators()) {
    if (op->kind() != OperatorKind::aggregate) continue;
    for (const Overload& overload : op->overloads) {
      ++overloads;
      SCOPED_TRACE(op->name + overload.signature());
      for (int round = 0; round < 40; ++round) {
        const std::vector<Value> values = random_values(*overload.parameters[0].type, random);
        Division division({op, &overload}, values);
        const Outcome expected = division.in_one();
        EXPECT_EQ(division.from_the_left(random_ends(values.size(), random)), expected);
        EXPECT_EQ(division.as_a_tree(), expected);
      }
    }
  }
  EXPECT_GE(overloads, 9U);
}

/// The result of an aggregate over these values, as text.
std::string aggregate_of(const std::string& name, const std::vector<Value>& values) {
  const Operator& op = *aggregates_registry().find_operator(name);
  const std::vector<TypeExpr> types = {TypeExpr(values.front().type().name())};
  return Division(*aggregates_registry().resolve(op, types), values).in_one().value;
}

TEST(Aggregates, sums_leave_no_carry_behind) {
  const auto real = [](double x) { return Value::of<double>(x); };
  EXPECT_EQ(aggregate_of("sum", {real(1e308), real(1e308), real(-1e308)}), "1e+308");
  EXPECT_EQ(aggregate_of("avg", {real(1e308), real(1e308)}), "1e+308");
  const auto integer = [](std::int64_t x) { return Value::of<std::int64_t>(x); };
  EXPECT_EQ(aggregate_of("sum", {integer(INT64_MAX), integer(1), integer(-1)}), "9223372036854775807");
  EXPECT_EQ(aggregate_of("sum", {integer(INT64_MAX), integer(1)}), "undefined");
  EXPECT_EQ(aggregate_of("avg", {integer(INT64_MIN), integer(INT64_MIN)}), "-9223372036854775808.0");
}

// Boxes at 0, 1, ... 4 of length 2: [0,6] is their union, and [1,2] the common part of the first two.
TEST(Aggregates, solids_are_united_and_intersected) {
  std::vector<Value> cubes;
  for (int x = 0; x < 5; ++x) cubes.push_back(Value::of(calls::cube(calls::point(x, 0, 0), calls::point(x + 2, 2, 2))));
  const auto volume_of = [&](const std::string& name, std::size_t count) {
    const std::vector<Value> first(cubes.begin(), cubes.begin() + static_cast<std::ptrdiff_t>(count));
    const Operator& op = *aggregates_registry().find_operator(name);
    Diagnostics diagnostics;
    Context context{diagnostics, nullptr, {}};
    const std::vector<TypeExpr> types = {TypeExpr("volume3d")};
    Aggregation aggregation(*aggregates_registry().resolve(op, types));
    for (const Value& cube : first) EXPECT_TRUE(aggregation.step(cube, context).ok());
    return calls::call("volume", *aggregation.finish(context)).get<double>();
  };
  EXPECT_EQ(volume_of("union_aggr", 5), 24);
  EXPECT_EQ(volume_of("union_aggr", 1), 8);
  EXPECT_EQ(volume_of("intersection_aggr", 2), 4);
  EXPECT_EQ(volume_of("intersection_aggr", 3), 0);
}

}  // namespace
}  // namespace algebra3d
