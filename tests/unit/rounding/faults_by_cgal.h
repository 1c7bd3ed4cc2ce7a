#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// The definition of a valid solid, by CGAL's exact intersections of all pairs of triangles whose boxes meet.
namespace algebra3d::solids {

using FaultKernel = CGAL::Exact_predicates_exact_constructions_kernel;

inline std::vector<FaultKernel::Triangle_3> triangles_of_cgal(const TriangleMesh& mesh) {
  std::vector<FaultKernel::Triangle_3> triangles;
  const auto point = [](const PointRef& p) { return FaultKernel::Point_3(p.approx.x, p.approx.y, p.approx.z); };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    triangles.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  }
  return triangles;
}

inline bool is_edge_of(const FaultKernel::Segment_3& part, const FaultKernel::Triangle_3& t) {
  for (int i = 0; i < 3; ++i) {
    const FaultKernel::Segment_3 edge(t[i], t[i + 1]);
    if (edge == part || edge.opposite() == part) return true;
  }
  return false;
}

inline bool is_corner_of(const FaultKernel::Point_3& point, const FaultKernel::Triangle_3& t) {
  return point == t[0] || point == t[1] || point == t[2];
}

/// Counts of faults that the definition forbids, and of points of contact, which it allows.
struct Faults {
  int degenerate = 0, improper_pairs = 0, unbalanced_edges = 0;
  int points_inside = 0;  ///< pairs that share one point, which is not a corner of both
};

inline Faults faults_of(const TriangleMesh& mesh) {
  Faults faults;
  const std::vector<FaultKernel::Triangle_3> triangles = triangles_of_cgal(mesh);
  for (const FaultKernel::Triangle_3& t : triangles) faults.degenerate += static_cast<int>(t.is_degenerate());
  if (faults.degenerate > 0) return faults;
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const FaultKernel::Triangle_3*>;
  std::vector<Box> boxes;
  for (const FaultKernel::Triangle_3& t : triangles) boxes.emplace_back(t.bbox(), &t);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const FaultKernel::Triangle_3 &s = *a.handle(), &t = *b.handle();
    const auto common = CGAL::intersection(s, t);
    if (!common) return;
    if (const auto* point = boost::get<FaultKernel::Point_3>(&*common))
      faults.points_inside += static_cast<int>(!is_corner_of(*point, s) || !is_corner_of(*point, t));
    else if (const auto* segment = boost::get<FaultKernel::Segment_3>(&*common))
      faults.improper_pairs += static_cast<int>(!is_edge_of(*segment, s) || !is_edge_of(*segment, t));
    else
      ++faults.improper_pairs;
  });
  std::map<std::pair<Vec3, Vec3>, int> balance;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const TriangleRef t = mesh.corners(FaceId(f));
      const Vec3 &from = t[i].approx, &to = t[(i + 1) % 3].approx;
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  for (const auto& [edge, excess] : balance) faults.unbalanced_edges += static_cast<int>(excess != 0);
  return faults;
}

}  // namespace algebra3d::solids
