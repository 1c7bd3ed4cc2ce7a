#include "algebra3d/repair/pressed_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "algebra3d/exact/plane.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/repair/mesh_facets.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

constexpr double kFarthest = 4;  // in terms of the reach

/// A facet as a whole.
struct Sheet {
  std::vector<std::uint32_t> vertices;  // ascending
  std::uint32_t face = 0;               // the largest of its triangles
  std::optional<ExactPlane> plane;      // in which it lies now, once that is asked for
  bool is_bent = false;                 // it lies in no plane any more
  Vec3 normal;                          // of all its triangles together, twice their area long; rounded
  Box3 box;

  double area() const { return std::sqrt(dot(normal, normal)); }
};

/// A vertex on its way, with up to three planes that it must not leave.
struct Traveller {
  RationalVec3 place;
  std::vector<ExactPlane> planes;
};

double length(const RationalVec3& v) {
  return std::hypot(v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double());
}

/// The direction in which a point gets to a plane without leaving those that it lies in; zero if it cannot.
RationalVec3 way_to(const ExactPlane& plane, std::span<const ExactPlane> kept) {
  switch (kept.size()) {
    case 0:
      return plane.normal;
    case 1:
      return dot(kept[0].normal, kept[0].normal) * plane.normal - dot(kept[0].normal, plane.normal) * kept[0].normal;
    case 2:
      return cross(kept[0].normal, kept[1].normal);
    default:
      return {};
  }
}

ExactPlane plane_of(const TriangleRef& triangle) {
  const RationalVec3 corner = triangle[0].rational();
  return ExactPlane::spanned(corner, triangle[1].rational() - corner, triangle[2].rational() - corner)->canonical();
}

class Pressing {
 public:
  Pressing(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach)
      : solid_(solid), facets_(solid), reach_(reach), travellers_(solid.vertex_count()) {
    for (std::uint32_t facet = 0; facet < facets_.count(); ++facet) add_sheet(facet, in_question);
    find_sheets_of_vertices();
  }

  MovedVertices run();

 private:
  void add_sheet(std::uint32_t facet, const std::vector<bool>& in_question);
  void find_sheets_of_vertices();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parallel_pairs() const;
  bool press(std::uint32_t sheet, std::uint32_t upon);
  void keep_in(const ExactPlane& plane, std::uint32_t vertex);
  void bend_sheets_at(std::uint32_t vertex);
  std::vector<std::uint32_t> close_vertices(const Sheet& sheet, const Sheet& upon, const ExactPlane& plane) const;
  std::optional<RationalVec3> moved_into(const ExactPlane& plane, std::uint32_t vertex) const;

  const ExactPlane& plane_of_sheet(std::uint32_t sheet);
  RationalVec3 place(std::uint32_t vertex) const {
    return travellers_[vertex] ? travellers_[vertex]->place : solid_.point(VertexId(vertex)).rational();
  }
  Traveller& traveller(std::uint32_t vertex) {
    if (!travellers_[vertex]) travellers_[vertex] = Traveller{place(vertex), {}};
    return *travellers_[vertex];
  }

  const TriangleMesh& solid_;
  MeshFacets facets_;
  double reach_;
  std::vector<Sheet> sheets_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sheets_of_vertices_;  // vertex, sheet; ascending
  std::vector<std::optional<Traveller>> travellers_;                         // per vertex
};

void Pressing::add_sheet(std::uint32_t facet, const std::vector<bool>& in_question) {
  Sheet sheet;
  double largest = -1;
  for (const std::uint32_t face : facets_->faces(facet)) {
    const TriangleRef corners = solid_.corners(FaceId(face));
    const Vec3 normal = cross(corners[1].approx - corners[0].approx, corners[2].approx - corners[0].approx);
    if (const double area = dot(normal, normal); area > largest) {
      largest = area;
      sheet.face = face;
    }
    sheet.normal = sheet.normal + normal;
    sheet.box.extend(box_of_triangle(corners));
    for (const std::uint32_t vertex : solid_.triangle(FaceId(face))) sheet.vertices.push_back(vertex);
  }
  std::ranges::sort(sheet.vertices);
  sheet.vertices.erase(std::unique(sheet.vertices.begin(), sheet.vertices.end()), sheet.vertices.end());
  if (std::ranges::any_of(sheet.vertices, [&](std::uint32_t v) { return in_question[v]; }))
    sheets_.push_back(std::move(sheet));
}

void Pressing::find_sheets_of_vertices() {
  for (std::uint32_t s = 0; s < sheets_.size(); ++s)
    for (const std::uint32_t vertex : sheets_[s].vertices) sheets_of_vertices_.emplace_back(vertex, s);
  std::ranges::sort(sheets_of_vertices_);
}

/// The smaller one first; those with the largest second one first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> Pressing::parallel_pairs() const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t s = 0; s < sheets_.size(); ++s) {
    const Vec3 margin{reach_, reach_, reach_};
    entries.push_back({{sheets_[s].box.min - margin, sheets_[s].box.max + margin}, s});
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  rtree::for_each_pair(rtree::RTree<std::uint32_t>::bulk_load(entries), [&](std::uint32_t a, std::uint32_t b) {
    constexpr double kNearlyParallel = 0.99;
    const double cosine = dot(sheets_[a].normal, sheets_[b].normal) / (sheets_[a].area() * sheets_[b].area());
    if (!(std::abs(cosine) > kNearlyParallel)) return;
    pairs.push_back(sheets_[a].area() <= sheets_[b].area() ? std::pair(a, b) : std::pair(b, a));
  });
  std::ranges::sort(pairs, {}, [&](const auto& pair) { return std::tuple(-sheets_[pair.second].area(), pair); });
  return pairs;
}

/// All vertices of the sheet, if all are close to the plane; else those that are close to the other sheet.
std::vector<std::uint32_t> Pressing::close_vertices(const Sheet& sheet, const Sheet& upon,
                                                    const ExactPlane& plane) const {
  std::vector<std::uint32_t> close;
  const double normal = length(plane.normal);
  for (const std::uint32_t vertex : sheet.vertices)
    if (std::abs(plane.evaluate(place(vertex)).nearest_double()) <= reach_ * normal) close.push_back(vertex);
  if (close.size() == sheet.vertices.size()) return close;
  const Vec3 margin{reach_, reach_, reach_};
  const Box3 around{upon.box.min - margin, upon.box.max + margin};
  std::erase_if(close, [&](std::uint32_t v) { return !around.contains(solid_.point(VertexId(v)).approx); });
  return close;
}

std::optional<RationalVec3> Pressing::moved_into(const ExactPlane& plane, std::uint32_t vertex) const {
  const RationalVec3 from = place(vertex);
  const Rational off = plane.evaluate(from);
  if (off.sign() == 0) return from;
  std::span<const ExactPlane> kept;
  if (travellers_[vertex]) kept = travellers_[vertex]->planes;
  const RationalVec3 way = way_to(plane, kept);
  const Rational climb = dot(way, plane.normal);
  if (climb.sign() == 0) return std::nullopt;
  const RationalVec3 to = from - (off / climb) * way;
  if (!(length(to - solid_.point(VertexId(vertex)).rational()) <= kFarthest * reach_)) return std::nullopt;
  return to;
}

/// The vertex lies in the plane, and will stay there.
void Pressing::keep_in(const ExactPlane& plane, std::uint32_t vertex) {
  Traveller& moving = traveller(vertex);
  const bool is_new = dot(way_to(plane, moving.planes), plane.normal).sign() != 0;
  if (is_new) moving.planes.push_back(plane);
}

const ExactPlane& Pressing::plane_of_sheet(std::uint32_t sheet) {
  auto& plane = sheets_[sheet].plane;
  if (!plane) plane = plane_of(solid_.corners(FaceId(sheets_[sheet].face)));
  return *plane;
}

/// False if that would move a vertex too far, or out of a plane that it must not leave.
bool Pressing::press(std::uint32_t sheet, std::uint32_t upon) {
  if (sheets_[upon].is_bent) return false;
  const ExactPlane plane = plane_of_sheet(upon);
  std::vector<std::pair<std::uint32_t, RationalVec3>> moves;
  for (const std::uint32_t vertex : close_vertices(sheets_[sheet], sheets_[upon], plane)) {
    auto to = moved_into(plane, vertex);
    if (!to) return false;
    moves.emplace_back(vertex, *std::move(to));
  }
  if (std::ranges::all_of(moves, [&](const auto& move) { return place(move.first) == move.second; })) return true;
  for (const std::uint32_t vertex : sheets_[upon].vertices) keep_in(plane, vertex);
  if (moves.size() == sheets_[sheet].vertices.size()) {
    sheets_[sheet].plane = plane;
    sheets_[sheet].is_bent = false;
  }
  for (auto& [vertex, to] : moves) {
    traveller(vertex).place = std::move(to);
    keep_in(plane, vertex);
  }
  for (const auto& move : moves) bend_sheets_at(move.first);
  return true;
}

/// Those that the vertex has left.
void Pressing::bend_sheets_at(std::uint32_t vertex) {
  for (auto at = std::ranges::lower_bound(sheets_of_vertices_, std::pair(vertex, 0U));
       at != sheets_of_vertices_.end() && at->first == vertex; ++at)
    if (!sheets_[at->second].is_bent)
      sheets_[at->second].is_bent = plane_of_sheet(at->second).evaluate(place(vertex)).sign() != 0;
}

MovedVertices Pressing::run() {
  for (const auto& [smaller, larger] : parallel_pairs())
    if (!press(smaller, larger)) press(larger, smaller);
  MovedVertices moved;
  for (std::uint32_t v = 0; v < solid_.vertex_count(); ++v) {
    const ExactPoint given = solid_.points().point(v);
    moved.points.push_back(travellers_[v] ? ExactPoint(travellers_[v]->place) : given);
    moved.movements.push_back(travellers_[v] ? length(travellers_[v]->place - given.rational()) : 0);
  }
  return moved;
}

}  // namespace

MovedVertices pressed_sheets(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach) {
  return Pressing(solid, in_question, reach).run();
}

}  // namespace algebra3d
