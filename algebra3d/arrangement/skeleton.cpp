#include "algebra3d/arrangement/skeleton.h"

#include <algorithm>
#include <utility>

#include "algebra3d/base/parallel.h"

namespace algebra3d::arrangement {

std::uint32_t Skeleton::corner(std::uint32_t halfedge) {
  const auto [entry, is_new] = corners_.try_emplace(operands_.vertex(halfedge), kNone);
  if (is_new) entry->second = vertices_.intern(operands_.point_of(halfedge));
  return entry->second;
}

ExactPoint Skeleton::meeting_point(const EdgeAndPlane& where) {
  return intersect_line_plane(operands_.point_of(where.edge), operands_.point_of(Operands::next(where.edge)),
                              facets_.exact_plane(where.plane));
}

void Skeleton::compute_crossings(std::span<const EdgeAndPlane> wanted) {
  std::vector<std::pair<EdgeAndPlane, Crossing*>> missing;
  for (const EdgeAndPlane& where : wanted)
    if (const auto [entry, is_new] = crossings_.try_emplace(key(where)); is_new)
      missing.emplace_back(where, &entry->second);
  in_halves(missing.size(), kPointsWorthAThread, [&](std::size_t i) {
    const auto& [where, crossing] = missing[i];
    crossing->point = meeting_point(where);
  });
}

std::uint32_t Skeleton::crossing_of_plane(const EdgeAndPlane& where) {
  Crossing& crossing = crossings_[key(where)];
  if (crossing.vertex == kNone) {
    crossing.vertex = vertices_.intern(crossing.point ? *std::move(crossing.point) : meeting_point(where));
    crossing.point.reset();
  }
  return crossing.vertex;
}

std::uint32_t Skeleton::crossing_of_planes(std::uint32_t p, std::uint32_t q, std::uint32_t r) {
  std::array<std::uint32_t, 3> planes{p, q, r};
  std::ranges::sort(planes);
  const auto [entry, is_new] = plane_crossings_.try_emplace(planes, kNone);
  if (is_new)
    entry->second =
        vertices_.intern(intersect_planes(facets_.exact_plane(p), facets_.exact_plane(q), facets_.exact_plane(r)));
  return entry->second;
}

std::uint32_t Skeleton::crossing_of_edges(std::uint32_t edge, std::uint32_t other, Projection projection) {
  // The plane through the other edge along the axis that the projection leaves out.
  const IntegerPlane plane = IntegerPlane::along_axis(
      operands_.point_of(other), operands_.point_of(Operands::next(other)), static_cast<std::size_t>(projection));
  return vertices_.intern(
      intersect_line_plane(operands_.point_of(edge), operands_.point_of(Operands::next(edge)), plane));
}

std::uint32_t Skeleton::segment_between(std::uint32_t from, std::uint32_t to) {
  const std::uint64_t ends = (std::uint64_t{std::min(from, to)} << 32U) | std::max(from, to);
  const auto [entry, is_new] = segments_between_.try_emplace(ends, static_cast<std::uint32_t>(segments_.size()));
  if (is_new) {
    segments_.push_back({from, to, kNone});
    first_incidences_.push_back(kNone);
  }
  return entry->second;
}

std::uint32_t Skeleton::edge_segment(std::uint32_t edge) {
  const auto [entry, is_new] = edge_segments_.try_emplace(edge, kNone);
  if (is_new) {
    entry->second = segment_between(corner(edge), corner(Operands::next(edge)));
    segments_[entry->second].edge = edge;
  }
  return entry->second;
}

std::uint32_t Skeleton::add_contact(std::uint32_t from, std::uint32_t to, std::uint32_t facet, std::uint32_t other) {
  const std::uint32_t segment = segment_between(from, to);
  if (first_incidences_[segment] == kNone) first_incidences_[segment] = static_cast<std::uint32_t>(incidences_.size());
  incidences_.push_back({segment, facet, Side::both});
  incidences_.push_back({segment, other, Side::both});
  return segment;
}

std::uint32_t Skeleton::other_plane(std::uint32_t segment, std::uint32_t plane) const {
  const std::uint32_t incidence = first_incidences_[segment];
  const std::uint32_t first = facets_[incidences_[incidence].facet].plane;
  return first != plane ? first : facets_[incidences_[incidence + 1].facet].plane;
}

void Skeleton::add_boundaries() {
  for (std::uint32_t f = 0; f < facets_.size(); ++f)
    for (const std::uint32_t face : facets_.faces(f))
      for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        if (!facets_.is_boundary(h)) continue;
        const std::uint32_t segment = edge_segment(operands_.edge(h));
        // The facet lies to the left of its half-edge, seen from its own front.
        const bool runs_along = corner(h) == segments_[segment].from;
        const bool is_left = runs_along == (facets_[f].orientation > 0);
        incidences_.push_back({segment, f, is_left ? Side::left : Side::right});
      }
}

}  // namespace algebra3d::arrangement
