#include "algebra3d/kernel/repair/detail/shell_volumes.h"

#include <cmath>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

std::vector<FaceId> all_faces(const TriangleMesh& mesh) {
  std::vector<FaceId> result;
  for (const FaceId face : faces(mesh)) result.push_back(face);
  return result;
}

TEST(ShellVolumes, the_exact_volume_is_within_the_error) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(samples::torus(40, 30));
    if (chance.one_in(2)) soup = turned(std::move(soup));
    if (chance.one_in(2)) soup = shifted(std::move(soup), {1e6 * chance.unit(), chance.unit(), 1e-6});
    soup = scaled(std::move(soup), std::ldexp(1.0, chance.between(-150, 150)));
    const TriangleMesh mesh = mesh_of(soup);
    const auto [value, error] = estimated_volume(mesh, all_faces(mesh));
    ASSERT_TRUE(std::isfinite(error));
    EXPECT_LE((solids::exact_volume_of(mesh) - Rational(value)).abs(), Rational(error));
  }
}

TEST(ShellVolumes, errors_are_small_where_shells_are_thick) {
  const TriangleMesh torus = mesh_of(soup_of(samples::torus(40, 30)));
  const auto [value, error] = estimated_volume(torus, all_faces(torus));
  EXPECT_LT(error, 1e-9 * value);
  EXPECT_GT(value, 0);
}

TEST(ShellVolumes, nothing_is_told_of_the_smallest_and_the_largest) {
  for (const double factor : {1e-70, 1e70}) {
    const TriangleMesh torus = mesh_of(scaled(soup_of(samples::torus(10, 8)), factor));
    EXPECT_TRUE(std::isinf(estimated_volume(torus, all_faces(torus)).error));
  }
}

}  // namespace
}  // namespace algebra3d::soups
