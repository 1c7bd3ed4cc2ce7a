#pragma once

#include <algorithm>
#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/property_map/property_map.hpp>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/mesh/mesh.h"

/// A mesh as a graph for the algorithms of the Boost Graph Library, and, with algebra3d/mesh/cgal.h, of CGAL. Needs the
/// headers of Boost; the library itself does not.
namespace algebra3d::mesh {

/// A half-edge of a mesh, or the half-edge beyond the boundary that runs along one in the other direction: so every
/// edge has two, of which those without a face form loops.
class GraphHalfedge {
 public:
  GraphHalfedge() = default;  ///< none
  explicit GraphHalfedge(HalfedgeId h, bool is_border = false) : code_(2 * h.index() + (is_border ? 1 : 0)) {}

  /// The half-edge of the mesh along the same edge; beyond the boundary it runs in the other direction.
  HalfedgeId halfedge() const { return is_valid() ? HalfedgeId(code_ / 2) : HalfedgeId(); }
  bool is_border() const { return is_valid() && code_ % 2 == 1; }
  bool is_valid() const { return code_ != kNone; }
  /// A number below twice the number of the half-edges of the mesh; not all of these are used.
  std::uint32_t number() const { return code_; }

  friend auto operator<=>(const GraphHalfedge&, const GraphHalfedge&) = default;
  friend std::size_t hash_value(const GraphHalfedge& h) { return h.code_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::uint32_t code_ = kNone;
};

/// An edge with a direction, in which an algorithm met it. Both directions are equal.
class GraphEdge {
 public:
  GraphEdge() = default;  ///< none
  /// `first`: the first half-edge along the edge.
  GraphEdge(GraphHalfedge direction, HalfedgeId first) : direction_(direction), first_(first) {}

  GraphHalfedge direction() const { return direction_; }
  HalfedgeId first() const { return first_; }

  friend auto operator<=>(const GraphEdge& a, const GraphEdge& b) { return a.first_ <=> b.first_; }
  friend bool operator==(const GraphEdge& a, const GraphEdge& b) { return a.first_ == b.first_; }
  friend std::size_t hash_value(const GraphEdge& e) { return e.first_.index(); }

 private:
  GraphHalfedge direction_;
  HalfedgeId first_;
};

/// The graph of a mesh: a model of Boost's VertexListGraph, EdgeListGraph, BidirectionalGraph and AdjacencyGraph, and
/// of CGAL's HalfedgeListGraph and FaceListGraph. Vertices and faces are the handles of the mesh. Holds the mesh, whose
/// arrays it shares, and must outlive its iterators. CGAL's algorithms demand a manifold mesh; any other counts as cut
/// along its non-manifold edges, and the half-edges around a non-manifold vertex are then those of one fan.
///
/// The free functions are those of the concepts. Cost: constant; next and previous half-edge beyond the boundary take
/// the number of faces at their common vertex.
template <AnyMesh M>
class Graph {
 public:
  /// Cost: constant; linear in the half-edges of non-manifold edges.
  explicit Graph(const M& mesh) : mesh_(mesh) {
    for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
      for (const HalfedgeId h : mesh.nonmanifold_edge(n))
        if (mesh.halfedge(mesh.edge(h)) != h) cut_off_.push_back(h);
    std::ranges::sort(cut_off_);
  }
  const M& mesh() const { return mesh_; }

  /// The number of an edge, below num_edges: that of the mesh, and beyond these for the other half-edges of edges that
  /// count as cut.
  std::size_t number_of(const GraphEdge& e) const {
    const auto found = std::ranges::lower_bound(cut_off_, e.first());
    if (found == cut_off_.end() || *found != e.first()) return mesh_.edge(e.first()).index();
    return mesh_.edge_count() + static_cast<std::size_t>(found - cut_off_.begin());
  }

 private:
  M mesh_;
  std::vector<HalfedgeId> cut_off_;
};

namespace detail {

/// A range as a pair of iterators, as Boost wants it.
template <typename Iterator>
class IteratorPair : public std::pair<Iterator, Iterator> {
 public:
  using iterator = Iterator;
  using const_iterator = Iterator;

  using std::pair<Iterator, Iterator>::pair;
  template <typename Range>
  static IteratorPair of(const Range& range) {
    return {range.begin(), range.end()};
  }

  Iterator begin() const { return this->first; }
  Iterator end() const { return this->second; }
  bool empty() const { return this->first == this->second; }
  std::size_t size() const { return static_cast<std::size_t>(std::ranges::distance(this->first, this->second)); }
};

/// Walks over the half-edges that leave a vertex, with those beyond the boundary.
template <AnyMesh M>
class OutHalfedgeCursor {
 public:
  using value_type = GraphHalfedge;

  OutHalfedgeCursor() = default;
  OutHalfedgeCursor(const M& mesh, std::span<const HalfedgeId> fans) : corner_(mesh, fans) {}

  GraphHalfedge get() const {
    const HalfedgeId h = corner_.get();
    return is_beyond_ ? GraphHalfedge(corner_.mesh().prev(h), true) : GraphHalfedge(h);
  }
  void advance() {
    is_beyond_ = !is_beyond_ && !corner_.next_in_fan().is_valid();
    if (!is_beyond_) corner_.advance();
  }
  bool operator==(const OutHalfedgeCursor& other) const = default;

 private:
  circulators::CornerCursor<M> corner_;
  bool is_beyond_ = false;
};

/// Walks over all half-edges.
template <AnyMesh M>
class AllHalfedgesCursor {
 public:
  using value_type = GraphHalfedge;

  AllHalfedgesCursor() = default;
  AllHalfedgesCursor(const M& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) {}

  GraphHalfedge get() const { return GraphHalfedge(HalfedgeId(halfedge_), is_beyond_); }
  void advance() {
    is_beyond_ = !is_beyond_ && !mesh_->opposite(HalfedgeId(halfedge_)).is_valid();
    if (!is_beyond_) ++halfedge_;
  }
  bool operator==(const AllHalfedgesCursor& other) const {
    return halfedge_ == other.halfedge_ && is_beyond_ == other.is_beyond_;
  }

 private:
  const M* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
  bool is_beyond_ = false;
};

/// The edge of a half-edge; each half-edge of a non-manifold one is an edge of its own.
template <AnyMesh M>
GraphEdge edge_of(const M& mesh, GraphHalfedge h) {
  const HalfedgeId along = h.halfedge(), opposite = mesh.opposite(along);
  return {h, opposite.is_valid() && opposite < along ? opposite : along};
}

/// Walks over all edges.
template <AnyMesh M>
class AllEdgesCursor {
 public:
  using value_type = GraphEdge;

  AllEdgesCursor() = default;
  AllEdgesCursor(const M& mesh, std::size_t halfedge) : mesh_(&mesh), halfedge_(halfedge) { skip(); }

  GraphEdge get() const { return edge_of(*mesh_, GraphHalfedge(HalfedgeId(halfedge_))); }
  void advance() {
    ++halfedge_;
    skip();
  }
  bool operator==(const AllEdgesCursor& other) const { return halfedge_ == other.halfedge_; }

 private:
  void skip() {
    while (halfedge_ < mesh_->halfedge_count() && get().first() != HalfedgeId(halfedge_)) ++halfedge_;
  }

  const M* mesh_ = nullptr;
  std::size_t halfedge_ = 0;
};

template <AnyMesh M>
GraphHalfedge opposite_of(const M& mesh, GraphHalfedge h) {
  if (h.is_border()) return GraphHalfedge(h.halfedge());
  const HalfedgeId opposite = mesh.opposite(h.halfedge());
  return opposite.is_valid() ? GraphHalfedge(opposite) : GraphHalfedge(h.halfedge(), true);
}

/// Walks over the edges at a vertex, which leave it, or which end in it.
template <AnyMesh M, bool is_outward>
class EdgesAtCursor : public OutHalfedgeCursor<M> {
 public:
  using value_type = GraphEdge;

  EdgesAtCursor() = default;
  EdgesAtCursor(const M& mesh, std::span<const HalfedgeId> fans) : OutHalfedgeCursor<M>(mesh, fans), mesh_(&mesh) {}

  GraphEdge get() const {
    const GraphHalfedge h = OutHalfedgeCursor<M>::get();
    return edge_of(*mesh_, is_outward ? h : opposite_of(*mesh_, h));
  }

 private:
  const M* mesh_ = nullptr;
};

template <typename Cursor, AnyMesh M>
IteratorPair<CursorIterator<Cursor>> around_vertex(const M& mesh, VertexId v) {
  const auto fans = mesh.fans(v);
  return {CursorIterator(Cursor(mesh, fans)), CursorIterator(Cursor(mesh, fans.subspan(fans.size())))};
}
template <typename Cursor, AnyMesh M>
IteratorPair<CursorIterator<Cursor>> all_halfedges(const M& mesh) {
  return {CursorIterator(Cursor(mesh, 0)), CursorIterator(Cursor(mesh, mesh.halfedge_count()))};
}

template <AnyMesh M>
using NeighbourIterator =
    decltype(algebra3d::adjacent_vertices(std::declval<const M&>(), std::declval<VertexId>()).begin());

}  // namespace detail

// HalfedgeGraph, FaceGraph.

template <AnyMesh M>
GraphHalfedge opposite(GraphHalfedge h, const Graph<M>& g) {
  return detail::opposite_of(g.mesh(), h);
}
template <AnyMesh M>
GraphHalfedge next(GraphHalfedge h, const Graph<M>& g) {
  const M& mesh = g.mesh();
  if (!h.is_border()) return GraphHalfedge(mesh.next(h.halfedge()));
  // Round the fan at the target of `h`, counter-clockwise, to the boundary at its end.
  HalfedgeId in_fan = h.halfedge();
  while (true) {
    const HalfedgeId incoming = mesh.prev(in_fan);
    in_fan = mesh.opposite(incoming);
    if (!in_fan.is_valid()) return GraphHalfedge(incoming, true);
  }
}
template <AnyMesh M>
GraphHalfedge prev(GraphHalfedge h, const Graph<M>& g) {
  const M& mesh = g.mesh();
  if (!h.is_border()) return GraphHalfedge(mesh.prev(h.halfedge()));
  HalfedgeId in_fan = mesh.next(h.halfedge());
  while (mesh.opposite(in_fan).is_valid()) in_fan = mesh.next(mesh.opposite(in_fan));
  return GraphHalfedge(in_fan, true);
}
template <AnyMesh M>
VertexId source(GraphHalfedge h, const Graph<M>& g) {
  return h.is_border() ? g.mesh().target(h.halfedge()) : g.mesh().origin(h.halfedge());
}
template <AnyMesh M>
VertexId target(GraphHalfedge h, const Graph<M>& g) {
  return h.is_border() ? g.mesh().origin(h.halfedge()) : g.mesh().target(h.halfedge());
}
template <AnyMesh M>
VertexId source(const GraphEdge& e, const Graph<M>& g) {
  return source(e.direction(), g);
}
template <AnyMesh M>
VertexId target(const GraphEdge& e, const Graph<M>& g) {
  return target(e.direction(), g);
}
template <AnyMesh M>
GraphEdge edge(GraphHalfedge h, const Graph<M>& g) {
  return detail::edge_of(g.mesh(), h);
}
template <AnyMesh M>
GraphHalfedge halfedge(const GraphEdge& e, const Graph<M>& /*g*/) {
  return e.direction();
}
/// A half-edge that ends in `v`, one without a face if there is one; none at an isolated vertex.
template <AnyMesh M>
GraphHalfedge halfedge(VertexId v, const Graph<M>& g) {
  const HalfedgeId outgoing = g.mesh().outgoing(v);
  return outgoing.is_valid() ? opposite(GraphHalfedge(outgoing), g) : GraphHalfedge();
}
template <AnyMesh M>
GraphHalfedge halfedge(FaceId f, const Graph<M>& g) {
  return GraphHalfedge(g.mesh().halfedge(f));
}
/// Invalid beyond the boundary.
template <AnyMesh M>
FaceId face(GraphHalfedge h, const Graph<M>& g) {
  return h.is_border() ? FaceId() : g.mesh().face(h.halfedge());
}
template <AnyMesh M>
std::pair<GraphHalfedge, bool> halfedge(VertexId from, VertexId to, const Graph<M>& g) {
  for (const GraphHalfedge h : detail::around_vertex<detail::OutHalfedgeCursor<M>>(g.mesh(), from))
    if (target(h, g) == to) return {h, true};
  return {GraphHalfedge(), false};
}
template <AnyMesh M>
std::pair<GraphEdge, bool> edge(VertexId from, VertexId to, const Graph<M>& g) {
  const auto [h, is_found] = halfedge(from, to, g);
  return {is_found ? edge(h, g) : GraphEdge(), is_found};
}

// The lists of elements.

template <AnyMesh M>
auto vertices(const Graph<M>& g) {
  return detail::IteratorPair<HandleRange<VertexId>::Iterator>::of(algebra3d::vertices(g.mesh()));
}
template <AnyMesh M>
auto faces(const Graph<M>& g) {
  return detail::IteratorPair<HandleRange<FaceId>::Iterator>::of(algebra3d::faces(g.mesh()));
}
template <AnyMesh M>
auto edges(const Graph<M>& g) {
  return detail::all_halfedges<detail::AllEdgesCursor<M>>(g.mesh());
}
template <AnyMesh M>
auto halfedges(const Graph<M>& g) {
  return detail::all_halfedges<detail::AllHalfedgesCursor<M>>(g.mesh());
}
template <AnyMesh M>
std::size_t num_vertices(const Graph<M>& g) {
  return g.mesh().vertex_count();
}
template <AnyMesh M>
std::size_t num_faces(const Graph<M>& g) {
  return g.mesh().face_count();
}
template <AnyMesh M>
std::size_t num_edges(const Graph<M>& g) {
  const M& mesh = g.mesh();
  std::size_t count = mesh.edge_count() - mesh.nonmanifold_edge_count();
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) count += mesh.nonmanifold_edge(n).size();
  return count;
}
template <AnyMesh M>
std::size_t num_halfedges(const Graph<M>& g) {
  return 2 * num_edges(g);
}

// IncidenceGraph, BidirectionalGraph, AdjacencyGraph.

template <AnyMesh M>
auto out_edges(VertexId v, const Graph<M>& g) {
  return detail::around_vertex<detail::EdgesAtCursor<M, true>>(g.mesh(), v);
}
template <AnyMesh M>
auto in_edges(VertexId v, const Graph<M>& g) {
  return detail::around_vertex<detail::EdgesAtCursor<M, false>>(g.mesh(), v);
}
template <AnyMesh M>
auto adjacent_vertices(VertexId v, const Graph<M>& g) {
  return detail::IteratorPair<detail::NeighbourIterator<M>>::of(algebra3d::adjacent_vertices(g.mesh(), v));
}
template <AnyMesh M>
std::size_t out_degree(VertexId v, const Graph<M>& g) {
  return out_edges(v, g).size();
}
template <AnyMesh M>
std::size_t in_degree(VertexId v, const Graph<M>& g) {
  return out_degree(v, g);
}
template <AnyMesh M>
std::size_t degree(VertexId v, const Graph<M>& g) {
  return out_degree(v, g);
}
template <AnyMesh M>
std::size_t degree(FaceId f, const Graph<M>& g) {
  return g.mesh().degree(f);
}

// Property maps: the numbers of vertices and edges, and the lengths of edges as their weights.

/// Numbers of elements from 0. For half-edges some numbers are not used.
template <AnyMesh M, typename Descriptor>
class IndexMap {
 public:
  using key_type = Descriptor;
  using value_type = std::size_t;
  using reference = std::size_t;
  using category = boost::readable_property_map_tag;

  IndexMap() = default;
  explicit IndexMap(const Graph<M>& g) : graph_(&g) {}

  friend std::size_t get(const IndexMap& map, const Descriptor& key) { return map[key]; }
  std::size_t operator[](const Descriptor& key) const {
    if constexpr (std::same_as<Descriptor, GraphEdge>)
      return graph_->number_of(key);
    else if constexpr (std::same_as<Descriptor, GraphHalfedge>)
      return key.number();
    else
      return key.index();
  }

 private:
  const Graph<M>* graph_ = nullptr;
};

template <AnyMesh M>
class EdgeLengthMap {
 public:
  using key_type = GraphEdge;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  EdgeLengthMap() = default;
  explicit EdgeLengthMap(const Graph<M>& g) : graph_(&g) {}

  friend double get(const EdgeLengthMap& map, const GraphEdge& e) { return map[e]; }
  double operator[](const GraphEdge& e) const {
    const M& mesh = graph_->mesh();
    return length(mesh.point(mesh.target(e.first())) - mesh.point(mesh.origin(e.first())));
  }

 private:
  const Graph<M>* graph_ = nullptr;
};

template <AnyMesh M>
IndexMap<M, VertexId> get(boost::vertex_index_t /*tag*/, const Graph<M>& g) {
  return IndexMap<M, VertexId>(g);
}
template <AnyMesh M>
std::size_t get(boost::vertex_index_t /*tag*/, const Graph<M>& /*g*/, VertexId v) {
  return v.index();
}
template <AnyMesh M>
IndexMap<M, GraphEdge> get(boost::edge_index_t /*tag*/, const Graph<M>& g) {
  return IndexMap<M, GraphEdge>(g);
}
template <AnyMesh M>
std::size_t get(boost::edge_index_t tag, const Graph<M>& g, const GraphEdge& e) {
  return get(tag, g)[e];
}
template <AnyMesh M>
EdgeLengthMap<M> get(boost::edge_weight_t /*tag*/, const Graph<M>& g) {
  return EdgeLengthMap<M>(g);
}
template <AnyMesh M>
double get(boost::edge_weight_t tag, const Graph<M>& g, const GraphEdge& e) {
  return get(tag, g)[e];
}

}  // namespace algebra3d::mesh

template <>
struct std::hash<algebra3d::mesh::GraphHalfedge> {
  std::size_t operator()(const algebra3d::mesh::GraphHalfedge& h) const noexcept { return hash_value(h); }
};
template <>
struct std::hash<algebra3d::mesh::GraphEdge> {
  std::size_t operator()(const algebra3d::mesh::GraphEdge& e) const noexcept { return hash_value(e); }
};

namespace boost {

template <algebra3d::mesh::AnyMesh M>
struct graph_traits<algebra3d::mesh::Graph<M>> {
 private:
  using Graph = algebra3d::mesh::Graph<M>;

 public:
  struct traversal_category : virtual bidirectional_graph_tag,
                              virtual vertex_list_graph_tag,
                              virtual edge_list_graph_tag,
                              virtual adjacency_graph_tag {};
  using directed_category = undirected_tag;
  using edge_parallel_category = allow_parallel_edge_tag;

  using vertex_descriptor = algebra3d::VertexId;
  using edge_descriptor = algebra3d::mesh::GraphEdge;
  using halfedge_descriptor = algebra3d::mesh::GraphHalfedge;
  using face_descriptor = algebra3d::FaceId;

  using vertex_iterator = algebra3d::HandleRange<algebra3d::VertexId>::Iterator;
  using face_iterator = algebra3d::HandleRange<algebra3d::FaceId>::Iterator;
  using edge_iterator = algebra3d::CursorIterator<algebra3d::mesh::detail::AllEdgesCursor<M>>;
  using halfedge_iterator = algebra3d::CursorIterator<algebra3d::mesh::detail::AllHalfedgesCursor<M>>;
  using out_edge_iterator = algebra3d::CursorIterator<algebra3d::mesh::detail::EdgesAtCursor<M, true>>;
  using in_edge_iterator = algebra3d::CursorIterator<algebra3d::mesh::detail::EdgesAtCursor<M, false>>;
  using adjacency_iterator = algebra3d::mesh::detail::NeighbourIterator<M>;

  using vertices_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using halfedges_size_type = std::size_t;
  using faces_size_type = std::size_t;
  using degree_size_type = std::size_t;

  static vertex_descriptor null_vertex() { return {}; }
  static halfedge_descriptor null_halfedge() { return {}; }
  static face_descriptor null_face() { return {}; }
};
template <algebra3d::mesh::AnyMesh M>
struct graph_traits<const algebra3d::mesh::Graph<M>> : graph_traits<algebra3d::mesh::Graph<M>> {};

template <algebra3d::mesh::AnyMesh M>
struct property_map<algebra3d::mesh::Graph<M>, vertex_index_t> {
  using type = algebra3d::mesh::IndexMap<M, algebra3d::VertexId>;
  using const_type = type;
};
template <algebra3d::mesh::AnyMesh M>
struct property_map<algebra3d::mesh::Graph<M>, edge_index_t> {
  using type = algebra3d::mesh::IndexMap<M, algebra3d::mesh::GraphEdge>;
  using const_type = type;
};
template <algebra3d::mesh::AnyMesh M>
struct property_map<algebra3d::mesh::Graph<M>, edge_weight_t> {
  using type = algebra3d::mesh::EdgeLengthMap<M>;
  using const_type = type;
};

}  // namespace boost
