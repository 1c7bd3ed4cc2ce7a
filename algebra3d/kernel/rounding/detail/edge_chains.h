#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A chain.
using ChainId = StrongId<struct ChainTag>;

/// A link: a straight part of a chain, from one of its points to the next.
struct ChainLink {
  ChainId chain;
  std::uint32_t index;
};

/// Chains: edges of a mesh that were led through further points, as snap rounding does it, so that they are polylines
/// now. A chain with one link is a straight edge.
class EdgeChains {
 public:
  /// The points must outlive this.
  explicit EdgeChains(const IdVector<PointId, Vec3>& points) : points_(points) {}

  /// Adds a straight edge.
  ChainId add(PointId from, PointId to);

  IdRange<ChainId> ids() const { return chains_.ids(); }
  std::span<const PointId> operator[](ChainId chain) const { return chains_[chain]; }
  std::size_t link_count(ChainId chain) const { return chains_[chain].size() - 1; }
  /// The two ends of a link.
  std::pair<PointId, PointId> ends(ChainLink link) const {
    return {chains_[link.chain][link.index], chains_[link.chain][link.index + 1]};
  }

  /// The distance of a point from the line of a link beside which it lies. Infinite if the point is farther from one
  /// end of the link than the link is long, or is an end of it. Rounded.
  double distance(ChainLink link, PointId point) const;
  /// Adds a pending insertion: the link is to be routed through a point beside it.
  void route_through(ChainLink link, PointId point) { insertions_.push_back({link, point}); }
  /// Applies the pending insertions. Returns the changed chains, ascending.
  std::vector<ChainId> apply();

  /// An upper bound of the distance between the chain and the straight edge.
  double detour(ChainId chain) const { return detours_[chain]; }
  /// The largest detour of all chains; 0 if there are none.
  double largest_detour() const;

 private:
  struct Insertion {
    ChainLink link;
    PointId point;
  };

  void sort_insertions();
  void refine(ChainId id, std::span<const Insertion> insertions);

  const IdVector<PointId, Vec3>& points_;
  IdVector<ChainId, std::vector<PointId>> chains_;
  IdVector<ChainId, double> detours_;
  std::vector<Insertion> insertions_;
};

}  // namespace algebra3d
