// intstream, realstream: numbers from one to another.
#include <cmath>
#include <limits>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr std::int64_t kStepsBetweenChecks = 1024;

Elements<std::int64_t> ints_between(const std::int64_t& first, const std::int64_t& last) {
  using Next = Result<std::optional<std::tuple<std::int64_t>>>;
  return Elements<std::int64_t>([next = first, end = last](Context& context) mutable -> Next {
    if (next > end) return Next(std::nullopt);
    if (next % kStepsBetweenChecks == 0) A3D_TRY(context.check_cancelled());
    const std::int64_t value = next;
    // After the largest int comes nothing: an empty range.
    if (next < end)
      ++next;
    else
      end = std::numeric_limits<std::int64_t>::min();
    return Next(std::tuple(value));
  });
}

// Every element is computed anew, so that rounding does not add up.
Elements<double> reals_between(Context& context, const double& first, const double& last, const double& step) {
  if (step == 0) context.diagnostics.report("realstream: the step is 0, so there is no element");
  using Next = Result<std::optional<std::tuple<double>>>;
  return Elements<double>([=, count = std::int64_t{0}](Context& running) mutable -> Next {
    // Rounded once; the product alone may be beyond the range of doubles.
    const double next = std::fma(static_cast<double>(count), step, first);
    const bool is_over = step > 0 ? next > last : step < 0 ? next < last : true;
    if (is_over || !std::isfinite(next)) return Next(std::nullopt);
    if (++count % kStepsBetweenChecks == 0) A3D_TRY(running.check_cancelled());
    return Next(std::tuple(next));
  });
}

}  // namespace

void register_sequences(OperatorGroup& group) {
  group.add({
      .name = "intstream",
      .host_name = "int_sequence",
      .syntax = "intstream(_, _)",
      .doc = "The ints from the first to the last, both included; none if the first is larger or if an argument is "
             "undefined.",
      .exactness = Exactness::exact,
      .overloads = {overload<&ints_between>("first", "last")},
      .examples = {{{"1", "5"}, "5", "(count _)"},
                   {{"2", "1"}, "0", "(count _)"},
                   {{"(int undefined)", "1"}, "0", "(count _)"}},
      .errors = {{{"1", "2.5"}, "intstream: expected (int int), got (int real)"}},
  });
  group.add({
      .name = "realstream",
      .host_name = "real_sequence",
      .syntax = "realstream(_, _, _)",
      .doc = "The reals from the first to the second number, in steps of the third; downwards if that is negative.",
      .detail =
          "Element i is the first number plus i times the step, so rounding errors do not accumulate. No elements "
          "for a step of 0 or an undefined argument.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&reals_between>("first", "last", "step")},
      .examples = {{{"0.0", "1.0", "0.25"}, "(0.0 0.25 0.5 0.75 1.0)"},
                   {{"0.0", "1.000001", "0.1"}, "11", "(count _)"},
                   {{"1", "-1", "-0.5"}, "5", "(count _)"},
                   {{"1.0", "2.0", "0.0"}, "0", "(count _)"},
                   {{"1.0", "(real undefined)", "1.0"}, "0", "(count _)"}},
      .errors = {{{"1.0", "2.0", "TRUE"}, "realstream: expected (real real real), got (real real bool)"},
                 {{"1.0", "2.0"}, "realstream: expected (real real real), got (real real)"}},
  });
}

}  // namespace algebra3d
