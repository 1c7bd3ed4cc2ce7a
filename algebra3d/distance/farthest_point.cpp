#include "algebra3d/distance/farthest_point.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/distance/detail/piece_search.h"

namespace algebra3d {
namespace {

using distances::PieceSearch;

Result<std::vector<PieceSearch>> with_measured_vertices(std::span<const FarthestSearch> searches,
                                                        const Monitor& monitor) {
  std::vector<PieceSearch> measured;
  for (const FarthestSearch& search : searches) {
    const Box3 box = unite(search.from.hierarchy->bounds(), search.to.hierarchy->bounds());
    measured.emplace_back(search, box);
    ALGEBRA3D_RETURN_IF_ERROR(measured.back().measure_vertices(monitor));
  }
  return measured;
}

}  // namespace

Result<std::optional<FarthestPoint>> farthest_point(std::span<const FarthestSearch> searches, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(std::vector<PieceSearch> all, with_measured_vertices(searches, monitor));
  double at_least = 0;
  for (const PieceSearch& search : all) at_least = std::max(at_least, search.lower_bound());
  for (PieceSearch& search : all) ALGEBRA3D_RETURN_IF_ERROR(search.bound_faces(at_least, monitor));
  for (const PieceSearch& search : all) at_least = std::max(at_least, search.lower_bound());
  std::optional<FarthestPoint> farthest;
  double upper_bound = 0;
  bool is_bounded = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    PieceSearch& search = all[i];
    ALGEBRA3D_RETURN_IF_ERROR(search.refine(at_least, monitor));
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

}  // namespace algebra3d
