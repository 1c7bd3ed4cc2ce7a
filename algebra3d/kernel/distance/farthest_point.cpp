#include "algebra3d/kernel/distance/farthest_point.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/detail/piece_search.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using distances::PieceSearch;

Result<std::vector<PieceSearch>> with_measured_vertices(std::span<const FarthestSearch> searches,
                                                        const Monitor& monitor) {
  std::vector<PieceSearch> measured;
  for (const FarthestSearch& search : searches) {
    const Box3 box = unite(search.from.hierarchy->bounds(), search.to.hierarchy->bounds());
    measured.emplace_back(search, box);
    A3D_TRY(measured.back().measure_vertices(monitor));
  }
  return measured;
}

Result<std::optional<FarthestPoint>> farthest_of_all(std::span<const FarthestSearch> searches, const Monitor& monitor) {
  A3D_ASSIGN(std::vector<PieceSearch> all, with_measured_vertices(searches, monitor));
  double at_least = 0;
  for (const PieceSearch& search : all) at_least = std::max(at_least, search.lower_bound());
  for (PieceSearch& search : all) A3D_TRY(search.bound_faces(at_least, monitor));
  for (const PieceSearch& search : all) at_least = std::max(at_least, search.lower_bound());
  std::optional<FarthestPoint> farthest;
  double upper_bound = 0;
  bool is_bounded = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    PieceSearch& search = all[i];
    A3D_TRY(search.refine(at_least, monitor));
    upper_bound = std::max(upper_bound, search.upper_bound());
    is_bounded = is_bounded && search.is_bounded();
    auto [squared_distance, nearest] = search.samples().exact_distance(search.best());
    if (farthest && squared_distance <= farthest->squared_distance) continue;
    const distances::SampledSet::Sample& sample = search.samples()[search.best()];
    farthest = {sample.point, nearest, std::move(squared_distance), i, 0, true};
  }
  if (farthest) {
    farthest->upper_bound = upper_bound;
    farthest->is_bounded = is_bounded;
  }
  return farthest;
}

/// Sets below this size are enlarged by this factor: near the least double a rounding is a large part of a number, so
/// bounds that are relative to the numbers do not hold.
constexpr double kTiny = 0x1p-900, kEnlargement = 0x1p1000;

bool are_tiny(std::span<const FarthestSearch> searches) {
  return std::ranges::all_of(searches, [](const FarthestSearch& search) {
    return std::max(largest_coordinate(*search.from.mesh), largest_coordinate(*search.to.mesh)) < kTiny;
  });
}

AffineMap scaling_by(double factor) {
  return AffineMap::scaling(RationalVec3(Vec3{}), RationalVec3(Vec3{factor, factor, factor}));
}

/// The image of a set, which is not tiny.
struct Enlarged {
  TriangleMesh mesh;
  BoxHierarchy hierarchy;

  DistanceOperand operand() const { return {&mesh, &hierarchy}; }
};

Result<Enlarged> enlarged(const TriangleMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(auto image, exact_image(scaling_by(kEnlargement), mesh, monitor.cancel()));
  BoxHierarchy hierarchy(*image);
  return Enlarged{std::move(image).value(), std::move(hierarchy)};
}

Result<std::optional<FarthestPoint>> farthest_of_enlarged(std::span<const FarthestSearch> searches,
                                                          const Monitor& monitor) {
  std::vector<std::unique_ptr<const Enlarged>> sets;
  std::vector<FarthestSearch> images;
  const auto image_of = [&](const DistanceOperand& set) -> Result<DistanceOperand> {
    A3D_ASSIGN(Enlarged image, enlarged(*set.mesh, monitor));
    return sets.emplace_back(std::make_unique<const Enlarged>(std::move(image)))->operand();
  };
  for (const FarthestSearch& search : searches) {
    A3D_ASSIGN(const DistanceOperand from, image_of(search.from));
    A3D_ASSIGN(const DistanceOperand to, image_of(search.to));
    images.push_back({from, to});
  }
  A3D_ASSIGN(std::optional<FarthestPoint> farthest, farthest_of_all(images, monitor));
  if (!farthest) return farthest;
  const Rational factor = Rational(1) / Rational(kEnlargement);
  farthest->point = ExactPoint(factor * farthest->point.rational());
  farthest->squared_distance *= factor * factor;
  farthest->upper_bound = (Rational(farthest->upper_bound) * factor).upper_double();
  return farthest;
}

}  // namespace

Result<std::optional<FarthestPoint>> farthest_point(std::span<const FarthestSearch> searches, const Monitor& monitor) {
  return are_tiny(searches) ? farthest_of_enlarged(searches, monitor) : farthest_of_all(searches, monitor);
}

}  // namespace algebra3d
