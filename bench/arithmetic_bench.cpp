// The arithmetic of algebra3d/kernel/exact beside GMP's C++ interface and Boost: the same numbers, the same formulas,
// the same run. Figures and what follows from them: docs/decisions/0013.

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <gmpxx.h>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/numeric/interval.hpp>

#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/interval.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using boost::multiprecision::int256_t;
using boost::multiprecision::int512_t;

constexpr std::size_t kCount = 1024;

/// Integers of at most `bits` bits.
std::vector<std::int64_t> integers(int bits) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> integer(-(std::int64_t{1} << bits), std::int64_t{1} << bits);
  std::vector<std::int64_t> numbers(9 * kCount);
  for (std::int64_t& number : numbers) number = integer(random);
  return numbers;
}

void report(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}

// Fractions a/b * c/d + e/f, as of coordinates that people write.

template <typename Fraction>
void fractions(benchmark::State& state) {
  const auto numbers = integers(static_cast<int>(state.range(0)));
  std::vector<Fraction> values;
  for (std::size_t i = 0; i < 3 * kCount; ++i)
    values.emplace_back(Fraction(numbers[i]) / Fraction((numbers[i + 1] & 0xFF) + 1));
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const Fraction value = values[3 * i] * values[3 * i + 1] + values[3 * i + 2];
      sum += value > values[i] ? 1 : -1;
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

// Determinants of three rows: integers of 60 bits summed up, as for a volume.

template <typename Integer>
Integer determinant(const Integer* m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

template <typename Integer>
void volume(benchmark::State& state) {
  std::vector<Integer> numbers;
  for (const std::int64_t number : integers(59)) numbers.emplace_back(static_cast<long>(number));
  for (auto _ : state) {
    Integer sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) sum += determinant(&numbers[9 * i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

void volume_wide(benchmark::State& state) {
  std::vector<detail::WideInteger<1>> numbers;
  for (const std::int64_t number : integers(59)) numbers.push_back({{magnitude(number)}, number < 0});
  for (auto _ : state) {
    detail::WideSum<4> sum;
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto* m = &numbers[9 * i];
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        sum.add(m[a] * detail::WideSum<2>().add(m[3 + b] * m[6 + c]).subtract(m[3 + c] * m[6 + b]).total());
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

// The sign of a determinant of doubles with 53 bits each and exponents that differ by up to 20.

std::vector<double> doubles() {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> exponent(-20, 0);
  std::vector<double> numbers;
  for (const std::int64_t number : integers(52))
    numbers.push_back(std::ldexp(static_cast<double>(number), exponent(random)));
  return numbers;
}

void sign_by_expansions(benchmark::State& state) {
  const auto numbers = doubles();
  const auto two = [](double value) { return detail::difference(value, 0); };
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const double* m = &numbers[9 * i];
      const auto minor = [&](std::size_t b, std::size_t c) {
        return two(m[3 + b]) * two(m[6 + c]) - two(m[3 + c]) * two(m[6 + b]);
      };
      sum += (minor(1, 2) * two(m[0]) + minor(2, 0) * two(m[1]) + minor(0, 1) * two(m[2])).sign();
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

/// Doubles as integers over one power of two, made anew each time as a predicate has to.
template <typename Integer>
void sign_by_integers(benchmark::State& state) {
  const auto numbers = doubles();
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      std::array<Integer, 9> m;
      for (std::size_t k = 0; k < 9; ++k) {
        const detail::IntegerDouble integer(numbers[9 * i + k]);
        m[k] = static_cast<long>(integer.mantissa);
        m[k] <<= static_cast<unsigned>(integer.exponent + 80);
      }
      const Integer value = determinant(m.data());
      sum += value > 0 ? 1 : value < 0 ? -1 : 0;
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

// The plane through three points with homogeneous coordinates of some 100 bits.

template <typename Integer>
std::vector<Integer> long_integers() {
  std::vector<Integer> result;
  const auto numbers = integers(60);
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    Integer number = static_cast<long>(numbers[i]);
    number <<= 40;
    number += static_cast<long>(numbers[i + 1] >> 20);
    result.push_back(number);
  }
  return result;
}

void plane_by_join(benchmark::State& state) {
  const auto numbers = long_integers<mpz_class>();
  std::vector<detail::HomogeneousPoint> points(2 * kCount);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) mpz_set(points[i][k], numbers[4 * i + k].get_mpz_t());
  detail::HomogeneousPoint plane;
  for (auto _ : state) {
    for (std::size_t i = 0; i < kCount; ++i) detail::join(plane, points[i], points[i + 1], points[i + 2]);
    benchmark::DoNotOptimize(plane);
  }
  report(state);
}

template <typename Integer>
void plane_by_expressions(benchmark::State& state) {
  const auto numbers = long_integers<Integer>();
  std::array<Integer, 4> plane;
  for (auto _ : state) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const Integer *p = &numbers[4 * i], *q = p + 4, *r = p + 8;
      std::array<std::array<Integer, 4>, 4> minors;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) minors[a][b] = q[a] * r[b] - q[b] * r[a];
      plane[0] = p[1] * minors[2][3] - p[2] * minors[1][3] + p[3] * minors[1][2];
      plane[1] = p[2] * minors[0][3] - p[0] * minors[2][3] - p[3] * minors[0][2];
      plane[2] = p[0] * minors[1][3] - p[1] * minors[0][3] + p[3] * minors[0][1];
      plane[3] = p[1] * minors[0][2] - p[0] * minors[1][2] - p[2] * minors[0][1];
    }
    benchmark::DoNotOptimize(plane);
  }
  report(state);
}

// The sign of a determinant by intervals, none of which has width 0.

template <typename Number, typename Make>
void sign_by_intervals(benchmark::State& state, const Make& make) {
  std::vector<Number> numbers;
  for (const double number : doubles()) numbers.push_back(make(number));
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const Number* m = &numbers[9 * i];
      const Number value =
          m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
      if constexpr (std::is_same_v<Number, detail::Interval>)
        sum += value.sign();
      else
        sum += value.lower() > 0 ? 1 : value.upper() < 0 ? -1 : detail::kUndecided;
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

void sign_by_own_intervals(benchmark::State& state) {
  sign_by_intervals<detail::Interval>(state, [](double value) { return detail::widened(value, 0); });
}
void sign_by_boost_intervals(benchmark::State& state) {
  using Interval = boost::numeric::interval<double>;
  sign_by_intervals<Interval>(
      state, [](double value) { return Interval(std::nextafter(value, -HUGE_VAL), std::nextafter(value, HUGE_VAL)); });
}

BENCHMARK(fractions<Rational>)->Name("fractions/ours")->Arg(10)->Arg(40)->Arg(60);
BENCHMARK(fractions<mpq_class>)->Name("fractions/mpq_class")->Arg(10)->Arg(40)->Arg(60);
BENCHMARK(fractions<cpp_rational>)->Name("fractions/cpp_rational")->Arg(10)->Arg(40)->Arg(60);
BENCHMARK(volume_wide)->Name("volume/ours");
BENCHMARK(volume<mpz_class>)->Name("volume/mpz_class");
BENCHMARK(volume<int256_t>)->Name("volume/int256_t");
BENCHMARK(sign_by_expansions)->Name("sign/ours");
BENCHMARK(sign_by_integers<mpz_class>)->Name("sign/mpz_class");
BENCHMARK(sign_by_integers<int512_t>)->Name("sign/int512_t");
BENCHMARK(plane_by_join)->Name("plane/ours");
BENCHMARK(plane_by_expressions<mpz_class>)->Name("plane/mpz_class");
BENCHMARK(plane_by_expressions<cpp_int>)->Name("plane/cpp_int");
BENCHMARK(sign_by_own_intervals)->Name("intervals/ours");
BENCHMARK(sign_by_boost_intervals)->Name("intervals/boost");

}  // namespace
}  // namespace algebra3d
