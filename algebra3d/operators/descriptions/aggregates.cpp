// sum, avg, min, max: one value of many.
#include "algebra3d/base/int128.h"
#include "algebra3d/operators/registry/aggregate.h"

#include <optional>

#include <fmt/format.h>

#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/exact/real_sum.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

/// The exact sum of ints: as many as there can be do not leave 128 bits.
struct IntSum {
  Int128 total = 0;
  std::uint64_t count = 0;

  void add(std::int64_t value) {
    total += value;
    ++count;
  }
  void add(const IntSum& other) {
    total += other.total;
    count += other.count;
  }
};

Rational total_of(const IntSum& sum) {
  constexpr unsigned kHalf = 64;
  const Rational half = Rational(std::int64_t{1} << (kHalf / 2));
  return Rational(static_cast<std::int64_t>(sum.total >> kHalf)) * half * half +
         Rational(static_cast<std::uint64_t>(sum.total));
}

Maybe<double> mean(const Rational& total, std::uint64_t count) {
  if (count == 0) return Undefined{"there is no defined value"};
  return (total / Rational(count)).nearest_double();
}

class SumOfInts {
 public:
  void step(const std::int64_t& value) { sum_.add(value); }
  void combine(SumOfInts&& later) { sum_.add(later.sum_); }
  Maybe<std::int64_t> finish() const {
    if (const auto total = static_cast<std::int64_t>(sum_.total); total == sum_.total) return total;
    return Undefined{fmt::format("the result {} is beyond the range of ints", sum_.total)};
  }

 private:
  IntSum sum_;
};

class SumOfReals {
 public:
  void step(const double& value) { sum_.add(value); }
  void combine(SumOfReals&& later) { sum_.add(later.sum_); }
  double finish() const { return sum_.total().nearest_double(); }

 private:
  RealSum sum_;
};

class MeanOfInts {
 public:
  void step(const std::int64_t& value) { sum_.add(value); }
  void combine(MeanOfInts&& later) { sum_.add(later.sum_); }
  Maybe<double> finish() const { return mean(total_of(sum_), sum_.count); }

 private:
  IntSum sum_;
};

class MeanOfReals {
 public:
  void step(const double& value) { sum_.add(value); }
  void combine(MeanOfReals&& later) { sum_.add(later.sum_); }
  Maybe<double> finish() const { return mean(sum_.total(), sum_.count()); }

 private:
  RealSum sum_;
};

/// The least or the greatest value of any type; of equal ones the first.
class Extreme final : public AggregateState {
 public:
  explicit Extreme(bool is_least) : is_least_(is_least) {}

  Status step(const Value& value, Context& /*context*/) override {
    if (!best_ || wins(compare(value, *best_))) best_ = value;
    return {};
  }
  // Compares in the column: one Value is made for each batch, of its best row.
  Status step_rows(const ValueColumn& column, SelectedRows rows, Context& context) override {
    const auto best = column.visit([&]<typename Element>(const Element* values) -> std::optional<std::size_t> {
      if constexpr (std::is_same_v<Element, Value>) {
        return std::nullopt;
      } else {
        std::optional<std::size_t> found;
        rows.for_each([&](std::size_t row) {
          if (!column.is_defined(row)) return;
          if (!found || (is_least_ ? values[row] < values[*found] : values[*found] < values[row])) found = row;
        });
        return found;
      }
    });
    if (best) return step(column.value(*best), context);
    return AggregateState::step_rows(column, rows, context);
  }
  Status combine(AggregateState& later, Context& context) override {
    const std::optional<Value>& other = static_cast<Extreme&>(later).best_;
    return other ? step(*other, context) : Status();
  }
  Result<Outcome> finish(Context& /*context*/) override {
    if (best_) return Outcome(*std::move(best_));
    return Outcome(Undefined{"there is no defined value"});
  }

 private:
  bool wins(std::strong_ordering order) const { return is_least_ ? order < 0 : order > 0; }

  bool is_least_;
  std::optional<Value> best_;
};

Overload extreme(const Type& type, bool is_least) {
  Overload overload;
  overload.parameters = {{"values", &type, true}};
  overload.result = &type;
  overload.part = &type;
  overload.start = [is_least] { return std::make_unique<Extreme>(is_least); };
  return overload;
}

/// One overload for each type.
std::vector<Overload> extremes(const Registry& registry, bool is_least) {
  std::vector<Overload> overloads;
  for (const Type* type : registry.types()) overloads.push_back(extreme(*type, is_least));
  return overloads;
}

}  // namespace

void register_aggregates(OperatorGroup& group) {
  group.add({
      .name = "sum",
      .doc = "The sum of the defined values; 0 if there are none.",
      .detail = "The sum is exact, for reals rounded once, and independent of the order. A sum beyond the range of the "
                "type is undefined.",
      .exactness = Exactness::rounded_once,
      .sources = {"neal2015"},
      .overloads = {aggregate<SumOfInts>("values"), aggregate<SumOfReals>("values")},
      .examples = {{{"1", "2", "6"}, "9"}, {{"0.5", "(real undefined)", "1.0"}, "1.5"}, {{"(int undefined)"}, "0"}},
      .errors = {{{"TRUE"}, "sum: expected values of type int or real, got bool"}},
  });
  group.add({
      .name = "avg",
      .doc = "The mean of the defined values; undefined if there are none.",
      .detail = "The exact mean, rounded once.",
      .exactness = Exactness::rounded_once,
      .sources = {"neal2015"},
      .overloads = {aggregate<MeanOfInts>("values"), aggregate<MeanOfReals>("values")},
      .examples = {{{"1", "2", "6"}, "3.0"}, {{"0.5", "(real undefined)", "1.0"}, "0.75"}, {{"(int)"}, "undefined"}},
      .errors = {{{"TRUE"}, "avg: expected values of type int or real, got bool"}},
  });
  group.add({
      .name = "min",
      .doc = "The smallest defined value, in the order of the type; undefined if there is none.",
      .overloads = extremes(group.registry(), true),
      .overload_for = [](const Type& type) { return extreme(type, true); },
      .examples = {{{"2", "1", "6"}, "1"}, {{R"("b")", R"("ab")"}, R"("ab")"}, {{"(int undefined)"}, "undefined"}},
  });
  group.add({
      .name = "max",
      .doc = "The largest defined value, in the order of the type; undefined if there is none.",
      .overloads = extremes(group.registry(), false),
      .overload_for = [](const Type& type) { return extreme(type, false); },
      .examples = {{{"0.5", "(real undefined)", "1.0"}, "1.0"}, {{"(int)"}, "undefined"}},
  });
}

}  // namespace algebra3d
