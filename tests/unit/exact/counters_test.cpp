#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

Vec3 random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

TEST(counters, the_filter_decides_random_doubles_but_for_one_in_a_hundred) {
  std::mt19937_64 random(1);
  reset_exact_counters();
  for (int i = 0; i < 50000; ++i) {
    orient3d(random_point(random), random_point(random), random_point(random), random_point(random));
    orient2d(Projection::xy, random_point(random), random_point(random), random_point(random));
  }
  const ExactCounters counters = exact_counters();
  EXPECT_EQ(counters.calls, 100000U);
  EXPECT_LT(counters.filter_failures, 1000U);
  EXPECT_EQ(counters.big_fallbacks, 0U);
  EXPECT_EQ(counters.heap_rationals, 0U);
}

TEST(counters, a_coplanar_quadruple_of_doubles_is_a_filter_failure_without_big_numbers) {
  reset_exact_counters();
  EXPECT_EQ(orient3d(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{2, -2, 1}), 0);
  EXPECT_EQ(orient2d(Projection::xy, Vec3{0, 0, 0}, Vec3{1, 2, 0}, Vec3{2, 4, 1}), 0);
  const ExactCounters counters = exact_counters();
  EXPECT_EQ(counters.calls, 2U);
  EXPECT_EQ(counters.filter_failures, 2U);
  EXPECT_EQ(counters.big_fallbacks, 0U);
}

TEST(counters, faces_parallel_to_the_axes_do_not_fail_the_filter) {
  reset_exact_counters();
  EXPECT_EQ(orient3d(Vec3{0, 0, 7}, Vec3{1, 3, 7}, Vec3{-2, 1, 7}, Vec3{5, 5, 7}), 0);
  EXPECT_EQ(orient2d(Projection::xy, Vec3{2, 0, 0}, Vec3{2, 1, 5}, Vec3{2, 4, 1}), 0);
  EXPECT_EQ(exact_counters().filter_failures, 0U);
}

TEST(counters, coordinates_beyond_the_safe_range_and_rationals_are_counted_as_big) {
  reset_exact_counters();
  EXPECT_EQ(orient3d(Vec3{1e-320, 0, 0}, Vec3{0, 1e-320, 0}, Vec3{0, 0, 1e-320}, Vec3{0, 0, 0}), -1);
  EXPECT_EQ(exact_counters().big_fallbacks, 1U);
  const Rational third(1, 3);
  const ExactPoint on_plane(RationalVec3(third, third, third));
  EXPECT_EQ(orient3d(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, on_plane), 0);
  EXPECT_EQ(exact_counters().big_fallbacks, 2U);
  EXPECT_EQ(orient3d(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1.01}, on_plane), -1);
  EXPECT_EQ(exact_counters().big_fallbacks, 2U) << "intervals decide what is not near the plane";
}

TEST(counters, pairs_of_doubles_decide_what_lies_some_roundings_off_a_plane) {
  // Thirds of corners of the plane x + y + z = 3, and a point that is 2^-80 off it: beyond what roundings tell.
  const auto thirds = [](int x, int y, int z, const Rational& off) {
    return ExactPoint(RationalVec3(Rational(x, 3), Rational(y, 3), Rational(z, 3) + off));
  };
  const ExactPoint a = thirds(7, 1, 1, 0), b = thirds(1, 7, 1, 0), c = thirds(1, 1, 7, 0);
  const Rational off(0x1p-80);
  reset_exact_counters();
  EXPECT_EQ(orient3d(a, b, c, thirds(4, 4, 1, off)), 1);
  EXPECT_EQ(orient3d(a, b, c, thirds(4, 4, 1, -off)), -1);
  EXPECT_EQ(orient2d(Projection::zx, a, c, thirds(4, 2, 4, off)), 1);
  EXPECT_EQ(orient2d(Projection::zx, a, c, thirds(4, 2, 4, -off)), -1);
  EXPECT_EQ(exact_counters().big_fallbacks, 0U);
  EXPECT_EQ(orient3d(a, b, c, thirds(4, 4, 1, 0)), 0) << "a plane that no axis is parallel to needs integers";
  EXPECT_EQ(exact_counters().big_fallbacks, 1U);
}

TEST(counters, a_rational_point_on_an_axis_parallel_plane_needs_no_rationals) {
  const Rational third(1, 3);
  const ExactPoint on_plane(RationalVec3(third, third, 5));
  reset_exact_counters();
  EXPECT_EQ(orient3d(Vec3{1, 0, 5}, Vec3{0, 1, 5}, Vec3{3, 3, 5}, on_plane), 0);
  EXPECT_EQ(exact_counters().filter_failures, 0U);
}

TEST(counters, counts_of_ended_threads_are_kept) {
  reset_exact_counters();
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([] {
      for (int i = 0; i < 1000; ++i) orient2d(Projection::xy, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0});
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(exact_counters().calls, 4000U);
}

}  // namespace
}  // namespace algebra3d
