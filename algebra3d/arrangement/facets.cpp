#include "algebra3d/arrangement/facets.h"

#include <algorithm>
#include <utility>

#include "algebra3d/base/parallel.h"

namespace algebra3d::arrangement {

bool Facets::is_coplanar_across(std::uint32_t halfedge, std::uint32_t other) const {
  const IntegerPlane *plane = planes_of_faces_.find(halfedge / 3), *beyond = planes_of_faces_.find(other / 3);
  if (plane != nullptr && beyond != nullptr) return *plane == *beyond;
  return are_coplanar_at(halfedge, other);
}

/// True if two faces with a common edge lie in one plane, whichever way each looks.
bool Facets::are_coplanar_at(std::uint32_t halfedge, std::uint32_t other) const {
  const IntegerPlane *plane = planes_of_faces_.find(halfedge / 3), *beyond = planes_of_faces_.find(other / 3);
  if (beyond != nullptr) return beyond->side(operands_.point_of(Operands::previous(halfedge))) == 0;
  const PointRef apex = operands_.point_of(Operands::previous(other));
  if (plane != nullptr) return plane->side(apex) == 0;
  const TriangleRef triangle = operands_.corners(halfedge / 3);
  return orient3d(triangle[0], triangle[1], triangle[2], apex) == 0;
}

std::uint32_t Facets::add(std::uint32_t face) {
  if (of_face_[face] != kNone) return of_face_[face];
  const auto facet = static_cast<std::uint32_t>(facets_.size());
  const auto first = static_cast<std::uint32_t>(faces_.size());
  of_face_[face] = facet;
  faces_.push_back(face);
  for (std::size_t next = first; next < faces_.size(); ++next)
    for (std::uint32_t h = 3 * faces_[next]; h < 3 * faces_[next] + 3; ++h) {
      const std::uint32_t other = operands_.opposite(h);
      if (other == kNone || of_face_[other / 3] != kNone || !is_coplanar_across(h, other)) continue;
      of_face_[other / 3] = facet;
      faces_.push_back(other / 3);
    }
  facets_.push_back({operands_.operand_of_face(face), kNone, 0, first, static_cast<std::uint32_t>(faces_.size())});
  planes_of_facets_.add();
  return facet;
}

/// A face that is in no facet stays as it is, so nothing can become one with it.
void Facets::join_planes_across_nonmanifold_edges() {
  for (std::uint32_t operand = 0; operand < operands_.count(); ++operand) {
    const TriangleMesh& mesh = operands_.mesh(operand);
    const std::uint32_t first = 3 * operands_.first_face(operand);
    for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
      const std::span<const HalfedgeId> along = mesh.nonmanifold_edge(n);
      for (std::size_t i = 0; i < along.size(); ++i)
        for (std::size_t j = i + 1; j < along.size(); ++j) {
          const std::uint32_t one = first + along[i].index(), other = first + along[j].index();
          const std::uint32_t facet = of_face_[one / 3], beyond = of_face_[other / 3];
          if (facet != kNone && beyond != kNone && are_coplanar_at(one, other)) planes_of_facets_.unite(facet, beyond);
        }
    }
  }
}

void Facets::number_planes() {
  join_planes_across_nonmanifold_edges();
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    TriangleRef triangle = operands_.corners(faces_[facets_[f].first]);
    const std::uint32_t first_of_plane = planes_of_facets_.find(f);
    if (first_of_plane == f) {
      facets_[f].plane = static_cast<std::uint32_t>(planes_.size());
      const auto [projection, turn] = dominant_turn(triangle);
      facets_[f].orientation = turn;
      if (facets_[f].orientation < 0) std::swap(triangle[1], triangle[2]);
      planes_.push_back({triangle, projection, {}});
      if (const IntegerPlane* known = planes_of_faces_.find(faces_[facets_[f].first]); known != nullptr)
        planes_.back().exact = facets_[f].orientation > 0 ? *known : known->flipped();
    } else {
      facets_[f].plane = facets_[first_of_plane].plane;
      const Projection projection = planes_[facets_[f].plane].projection;
      facets_[f].orientation = orient2d(projection, triangle[0], triangle[1], triangle[2]);
    }
  }
}

void Facets::make_exact_planes(std::vector<std::uint32_t> planes) {
  std::ranges::sort(planes);
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  in_halves(planes.size(), kPointsWorthAThread, [&](std::size_t i) { exact_plane(planes[i]); });
}

bool Facets::has_boundary_origin(std::uint32_t halfedge) {
  std::uint8_t& known = has_boundary_origin_[halfedge];
  if (known == kUnknown) known = finds_boundary_at_origin(halfedge) ? kYes : kNo;
  return known == kYes;
}

bool Facets::finds_boundary_at_origin(std::uint32_t halfedge) const {
  std::vector<std::uint32_t> outgoing;
  operands_.halfedges_around_origin(halfedge, outgoing);
  return std::ranges::any_of(outgoing, [&](std::uint32_t h) {
    return of_face_[h / 3] != of_face_[halfedge / 3] || is_boundary(h) || is_boundary(Operands::previous(h));
  });
}

}  // namespace algebra3d::arrangement
