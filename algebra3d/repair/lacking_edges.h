#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "algebra3d/repair/facet_list.h"

namespace algebra3d {

/// An edge along which a facet is missing, in the direction in which that would run.
struct LackingEdge {
  std::uint32_t from, to;
  bool is_boundary;           ///< else more than two facets are there, of which more run one way than the other
  bool ends_at_wall = false;  ///< a boundary that leads to edges of more than two facets, and is no loop by itself
  bool is_chord = false;      ///< an edge that lacks nothing, along which a loop may return
  bool is_covered = false;    ///< by facets that were added
};

/// All edges that lack something, so that facets along them would make the surface closed. Without the chords they are
/// closed loops. Cost: linear.
class LackingEdges {
 public:
  explicit LackingEdges(const TriangleMesh& mesh);
  /// Edges between the ends of lacking ones, of two facets that run along them in opposite directions, become chords.
  void add_chords(const TriangleMesh& mesh);

  std::vector<LackingEdge> edges;
  bool has_boundary = false;
  bool has_others = false;

  /// The numbers of edges that lead from the end of the given one back to its start, that one first, by the shortest
  /// way over what is not yet covered, or over boundary edges alone; empty if there are none, or they are too many for
  /// the rim of a hole.
  enum class Way : std::uint8_t { any, boundary };
  std::vector<std::uint32_t> shortest_loop(std::uint32_t start, const std::vector<Vec3>& points,
                                           Way way = Way::any) const;
  /// The number of an edge from the one vertex to the other; kNone if nothing is lacking there.
  std::uint32_t find(std::uint32_t from, std::uint32_t to) const;

  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

 private:
  void add(const LackingEdge& edge);

  std::map<std::uint32_t, std::vector<std::uint32_t>> from_;  // numbers of the edges by their start
};

}  // namespace algebra3d
