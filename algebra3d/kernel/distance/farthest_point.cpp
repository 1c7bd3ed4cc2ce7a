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

std::vector<PieceSearch> begun(std::span<const FarthestSearch> searches) {
  std::vector<PieceSearch> all;
  all.reserve(searches.size());
  for (const FarthestSearch& search : searches)
    all.emplace_back(search, unite(search.from.hierarchy->bounds(), search.to.hierarchy->bounds()));
  return all;
}

double lower_bound_of(std::span<const PieceSearch> searches) {
  double lower = 0;
  for (const PieceSearch& search : searches) lower = std::max(lower, search.lower_bound());
  return lower;
}

/// Takes a step of each search; step(search, at_least) gets a lower bound of what all found before, so that the order
/// of the searches does not matter.
template <typename Step>
Status for_each(std::span<PieceSearch> searches, Step step) {
  const double at_least = lower_bound_of(searches);
  for (PieceSearch& search : searches) A3D_TRY(step(search, at_least));
  return {};
}

Status bound_faces(std::span<PieceSearch> searches, const Monitor& monitor) {
  A3D_TRY(
      for_each(searches, [&](PieceSearch& search, double at_least) { return search.begin_bounds(at_least, monitor); }));
  while (std::ranges::any_of(searches, &PieceSearch::has_round))
    A3D_TRY(for_each(searches,
                     [&](PieceSearch& search, double at_least) { return search.bound_round(at_least, monitor); }));
  return for_each(searches,
                  [&](PieceSearch& search, double at_least) { return search.bound_near_faces(at_least, monitor); });
}

Result<std::optional<FarthestPoint>> farthest_of_all(std::span<const FarthestSearch> searches, const Monitor& monitor) {
  std::vector<PieceSearch> all = begun(searches);
  A3D_TRY(for_each(all, [&](PieceSearch& search, double) { return search.measure_some(monitor); }));
  A3D_TRY(
      for_each(all, [&](PieceSearch& search, double at_least) { return search.measure_vertices(at_least, monitor); }));
  A3D_TRY(bound_faces(all, monitor));
  const double at_least = lower_bound_of(all);
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
