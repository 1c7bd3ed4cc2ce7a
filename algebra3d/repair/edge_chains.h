#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// A straight piece of an edge: from one vertex of its chain to the next.
struct ChainLink {
  std::uint32_t edge, index;
};

/// Edges between points that are led through further points: each is a chain of vertices.
class EdgeChains {
 public:
  explicit EdgeChains(std::span<const Vec3> points) : points_(points) {}

  /// Adds the straight edge and gives its number.
  std::uint32_t add(std::uint32_t from, std::uint32_t to);

  std::size_t size() const { return chains_.size(); }
  std::span<const std::uint32_t> operator[](std::uint32_t edge) const { return chains_[edge]; }
  bool is_straight(std::uint32_t edge) const { return chains_[edge].size() == 2; }
  std::pair<std::uint32_t, std::uint32_t> ends(ChainLink link) const {
    return {chains_[link.edge][link.index], chains_[link.edge][link.index + 1]};
  }

  /// The distance of a vertex from a link beside which it lies; infinite if one of its ends is farther from the vertex
  /// than from the other end, or the vertex is an end. Rounded.
  double distance(ChainLink link, std::uint32_t vertex) const;
  /// Remembers that the link is to be led through the vertex, which lies beside it.
  void lead_through(ChainLink link, std::uint32_t vertex) { wishes_.push_back({link, vertex}); }
  /// Does what was remembered, and gives the edges that have changed, ascending.
  std::vector<std::uint32_t> apply();

  /// The edge is no farther than this from the straight line between its ends.
  double detour(std::uint32_t edge) const { return detours_[edge]; }
  double largest_detour() const;

 private:
  struct Wish {
    ChainLink link;
    std::uint32_t vertex;
  };

  void refine(std::uint32_t edge, std::span<const Wish> wishes);

  std::span<const Vec3> points_;
  std::vector<std::vector<std::uint32_t>> chains_;
  std::vector<double> detours_;
  std::vector<Wish> wishes_;
};

}  // namespace algebra3d
