#include "algebra3d/repair/tolerant_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/arrangement/faces_above.h"
#include "algebra3d/arrangement/room_above.h"
#include "algebra3d/arrangement/surface_arrangement.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/winding_number.h"

namespace algebra3d {
namespace {

/// The rooms into which a surface parts space. Each face has a room in front of it, number 2f, and one behind it,
/// 2f + 1; the open air has the last number.
class Rooms {
 public:
  explicit Rooms(const TriangleMesh& surface) : surface_(surface), sets_(2 * surface.face_count() + 1) {}

  Status find(const Monitor& monitor);

  std::uint32_t in_front(std::uint32_t face) { return sets_.find(2 * face); }
  std::uint32_t behind(std::uint32_t face) { return sets_.find(2 * face + 1); }
  std::uint32_t open_air() { return sets_.find(static_cast<std::uint32_t>(2 * surface_.face_count())); }

 private:
  Status join_at_edges(const Monitor& monitor);
  void join_around(std::span<const HalfedgeId> edge);
  Status join_to_what_is_above(const Monitor& monitor);

  const TriangleMesh& surface_;
  arrangement::DisjointSets sets_;
};

/// Rooms go on across every edge, from each face round it to the next.
Status Rooms::join_at_edges(const Monitor& monitor) {
  for (std::uint32_t h = 0; h < surface_.halfedge_count(); ++h) {
    const std::uint32_t face = h / 3;
    if (surface_.is_boundary(HalfedgeId(h))) sets_.unite(2 * face, 2 * face + 1);
    if (const HalfedgeId other = surface_.opposite(HalfedgeId(h)); other.is_valid()) {
      sets_.unite(2 * face, 2 * (other.index() / 3));
      sets_.unite(2 * face + 1, 2 * (other.index() / 3) + 1);
    }
  }
  Stage stage(monitor.silent(), {}, surface_.nonmanifold_edge_count());
  for (std::size_t n = 0; n < surface_.nonmanifold_edge_count(); ++n) {
    if (!stage.begin_step()) return Monitor::interrupted();
    join_around(surface_.nonmanifold_edge(n));
  }
  return {};
}

void Rooms::join_around(std::span<const HalfedgeId> edge) {
  const VertexId from = surface_.origin(edge[0]), to = surface_.target(edge[0]);
  std::vector<HalfedgeId> around(edge.begin(), edge.end());
  const auto apex = [&](HalfedgeId h) { return surface_.point(surface_.origin(TriangleMesh::prev(h))); };
  std::ranges::sort(around, [&](HalfedgeId a, HalfedgeId b) {
    return std::is_lt(compare_around_edge(surface_.point(from), surface_.point(to), apex(edge[0]), apex(a), apex(b)));
  });
  for (std::size_t i = 0; i < around.size(); ++i) {
    const HalfedgeId h = around[i], next = around[i + 1 == around.size() ? 0 : i + 1];
    // Turning counter-clockwise, a face that runs forward along the edge is left to its front.
    const bool leaves_to_front = surface_.origin(h) == from, arrives_from_front = surface_.origin(next) != from;
    sets_.unite(2 * (h.index() / 3) + (leaves_to_front ? 0 : 1), 2 * (next.index() / 3) + (arrives_from_front ? 0 : 1));
  }
}

/// From the highest face of each part of the surface the way leads up to another part, or to the open air.
Status Rooms::join_to_what_is_above(const Monitor& monitor) {
  const std::array<Operand, 1> list{{{&surface_, 0}}};
  const arrangement::Operands operands(list);
  arrangement::FaceTree tree(operands);
  arrangement::FacesAbove faces_above(operands, tree);
  const FaceComponents parts = connected_components(surface_);
  struct Highest {
    double height = 0;
    std::uint32_t face = arrangement::kNone;
  };
  std::vector<Highest> highest(parts.count);
  for (std::uint32_t f = 0; f < surface_.face_count(); ++f) {
    double height = 0;
    for (const PointRef& corner : surface_.corners(FaceId(f))) height += corner.approx.z / 3;
    Highest& of_part = highest[parts.of_face[f]];
    if (of_part.face == arrangement::kNone || height > of_part.height) of_part = {height, f};
  }
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    RETURN_IF_ERROR(monitor.check());
    const TriangleRef start = surface_.corners(FaceId(highest[part].face));
    const ExactPoint middle(Rational(1, 3) * (start[0].rational() + start[1].rational() + start[2].rational()));
    std::uint32_t room = 2 * highest[part].face + (arrangement::is_room_above_in_front(start) ? 0 : 1);
    bool is_open = true;
    faces_above.for_each(middle, [&](std::uint32_t face, int sign) {
      is_open = parts.of_face[face] == part;
      if (!is_open) sets_.unite(room, 2 * face + (sign > 0 ? 1 : 0));
      room = 2 * face + (sign > 0 ? 0 : 1);
      return is_open;
    });
    if (is_open) sets_.unite(room, open_air());
  }
  return {};
}

Status Rooms::find(const Monitor& monitor) {
  RETURN_IF_ERROR(join_at_edges(monitor));
  return join_to_what_is_above(monitor);
}

struct Sample {
  double area;
  std::uint32_t face;
  bool is_behind;
};

/// The rooms of the solid, by winding numbers at some of their largest walls.
Result<std::map<std::uint32_t, bool>> choose_rooms(const TriangleMesh& surface, Rooms& rooms,
                                                   const WindingNumbers& numbers, const Monitor& monitor,
                                                   double max_angles) {
  constexpr std::size_t kSamplesPerRoom = 16;
  constexpr double kOffset = 1e-7;
  std::map<std::uint32_t, std::vector<Sample>> walls;
  Box3 box;
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const TriangleRef c = surface.corners(FaceId(f));
    const Vec3 normal = cross(c[1].approx - c[0].approx, c[2].approx - c[0].approx);
    const double area = std::sqrt(dot(normal, normal));
    for (const PointRef& corner : c) box.extend(corner.approx);
    if (rooms.in_front(f) == rooms.behind(f)) continue;
    walls[rooms.in_front(f)].push_back({area, f, false});
    walls[rooms.behind(f)].push_back({area, f, true});
  }
  const Vec3 extent = box.max - box.min;
  const double farthest = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                                    std::abs(box.max.y), std::abs(box.max.z)});
  // Beside the wall whatever rounding does, and no farther than a wall of that size can be thick.
  const double least = 64 * std::numeric_limits<double>::epsilon() * farthest;
  const double most = kOffset * std::sqrt(dot(extent, extent));
  double angles = 0;
  std::map<std::uint32_t, bool> result;
  for (auto& [room, samples] : walls) {
    if (room == rooms.open_air()) continue;
    RETURN_IF_ERROR(monitor.check());
    const std::size_t count = std::min(kSamplesPerRoom, samples.size());
    std::ranges::partial_sort(
        samples, samples.begin() + static_cast<std::ptrdiff_t>(count), [](const Sample& a, const Sample& b) {
          return std::tuple(-a.area, a.face, a.is_behind) < std::tuple(-b.area, b.face, b.is_behind);
        });
    angles += static_cast<double>(count) * static_cast<double>(numbers.facet_count());
    if (angles > max_angles)
      return Error{ErrorCode::limit_exceeded, "inside and outside need more than {:.0f} million solid angles",
                   max_angles / 1e6};
    double sum = 0, total = 0;
    for (const Sample& sample : std::span(samples).first(count)) {
      const TriangleRef c = surface.corners(FaceId(sample.face));
      const Vec3 normal = cross(c[1].approx - c[0].approx, c[2].approx - c[0].approx);
      if (!(sample.area > 0)) continue;
      const Vec3 middle = (1.0 / 3) * (c[0].approx + c[1].approx + c[2].approx);
      const double offset = std::max(least, std::min(most, 1e-3 * std::sqrt(sample.area)));
      const Vec3 beside = middle + ((sample.is_behind ? -offset : offset) / sample.area) * normal;
      sum += sample.area * numbers.at(beside);
      total += sample.area;
    }
    result[room] = total > 0 && sum > total / 2;
  }
  return result;
}

/// Faces at edges that no longer part anything are triangulated anew with their neighbours.
Result<TriangleMesh> without_needless_edges(const TriangleMesh& solid, const std::vector<bool>& is_at_seam,
                                            const Monitor& monitor) {
  ASSIGN_OR_RETURN(const ValidParts parts, ValidParts::make(solid, is_at_seam, monitor));
  ASSIGN_OR_RETURN(const SolidArrangement arrangement,
                   SolidArrangement::make(parts.operands(), monitor, {Closure::together}));
  return arrangement.solid([](const Holding& holding) { return holding[0] > 0; });
}

}  // namespace

Result<TriangleMesh> tolerant_solid(const FacetList& facets, const ValidParts& parts, const Monitor& monitor,
                                    const ArrangementOptions& limits, double max_angles) {
  ASSIGN_OR_RETURN(const TriangleMesh surface, unite_surfaces(parts.operands(), monitor, limits));
  Rooms rooms(surface);
  RETURN_IF_ERROR(rooms.find(monitor));
  ASSIGN_OR_RETURN(const auto is_inside, choose_rooms(surface, rooms, WindingNumbers(facets), monitor, max_angles));
  const auto holds = [&](std::uint32_t room) {
    const auto known = is_inside.find(room);
    return known != is_inside.end() && known->second;
  };
  std::vector<TriangleMesh::Triangle> triangles;
  std::vector<bool> is_at_seam;
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const bool front = holds(rooms.in_front(f)), back = holds(rooms.behind(f));
    if (front == back) continue;
    TriangleMesh::Triangle triangle = surface.triangle(FaceId(f));
    if (front) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
    is_at_seam.push_back(false);
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h)
      if (!surface.opposite(HalfedgeId(h)).is_valid()) is_at_seam.back() = true;
  }
  const TriangleMesh solid(surface.points(), triangles);
  return without_needless_edges(solid, is_at_seam, monitor);
}

}  // namespace algebra3d
