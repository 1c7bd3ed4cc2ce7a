#pragma once

#include <cstdint>
#include <map>
#include <memory_resource>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/facets.h"
#include "algebra3d/arrangement/vertex_pool.h"
#include "algebra3d/exact/intersection_point.h"

namespace algebra3d::arrangement {

/// How a segment lies in a facet that holds it: the facet is on both sides, or only to the left or right, seen from the
/// front of the facet's plane by someone who walks from the first end to the second.
enum class Side : std::uint8_t { both, left, right };

/// A facet that holds a segment.
struct Incidence {
  std::uint32_t segment;
  std::uint32_t facet;
  Side side;
};

/// A straight line between two vertices: an edge of an operand that bounds a facet, or a common part of two facets.
/// There is one between the same two vertices, however many edges and common parts it is.
struct Segment {
  std::uint32_t from, to;  ///< vertices
  std::uint32_t edge;      ///< half-edge that stands for some operand's edge here; kNone if there is none
};

/// Where an edge of an operand meets a plane.
struct EdgeAndPlane {
  std::uint32_t edge, plane;
};

/// All lines of an arrangement before they are cut at one another: segments, the facets that hold each, and the
/// vertices at which each has to be cut. A segment is one object for all planes in which it lies, so a cut that one
/// plane finds is there in all.
class Skeleton {
 public:
  Skeleton(const Operands& operands, Facets& facets) : operands_(operands), facets_(facets) {}

  /// The vertex at the origin of the half-edge.
  std::uint32_t corner(std::uint32_t halfedge);
  /// The vertex that three planes have in common.
  std::uint32_t crossing_of_planes(std::uint32_t p, std::uint32_t q, std::uint32_t r);
  /// The vertex in which the edge of an operand meets the plane.
  std::uint32_t crossing_of_plane(const EdgeAndPlane& where);
  /// Computes the points in which edges meet planes, with two threads if they are many. They become vertices once they
  /// are asked for.
  void compute_crossings(std::span<const EdgeAndPlane> wanted);

  /// The vertex in which two edges of operands cross that lie in one plane.
  std::uint32_t crossing_of_edges(std::uint32_t edge, std::uint32_t other, Projection projection);

  /// The segment of a boundary edge of some facet, which is added if it is new.
  std::uint32_t edge_segment(std::uint32_t edge);
  /// A common part of two facets. Gives the number of its segment, which is added if it is new.
  std::uint32_t add_contact(std::uint32_t from, std::uint32_t to, std::uint32_t facet, std::uint32_t other);
  /// A vertex of a facet in which some other facet touches it.
  void add_touch(std::uint32_t facet, std::uint32_t vertex) { touches_.emplace_back(facet, vertex); }
  void cut(std::uint32_t segment, std::uint32_t vertex) { cuts_.emplace_back(segment, vertex); }
  /// The two segments lie on one line and may overlap: where one is cut, so is the other.
  void note_one_line(std::uint32_t a, std::uint32_t b) {
    if (a != b) one_line_.emplace_back(a, b);
  }
  /// Adds the boundaries of all facets. Their planes must be numbered.
  void add_boundaries();

  /// The plane of a facet that is on the segment, a common part of facets, with the plane.
  std::uint32_t other_plane(std::uint32_t segment, std::uint32_t plane) const;

  const Operands& operands() const { return operands_; }
  const Facets& facets() const { return facets_; }
  const VertexPool& vertices() const { return vertices_; }
  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Incidence>& incidences() const { return incidences_; }
  /// The exact point half-way between two vertices.
  ExactPoint middle(std::uint32_t u, std::uint32_t v) const {
    return ExactPoint(Rational(1, 2) * (vertices_[u].rational() + vertices_[v].rational()));
  }
  /// Pairs (segment, vertex), in no order, repeated ones possible.
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& cuts() { return cuts_; }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& one_line() const { return one_line_; }
  /// Pairs (facet, vertex).
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& touches() const { return touches_; }
  /// The vertices that corners of operands became, by number of the operands' vertices.
  const std::pmr::unordered_map<std::uint32_t, std::uint32_t>& corners() const { return corners_; }
  VertexPool& vertices() { return vertices_; }

 private:
  struct Crossing {
    std::optional<ExactPoint> point;
    std::uint32_t vertex = kNone;
  };

  static std::uint64_t key(const EdgeAndPlane& where) { return std::uint64_t{where.edge} << 32U | where.plane; }
  ExactPoint meeting_point(const EdgeAndPlane& where);
  std::uint32_t segment_between(std::uint32_t from, std::uint32_t to);

  const Operands& operands_;
  Facets& facets_;
  VertexPool vertices_;
  std::vector<Segment> segments_;
  std::vector<Incidence> incidences_;
  std::vector<std::uint32_t> first_incidences_;  // of each segment that was first a common part; else kNone
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts_, touches_, one_line_;
  std::pmr::monotonic_buffer_resource memory_;  // of the maps, which only grow
  using Numbers = std::pmr::unordered_map<std::uint32_t, std::uint32_t>;
  Numbers corners_{&memory_};                                                         // operand vertex -> vertex
  Numbers edge_segments_{&memory_};                                                   // edge -> segment
  std::pmr::unordered_map<std::uint64_t, std::uint32_t> segments_between_{&memory_};  // lower, higher end -> segment
  std::pmr::unordered_map<std::uint64_t, Crossing> crossings_{&memory_};              // edge, plane -> what is there
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> plane_crossings_;
};

}  // namespace algebra3d::arrangement
