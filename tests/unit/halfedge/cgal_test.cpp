// The mesh and its topology against CGAL's surface mesh.

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "mesh_samples.h"
#include "support/to_cgal.h"

namespace algebra3d {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Calls test(ours, theirs) for each manifold sample.
template <typename Test>
void for_each_manifold_sample(Test test) {
  std::size_t count = 0;
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const bool has_loop =
        std::ranges::any_of(triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (!is_manifold(mesh) || has_loop) continue;
    const auto theirs = oracle::to_cgal_mesh<Kernel>(mesh);
    ASSERT_TRUE(theirs.has_value());
    ASSERT_NO_FATAL_FAILURE(test(mesh, *theirs));
    ++count;
  }
  EXPECT_GT(count, 50U);
}

/// Our half-edge as theirs.
CgalMesh::Halfedge_index same(const TriangleMesh& mesh, const CgalMesh& theirs, HalfedgeId h) {
  return theirs.halfedge(CgalMesh::Vertex_index(mesh.origin(h).index()),
                         CgalMesh::Vertex_index(mesh.target(h).index()));
}

TEST(AgainstCgal, adjacency_agrees) {
  for_each_manifold_sample([](const TriangleMesh& mesh, const CgalMesh& theirs) {
    ASSERT_EQ(theirs.number_of_edges(), edge_count(mesh));
    for (const HalfedgeId h : halfedges(mesh)) {
      const auto other = same(mesh, theirs, h);
      ASSERT_EQ(theirs.face(other).idx(), TriangleMesh::face(h).index());
      ASSERT_EQ(theirs.next(other), same(mesh, theirs, TriangleMesh::next(h)));
      ASSERT_EQ(theirs.is_border(theirs.opposite(other)), mesh.is_boundary(h));
      if (!mesh.is_boundary(h)) {
        ASSERT_EQ(theirs.opposite(other), same(mesh, theirs, mesh.opposite(h)));
      }
    }
    for (const VertexId v : vertices(mesh))
      ASSERT_EQ(theirs.degree(CgalMesh::Vertex_index(v.index())),
                static_cast<std::size_t>(std::ranges::distance(adjacent_vertices(mesh, v))));
  });
}

TEST(AgainstCgal, components_loops_and_closedness_agree) {
  for_each_manifold_sample([](const TriangleMesh& mesh, const CgalMesh& original) {
    CgalMesh theirs = original;
    const auto component = theirs.add_property_map<CgalMesh::Face_index, std::size_t>("f:component", 0).first;
    const std::size_t count = pmp::connected_components(theirs, component);
    const FaceComponents ours = connected_components(mesh);
    ASSERT_EQ(ours.count, count);
    for (const FaceId f : faces(mesh)) ASSERT_EQ(ours.of_face[f.index()], component[CgalMesh::Face_index(f.index())]);
    std::vector<CgalMesh::Halfedge_index> cycles;
    pmp::extract_boundary_cycles(theirs, std::back_inserter(cycles));
    ASSERT_EQ(boundary_loops(mesh).size(), cycles.size());
    ASSERT_EQ(is_closed(mesh), CGAL::is_closed(theirs));
  });
}

}  // namespace
}  // namespace algebra3d
