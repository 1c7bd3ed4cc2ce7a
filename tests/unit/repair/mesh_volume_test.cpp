#include "algebra3d/kernel/repair/mesh_volume.h"

#include <atomic>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

TEST(NearestVolume, is_rounded_once) {
  // The volume is (1/3)^3 as rounded, far from where doubles are dense.
  const double a = 1.0 / 3;
  const TriangleMesh mesh = solids::box({1e8, 1e8, 1e8}, {1e8 + 1, 1e8 + 2, 1e8 + a});
  const double height = (1e8 + a) - 1e8;
  EXPECT_EQ(*nearest_volume(mesh), (Rational(2) * Rational(height)).nearest_double());
}

TEST(NearestVolume, of_the_empty_mesh_is_0) {
  EXPECT_EQ(*nearest_volume({}), 0.0);
  EXPECT_TRUE(measured_volume({})->is_zero());
}

TEST(NearestVolume, of_a_cube_with_a_cavity_is_what_is_between) {
  const TriangleMesh mesh = mesh_of(joined(cube_soup(0, 4), turned(cube_soup(1, 3))));
  EXPECT_EQ(*nearest_volume(mesh), 56.0);
  EXPECT_EQ(measured_volume(mesh)->in_doubles(), 56.0);
}

TEST(NearestVolume, ends_when_asked_to) {
  const std::atomic<bool> cancel = true;
  const auto volume = nearest_volume(samples::torus(100, 100), &cancel);
  ASSERT_FALSE(volume.ok());
  EXPECT_EQ(volume.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
