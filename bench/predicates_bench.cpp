// Orientation and triangle tests against CGAL's filtered kernel (Epick), on the same points in the same run.

#include <random>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <benchmark/benchmark.h>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

constexpr std::size_t kCount = 4096;

enum Input : std::int64_t { random_doubles, coplanar_integers, coplanar_floats };

std::vector<Vec3> make_points(std::int64_t input) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> real(-100, 100);
  std::uniform_int_distribution<int> integer(-100, 100);
  std::vector<Vec3> points(kCount);
  for (Vec3& p : points) {
    if (input == random_doubles) p = {real(random), real(random), real(random)};
    if (input == coplanar_integers) p = {double(integer(random)), double(integer(random)), 0};
    if (input == coplanar_floats) p = {double(float(real(random))), double(float(real(random))), 0};
    if (input != random_doubles) p.z = 2 * p.x - p.y;
  }
  return points;
}

void report(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount - 3));
}

void ours(benchmark::State& state) {
  const auto points = make_points(state.range(0));
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 3; i < kCount; ++i) sum += orient3d(points[i - 3], points[i - 2], points[i - 1], points[i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

void ours_by_reference(benchmark::State& state) {
  const auto doubles = make_points(state.range(0));
  const std::vector<PointRef> points(doubles.begin(), doubles.end());
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 3; i < kCount; ++i) sum += orient3d(points[i - 3], points[i - 2], points[i - 1], points[i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

template <typename Kernel>
std::vector<typename Kernel::Point_3> convert(const std::vector<Vec3>& points) {
  std::vector<typename Kernel::Point_3> result;
  for (const Vec3& p : points) result.emplace_back(p.x, p.y, p.z);
  return result;
}

void cgal_epick(benchmark::State& state) {
  const auto points = convert<Epick>(make_points(state.range(0)));
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 3; i < kCount; ++i)
      sum += CGAL::orientation(points[i - 3], points[i - 2], points[i - 1], points[i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

// Points a third of the integers: no doubles.
void ours_rational(benchmark::State& state) {
  std::vector<ExactPoint> points;
  const Rational third(1, 3);
  for (const Vec3& p : make_points(state.range(0)))
    points.emplace_back(RationalVec3(third * Rational(p.x), third * Rational(p.y), third * Rational(p.z)));
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 3; i < kCount; ++i) sum += orient3d(points[i - 3], points[i - 2], points[i - 1], points[i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

void cgal_epeck_rational(benchmark::State& state) {
  std::vector<Epeck::Point_3> points;
  for (const Vec3& p : make_points(state.range(0)))
    points.emplace_back(Epeck::FT(p.x) / 3, Epeck::FT(p.y) / 3, Epeck::FT(p.z) / 3);
  for (auto& p : points) CGAL::exact(p);
  for (auto _ : state) {
    int sum = 0;
    for (std::size_t i = 3; i < kCount; ++i)
      sum += CGAL::orientation(points[i - 3], points[i - 2], points[i - 1], points[i]);
    benchmark::DoNotOptimize(sum);
  }
  report(state);
}

// Pairs of small triangles near each other, as a validity proof meets them.
std::vector<Vec3> make_triangles() {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> real(0, 1);
  std::vector<Vec3> corners(3 * kCount);
  for (Vec3& p : corners) p = {real(random), real(random), real(random)};
  return corners;
}

void ours_triangles(benchmark::State& state) {
  const auto p = make_triangles();
  for (auto _ : state) {
    int meetings = 0;
    for (std::size_t i = 0; i + 5 < p.size(); i += 3)
      meetings += intersect_triangles({p[i], p[i + 1], p[i + 2]}, {p[i + 3], p[i + 4], p[i + 5]}) != Contact::none;
    benchmark::DoNotOptimize(meetings);
  }
  report(state);
}

void cgal_epick_triangles(benchmark::State& state) {
  const auto p = convert<Epick>(make_triangles());
  for (auto _ : state) {
    int meetings = 0;
    for (std::size_t i = 0; i + 5 < p.size(); i += 3)
      meetings += CGAL::do_intersect(Epick::Triangle_3(p[i], p[i + 1], p[i + 2]),
                                     Epick::Triangle_3(p[i + 3], p[i + 4], p[i + 5]));
    benchmark::DoNotOptimize(meetings);
  }
  report(state);
}

#define ALGEBRA3D_FOR_EACH_INPUT(function) \
  BENCHMARK(function)->ArgName("input")->Arg(random_doubles)->Arg(coplanar_integers)->Arg(coplanar_floats)
ALGEBRA3D_FOR_EACH_INPUT(ours);
ALGEBRA3D_FOR_EACH_INPUT(ours_by_reference);
ALGEBRA3D_FOR_EACH_INPUT(cgal_epick);
ALGEBRA3D_FOR_EACH_INPUT(ours_rational);
ALGEBRA3D_FOR_EACH_INPUT(cgal_epeck_rational);
BENCHMARK(ours_triangles);
BENCHMARK(cgal_epick_triangles);

}  // namespace
}  // namespace algebra3d
