// = # < <= > >= between, isdefined, ifthenelse: the same for every type, by the type's own order.
#include <array>
#include <tuple>
#include <type_traits>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Test = bool (*)(std::strong_ordering);

// The order of what stands in columns: that of the types.
template <typename T>
std::strong_ordering order_in_column(const T& a, const T& b) {
  return a < b ? std::strong_ordering::less : b < a ? std::strong_ordering::greater : std::strong_ordering::equal;
}
std::strong_ordering order_in_column(std::int64_t a, double b) {
  return compare(a, b);
}
std::strong_ordering order_in_column(double a, std::int64_t b) {
  return 0 <=> compare(b, a);
}
inline std::strong_ordering order_in_column(const std::string& a, const std::string& b) {
  return a <=> b;
}

template <Test kHolds, typename A, typename B>
bool compare_in_columns(const A& a, const B& b) {
  return kHolds(order_in_column(a, b));
}

template <typename Low, typename T, typename High>
bool is_between_in_columns(const T& x, const Low& low, const High& high) {
  return order_in_column(low, x) <= 0 && order_in_column(x, high) <= 0;
}

/// Calls `visit` with an object of the class of a type that stands in columns; null for other types.
template <typename Visit>
Kernel visit_class(const Type& type, Visit visit) {
  if (&type == &TypeOf<std::int64_t>::type()) return visit(std::int64_t{});
  if (&type == &TypeOf<double>::type()) return visit(double{});
  if (&type == &TypeOf<bool>::type()) return visit(bool{});
  if (&type == &TypeOf<std::string>::type()) return visit(std::string());
  return nullptr;
}

template <typename... T>
constexpr bool kAreComparable = (std::is_same_v<std::tuple_element_t<0, std::tuple<T...>>, T> && ...) ||
                                ((std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>)&&...);

template <Test kHolds>
Kernel comparison_kernel(const Type& left, const Type& right) {
  return visit_class(left, [&]<typename A>(const A&) {
    return visit_class(right, []<typename B>(const B&) -> Kernel {
      if constexpr (kAreComparable<A, B>)
        return kernel_of<&compare_in_columns<kHolds, A, B>, bool, const A&, const B&>();
      else
        return nullptr;
    });
  });
}

Kernel range_kernel(const Type& type, const Type& lower, const Type& upper) {
  return visit_class(type, [&]<typename T>(const T&) {
    return visit_class(lower, [&]<typename Low>(const Low&) {
      return visit_class(upper, []<typename High>(const High&) -> Kernel {
        if constexpr (kAreComparable<T, Low, High>)
          return kernel_of<&is_between_in_columns<Low, T, High>, bool, const T&, const Low&, const High&>();
        else
          return nullptr;
      });
    });
  });
}

void test_definedness(const KernelCall& call) {
  auto* const results = call.result.data<bool>();
  call.rows.for_each([&](std::size_t row) { results[row] = call.arguments[0]->is_defined(row) ? 1 : 0; });
}

template <typename T>
void choose(const KernelCall& call) {
  const ValueColumn& condition = *call.arguments[0];
  const auto* const holds = condition.data<bool>();
  auto* const results = call.result.data<T>();
  call.rows.for_each([&](std::size_t row) {
    if (!condition.is_defined(row)) {
      call.report(Undefined{"the condition is undefined"});
      return call.result.set_undefined(row);
    }
    const ValueColumn& chosen = *call.arguments[holds[row] != 0 ? 1 : 2];
    if (!chosen.is_defined(row)) return call.result.set_undefined(row);
    results[row] = chosen.data<T>()[row];
  });
}

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

using KernelOfTypes = Kernel (*)(const Type& left, const Type& right);

Overload comparison(const Type& left, const Type& right, Test holds, KernelOfTypes kernel) {
  Overload overload;
  overload.kernel = kernel(left, right);
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
  overload.kernel = range_kernel(type, lower, upper);
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
  overload.kernel = &test_definedness;
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
  overload.kernel = visit_class(type, []<typename T>(const T&) -> Kernel { return &choose<T>; });
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
std::vector<Overload> comparisons(const Registry& registry, Test holds, KernelOfTypes kernel) {
  auto overloads = for_all_types(registry, [&](const Type& type) { return comparison(type, type, holds, kernel); });
  overloads.push_back(comparison(int_type(), real_type(), holds, kernel));
  overloads.push_back(comparison(real_type(), int_type(), holds, kernel));
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
  KernelOfTypes kernel;
  std::array<const char*, 2> yes;
  std::array<const char*, 2> no;
};

bool is_equal(std::strong_ordering order) {
  return order == 0;
}
bool is_different(std::strong_ordering order) {
  return order != 0;
}
bool is_less(std::strong_ordering order) {
  return order < 0;
}
bool is_not_greater(std::strong_ordering order) {
  return order <= 0;
}
bool is_greater(std::strong_ordering order) {
  return order > 0;
}
bool is_not_less(std::strong_ordering order) {
  return order >= 0;
}

constexpr std::array kComparisons = {
    Comparison{"=",
               "equals",
               "True if both values are equal.",
               &is_equal,
               &comparison_kernel<&is_equal>,
               {"1", "1.0"},
               {"1", "2"}},
    Comparison{"#",
               "not_equals",
               "True if the values differ.",
               &is_different,
               &comparison_kernel<&is_different>,
               {R"("a")", R"("b")"},
               {"1", "1"}},
    Comparison{"<",
               "less_than",
               "True if the first value comes before the second in the order of their type.",
               &is_less,
               &comparison_kernel<&is_less>,
               {"1", "1.5"},
               {"2", "1"}},
    Comparison{"<=",
               "less_or_equal",
               "True if the first value does not come after the second.",
               &is_not_greater,
               &comparison_kernel<&is_not_greater>,
               {"1", "1"},
               {R"("b")", R"("a")"}},
    Comparison{">",
               "greater_than",
               "True if the first value comes after the second.",
               &is_greater,
               &comparison_kernel<&is_greater>,
               {"TRUE", "FALSE"},
               {"1", "1"}},
    Comparison{">=",
               "greater_or_equal",
               "True if the first value does not come before the second.",
               &is_not_less,
               &comparison_kernel<&is_not_less>,
               {"2", "1"},
               {"0.5", "1"}},
};

}  // namespace

void register_comparison(OperatorGroup& group) {
  for (const Comparison& row : kComparisons)
    group.add({
        .name = row.name,
        .host_name = row.host_name,
        .syntax = std::string("_ ") + row.name + " _",
        .doc = row.doc,
        .detail =
            "Both values have one type, or are an int and a real, whose values are compared, or a string and a text. "
            "Points, surfaces and solids are equal if they are the same point set, whatever the triangles.",
        .exactness = Exactness::exact,
        .overloads = comparisons(group.registry(), row.holds, row.kernel),
        .overload_for = [holds = row.holds,
                         kernel = row.kernel](const Type& type) { return comparison(type, type, holds, kernel); },
        .examples = {{{row.yes[0], row.yes[1]}, "TRUE"},
                     {{row.no[0], row.no[1]}, "FALSE"},
                     {{"1", "(int undefined)"}, "undefined"}},
        .errors = {{{"1", R"("a")"}, std::string(row.name) + ": expected (int int)"}},
    });
  group.add({
      .name = "between",
      .host_name = "is_between",
      .syntax = "_ between[_, _]",
      .doc = "True if the value lies between the bounds, both included, in the order of its type.",
      .exactness = Exactness::exact,
      .overloads = range_tests(group.registry()),
      .overload_for = [](const Type& type) { return range_test(type, type, type); },
      .examples = {{{"2", "1", "3"}, "TRUE"},
                   {{"0.5", "1", "3"}, "FALSE"},
                   {{"2", "1", "(int undefined)"}, "undefined"}},
      .errors = {{{"2", "1", R"("a")"}, "between: expected (int int int)"}},
  });
  group.add({
      .name = "isdefined",
      .host_name = "is_defined",
      .syntax = "isdefined(_)",
      .doc = "True if the value is not undefined.",
      .exactness = Exactness::exact,
      .overloads = for_all_types(group.registry(), definedness),
      .overload_for = definedness,
      .examples = {{{"1"}, "TRUE"}, {{"(point3d undefined)"}, "FALSE"}},
      .errors = {{{"1", "2"}, "isdefined: expected (int)"}},
  });
  group.add({
      .name = "ifthenelse",
      .host_name = "if_then_else",
      .syntax = "ifthenelse(_, _, _)",
      .doc = "The second argument if the condition is TRUE, the third if it is FALSE.",
      .detail = "Undefined if the condition is. Both branches are evaluated.",
      .overloads = for_all_types(group.registry(), choice),
      .overload_for = choice,
      .examples = {{{"(< 1 2)", R"("yes")", R"("no")"}, R"("yes")"},
                   {{"TRUE", "1", "(int undefined)"}, "1"},
                   {{"(bool undefined)", "1", "2"}, "undefined"}},
      .errors = {{{"TRUE", "1", R"("a")"}, "ifthenelse: expected (bool int int)"}},
  });
}

}  // namespace algebra3d
