#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d::arrangement {

/// Slabs around a small operand, each between two planes parallel to one of its facets: a discrete orientation polytope
/// whose directions are those of the facets. Finds faces of a large operand, and nodes of its hierarchy, that miss the
/// small one. The box along the axes around a rod that lies aslant is hundreds of times as large as the rod; its slabs
/// are the rod itself.
///
/// For one search by one thread. Refers to the large operand. Source: [klosowski1998], with directions by operand.
class FacetSlabs {
 public:
  /// Without slabs unless the first operand is small, the other one large, and some facet of the small one aslant.
  /// Cost: linear in the small operand.
  FacetSlabs(const TriangleMesh& small, const BoxHierarchy& of_small, const TriangleMesh& large,
             const BoxHierarchy& of_large);

  /// True if all faces of a node of the large operand's hierarchy certainly miss the small operand. Rounded arithmetic
  /// with bounds. Cost: some nanoseconds per slab.
  bool miss(BoxHierarchy::Node node) const { return !slabs_.empty() && are_beyond(node); }
  /// True if a face of the large operand certainly misses the small operand; the answer is cached for some time.
  bool misses(std::uint32_t face) {
    if (slabs_.empty()) return false;
    Known& known = known_[face % known_.size()];
    if (known.face != face) known = {face, is_beyond(face)};
    return known.does_miss;
  }

 private:
  /// In the frame of the large operand's hierarchy. Products of the small operand's points with the normal, of length
  /// 1, are from `low` to `high`, which are rounded outward by more than the products of others are rounded.
  struct Slab {
    Vec3 normal;
    double low, high;
  };
  /// The last face with its remainder, and whether it misses.
  struct Known {
    std::uint32_t face = BoxHierarchy::kNoGroup;
    bool does_miss = false;
  };

  void add_slab(const Vec3& normal, const std::vector<Vec3>& places, double error);
  bool are_beyond(BoxHierarchy::Node node) const;
  bool is_beyond(std::uint32_t face) const;

  const TriangleMesh& mesh_;
  const BoxHierarchy& hierarchy_;
  std::vector<Slab> slabs_;
  std::array<Known, 64> known_;
};

}  // namespace algebra3d::arrangement
