// = # < <= > >= between, isdefined, ifthenelse: the same for every type, by the type's own order.
#include <array>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Test = bool (*)(std::strong_ordering);

const Type& int_type() {
  return TypeOf<std::int64_t>::type();
}
const Type& real_type() {
  return TypeOf<double>::type();
}

// Loaded, defined values of one type, or an int and a real.
std::strong_ordering order_of(const Value& a, const Value& b) {
  if (&a.type() == &b.type()) return compare(a, b);
  if (&a.type() == &int_type()) return compare(a.get<std::int64_t>(), b.get<double>());
  return 0 <=> compare(b.get<std::int64_t>(), a.get<double>());
}

Overload comparison(const Type& left, const Type& right, Test holds) {
  Overload overload;
  overload.is_symmetric = &left == &right && holds(std::strong_ordering::less) == holds(std::strong_ordering::greater);
  overload.is_total = true;
  overload.never_fails = !left.is_large() && !right.is_large();
  overload.parameters = {{"a", &left}, {"b", &right}};
  overload.result = &TypeOf<bool>::type();
  overload.function = [holds](std::span<const Value> values, Context&) -> Result<Outcome> {
    if (!values[0].is_deferred() && !values[1].is_deferred())
      return Outcome(Value::of<bool>(holds(order_of(values[0], values[1]))));
    A3D_ASSIGN(const Value a, values[0].loaded());
    A3D_ASSIGN(const Value b, values[1].loaded());
    return Outcome(Value::of<bool>(holds(order_of(a, b))));
  };
  return overload;
}

Overload range_test(const Type& type, const Type& lower, const Type& upper) {
  Overload overload;
  overload.is_total = true;
  overload.never_fails = !type.is_large();
  overload.parameters = {{"x", &type}, {"low", &lower}, {"high", &upper}};
  overload.result = &TypeOf<bool>::type();
  overload.function = [](std::span<const Value> values, Context&) -> Result<Outcome> {
    A3D_ASSIGN(const Value x, values[0].loaded());
    A3D_ASSIGN(const Value low, values[1].loaded());
    A3D_ASSIGN(const Value high, values[2].loaded());
    return Outcome(Value::of<bool>(order_of(low, x) <= 0 && order_of(x, high) <= 0));
  };
  return overload;
}

Overload definedness(const Type& type) {
  Overload overload;
  overload.is_total = true;
  overload.never_fails = true;
  overload.parameters = {{"x", &type, true}};
  overload.result = &TypeOf<bool>::type();
  overload.function = [](std::span<const Value> values, Context&) -> Result<Outcome> {
    return Outcome(Value::of<bool>(values[0].is_defined()));
  };
  return overload;
}

Overload choice(const Type& type) {
  Overload overload;
  overload.never_fails = true;
  overload.parameters = {{"condition", &TypeOf<bool>::type(), true}, {"yes", &type, true}, {"no", &type, true}};
  overload.result = &type;
  overload.function = [](std::span<const Value> values, Context&) -> Result<Outcome> {
    if (!values[0].is_defined()) return Outcome(Undefined{"the condition is undefined"});
    return Outcome(values[0].get<bool>() ? values[1] : values[2]);
  };
  return overload;
}

template <typename Make>
std::vector<Overload> for_all_types(const Registry& registry, Make make) {
  std::vector<Overload> overloads;
  for (const Type* type : registry.types()) overloads.push_back(make(*type));
  return overloads;
}

// For two values of each type, and for an int and a real.
std::vector<Overload> comparisons(const Registry& registry, Test holds) {
  auto overloads = for_all_types(registry, [&](const Type& type) { return comparison(type, type, holds); });
  overloads.push_back(comparison(int_type(), real_type(), holds));
  overloads.push_back(comparison(real_type(), int_type(), holds));
  return overloads;
}

// For three values of each type, and for ints among reals.
std::vector<Overload> range_tests(const Registry& registry) {
  auto overloads = for_all_types(registry, [](const Type& type) { return range_test(type, type, type); });
  const Type& i = int_type();
  const Type& r = real_type();
  for (const auto& [x, low, high] : std::initializer_list<std::array<const Type*, 3>>{
           {&i, &i, &r}, {&i, &r, &i}, {&i, &r, &r}, {&r, &i, &i}, {&r, &i, &r}, {&r, &r, &i}})
    overloads.push_back(range_test(*x, *low, *high));
  return overloads;
}

struct Comparison {
  const char* name;
  const char* host_name;
  const char* doc;
  Test holds;
  std::array<const char*, 2> yes;
  std::array<const char*, 2> no;
};

constexpr std::array kComparisons = {
    Comparison{"=",
               "equals",
               "True if both values are equal.",
               [](std::strong_ordering o) { return o == 0; },
               {"1", "1.0"},
               {"1", "2"}},
    Comparison{"#",
               "not_equals",
               "True if the values differ.",
               [](std::strong_ordering o) { return o != 0; },
               {R"("a")", R"("b")"},
               {"1", "1"}},
    Comparison{"<",
               "less_than",
               "True if the first value comes before the second in the order of their type.",
               [](std::strong_ordering o) { return o < 0; },
               {"1", "1.5"},
               {"2", "1"}},
    Comparison{"<=",
               "less_or_equal",
               "True if the first value does not come after the second.",
               [](std::strong_ordering o) { return o <= 0; },
               {"1", "1"},
               {R"("b")", R"("a")"}},
    Comparison{">",
               "greater_than",
               "True if the first value comes after the second.",
               [](std::strong_ordering o) { return o > 0; },
               {"TRUE", "FALSE"},
               {"1", "1"}},
    Comparison{">=",
               "greater_or_equal",
               "True if the first value does not come before the second.",
               [](std::strong_ordering o) { return o >= 0; },
               {"2", "1"},
               {"0.5", "1"}},
};

}  // namespace

void register_comparison(Registry& registry) {
  for (const Comparison& row : kComparisons)
    registry.add({
        .name = row.name,
        .host_name = row.host_name,
        .syntax = std::string("_ ") + row.name + " _",
        .doc = row.doc,
        .detail =
            "Both values have one type, or are an int and a real, whose values are compared, or a string and a text. "
            "Points, surfaces and solids are equal if they are the same point set, whatever the triangles.",
        .exactness = Exactness::exact,
        .overloads = comparisons(registry, row.holds),
        .overload_for = [holds = row.holds](const Type& type) { return comparison(type, type, holds); },
        .examples = {{{row.yes[0], row.yes[1]}, "TRUE"},
                     {{row.no[0], row.no[1]}, "FALSE"},
                     {{"1", "(int undefined)"}, "undefined"}},
        .errors = {{{"1", R"("a")"}, std::string(row.name) + ": expected (int int)"}},
    });
  registry.add({
      .name = "between",
      .host_name = "is_between",
      .syntax = "_ between[_, _]",
      .doc = "True if the value lies between the bounds, both included, in the order of its type.",
      .exactness = Exactness::exact,
      .overloads = range_tests(registry),
      .overload_for = [](const Type& type) { return range_test(type, type, type); },
      .examples = {{{"2", "1", "3"}, "TRUE"},
                   {{"0.5", "1", "3"}, "FALSE"},
                   {{"2", "1", "(int undefined)"}, "undefined"}},
      .errors = {{{"2", "1", R"("a")"}, "between: expected (int int int)"}},
  });
  registry.add({
      .name = "isdefined",
      .host_name = "is_defined",
      .syntax = "isdefined(_)",
      .doc = "True if the value is not undefined.",
      .exactness = Exactness::exact,
      .overloads = for_all_types(registry, definedness),
      .overload_for = definedness,
      .examples = {{{"1"}, "TRUE"}, {{"(point3d undefined)"}, "FALSE"}},
      .errors = {{{"1", "2"}, "isdefined: expected (int)"}},
  });
  registry.add({
      .name = "ifthenelse",
      .host_name = "if_then_else",
      .syntax = "ifthenelse(_, _, _)",
      .doc = "The second argument if the condition is TRUE, the third if it is FALSE.",
      .detail = "Undefined if the condition is. Both branches are evaluated.",
      .overloads = for_all_types(registry, choice),
      .overload_for = choice,
      .examples = {{{"(< 1 2)", R"("yes")", R"("no")"}, R"("yes")"},
                   {{"TRUE", "1", "(int undefined)"}, "1"},
                   {{"(bool undefined)", "1", "2"}, "undefined"}},
      .errors = {{{"TRUE", "1", R"("a")"}, "ifthenelse: expected (bool int int)"}},
  });
}

}  // namespace algebra3d
