#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/properties.h>

#include <cstddef>

#include "algebra3d/mesh/graph.h"

/// The property maps that CGAL's algorithms on meshes need besides algebra3d/mesh/graph.h: the points of the vertices
/// and the numbers of faces and half-edges. Include it before headers of CGAL's algorithms. Needs CGAL; the library
/// itself does not.
namespace algebra3d::mesh {

/// The points of vertices as those of CGAL, rounded if they are fractions (Mesh::has_fractions).
template <AnyMesh M>
class PointMap {
 public:
  using key_type = VertexId;
  using value_type = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  PointMap() = default;
  explicit PointMap(const Graph<M>& g) : graph_(&g) {}

  friend value_type get(const PointMap& map, VertexId v) { return map[v]; }
  value_type operator[](VertexId v) const {
    const Vec3& p = graph_->mesh().point(v);
    return {p.x, p.y, p.z};
  }

 private:
  const Graph<M>* graph_ = nullptr;
};

template <AnyMesh M>
PointMap<M> get(boost::vertex_point_t /*tag*/, const Graph<M>& g) {
  return PointMap<M>(g);
}
template <AnyMesh M>
typename PointMap<M>::value_type get(boost::vertex_point_t tag, const Graph<M>& g, VertexId v) {
  return get(tag, g)[v];
}
template <AnyMesh M>
IndexMap<M, FaceId> get(boost::face_index_t /*tag*/, const Graph<M>& g) {
  return IndexMap<M, FaceId>(g);
}
template <AnyMesh M>
std::size_t get(boost::face_index_t /*tag*/, const Graph<M>& /*g*/, FaceId f) {
  return f.index();
}

}  // namespace algebra3d::mesh

namespace boost {

template <algebra3d::mesh::AnyMesh M>
struct property_map<algebra3d::mesh::Graph<M>, vertex_point_t> {
  using type = algebra3d::mesh::PointMap<M>;
  using const_type = type;
};
template <algebra3d::mesh::AnyMesh M>
struct property_map<algebra3d::mesh::Graph<M>, face_index_t> {
  using type = algebra3d::mesh::IndexMap<M, algebra3d::FaceId>;
  using const_type = type;
};

}  // namespace boost

namespace CGAL {

template <algebra3d::mesh::AnyMesh M>
struct graph_has_property<algebra3d::mesh::Graph<M>, boost::vertex_point_t> : Tag_true {};
template <algebra3d::mesh::AnyMesh M>
struct graph_has_property<algebra3d::mesh::Graph<M>, boost::vertex_index_t> : Tag_true {};
template <algebra3d::mesh::AnyMesh M>
struct graph_has_property<algebra3d::mesh::Graph<M>, boost::edge_index_t> : Tag_true {};
template <algebra3d::mesh::AnyMesh M>
struct graph_has_property<algebra3d::mesh::Graph<M>, boost::face_index_t> : Tag_true {};

}  // namespace CGAL
