// Why a seed per component decides about sets whose boundaries do not meet.
//
// If the boundaries of two sets have no point in common, each connected component of one boundary is inside the other
// set as a whole, or outside. If the sets have a common point, take the boundary of that component of their common part
// which holds it: it is part of one of the two boundaries, so the component of the boundary there lies in the other
// set, and with it the seed. Edge-connected components that touch each other in a vertex have a seed each, which does
// no harm.
#include "algebra3d/values/spatial_relations/block_relations.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// A block in the list of a set.
using BlockId = StrongId<struct FaceBlockKind>;
using BlockIds = std::vector<BlockId>;

/// True for boxes that are certainly farther apart than a distance, whatever was rounded.
bool are_farther(const Box3& a, const Box3& b, double limit) {
  constexpr double kMargin = 0x1p-40, kSmallest = 0x1p-1070;
  return distance(a, b) * (1 - kMargin) > limit + kSmallest;
}

/// Boxes around the blocks of a set and around 2, 4, 8 ... neighbours of them; a set in memory is one block.
class BlockTree {
 public:
  explicit BlockTree(const BlockedSet& set) {
    std::vector<Box3> boxes;
    if (set.blocks == nullptr)
      boxes.push_back(set.box);
    else
      for (const FaceBlockList::Block& block : set.blocks->list().blocks) boxes.push_back(block.box);
    levels_.push_back(std::move(boxes));
    while (levels_.back().size() > 1) {
      const std::vector<Box3>& below = levels_.back();
      std::vector<Box3> level((below.size() + 1) / 2);
      for (std::size_t i = 0; i < below.size(); ++i) level[i / 2].extend(below[i]);
      levels_.push_back(std::move(level));
    }
  }

  struct Node {
    std::size_t level, index;
  };
  Node root() const { return {levels_.size() - 1, 0}; }
  const Box3& box(const Node& node) const { return levels_[node.level][node.index]; }
  const std::vector<Box3>& blocks() const { return levels_.front(); }
  /// Calls visit(child) for the one or two children of an inner node.
  template <typename Visit>
  void for_each_child(const Node& node, Visit visit) const {
    const std::size_t end = std::min(2 * node.index + 2, levels_[node.level - 1].size());
    for (std::size_t i = 2 * node.index; i < end; ++i) visit(Node{node.level - 1, i});
  }

 private:
  std::vector<std::vector<Box3>> levels_;
};

struct BlockPair {
  BlockId first, second;
};

/// The pairs of blocks that may be so near to each other.
std::vector<BlockPair> near_pairs(const BlockTree& a, const BlockTree& b, double limit) {
  struct Waiting {
    BlockTree::Node first, second;
  };
  std::vector<BlockPair> pairs;
  std::vector<Waiting> stack{{a.root(), b.root()}};
  for (std::size_t step = 0; !stack.empty(); ++step) {
    poll_interruption_at(step);
    const auto [first, second] = stack.back();
    stack.pop_back();
    if (are_farther(a.box(first), b.box(second), limit)) continue;
    if (first.level == 0 && second.level == 0)
      pairs.push_back({BlockId(first.index), BlockId(second.index)});
    else if (first.level >= second.level)
      a.for_each_child(first, [&, other = second](const BlockTree::Node& child) { stack.push_back({child, other}); });
    else
      b.for_each_child(second, [&, other = first](const BlockTree::Node& child) { stack.push_back({other, child}); });
  }
  return pairs;
}

/// The blocks of one side of pairs, each once, in ascending order.
BlockIds blocks_of(std::span<const BlockPair> pairs, BlockId BlockPair::*side) {
  BlockIds blocks;
  for (const BlockPair& pair : pairs) blocks.push_back(pair.*side);
  std::ranges::sort(blocks);
  blocks.erase(std::ranges::unique(blocks).begin(), blocks.end());
  return blocks;
}

/// As the blocks of a set are asked for.
std::vector<std::uint32_t> indices_of(std::span<const BlockId> blocks) {
  std::vector<decltype(BlockId().index())> indices;
  for (const BlockId block : blocks) indices.push_back(block.index());
  return indices;
}

std::size_t face_count(const BlockedSet& set, std::span<const BlockId> blocks) {
  return set.blocks == nullptr ? 0 : set.blocks->face_count(indices_of(blocks));
}

/// True if reading these blocks costs about as much as loading the sets.
bool are_too_many(const BlockedSet& a, const BlockIds& of_a, const BlockedSet& b, const BlockIds& of_b) {
  constexpr std::size_t kPart = 4;
  std::size_t all = 0;
  for (const BlockedSet* const set : {&a, &b})
    if (set->blocks != nullptr)
      for (const FaceBlockList::Block& block : set->blocks->list().blocks) all += block.face_count;
  return (face_count(a, of_a) + face_count(b, of_b)) * kPart > all;
}

/// The faces of some blocks as a surface, or the set in memory.
Result<SpatialSet> part_of(const BlockedSet& set, std::span<const BlockId> blocks) {
  if (set.blocks == nullptr) return *set.in_memory;
  A3D_ASSIGN(TriangleMesh mesh, set.blocks->faces(indices_of(blocks)));
  return SpatialSet(Surface3d::trusted(std::move(mesh)));
}

/// The answer of ask(part of a, part of b).
template <typename Ask>
auto ask_parts(const BlockedSet& a, std::span<const BlockId> of_a, const BlockedSet& b, std::span<const BlockId> of_b,
               const Ask& ask) -> decltype(ask(std::declval<SpatialSet>(), std::declval<SpatialSet>())) {
  A3D_ASSIGN(const SpatialSet first, part_of(a, of_a));
  A3D_ASSIGN(const SpatialSet second, part_of(b, of_b));
  return ask(first, second);
}

/// A vertex of each component of the boundary of a surface or solid.
std::vector<ExactPoint> seeds_of(const Geometry& geometry) {
  std::vector<ExactPoint> seeds;
  const EdgeComponents& components = geometry.components();
  for (std::size_t i = 0; i < components.count(); ++i) {
    const FaceId first = components.first_face(EdgeComponentId(i));
    seeds.push_back(geometry.mesh.points().point(geometry.mesh.triangle(first)[0]));
  }
  return seeds;
}
std::vector<ExactPoint> seeds_of(const BlockedSet& set) {
  if (set.blocks != nullptr) return set.blocks->list().seeds;
  if (const auto* points = std::get_if<PointSet>(&*set.in_memory))
    return {points->points.begin(), points->points.end()};
  if (const auto* box = std::get_if<Box3>(&*set.in_memory)) return {ExactPoint(box->min)};
  if (const auto* surface = std::get_if<Surface3d>(&*set.in_memory)) return seeds_of(surface->geometry());
  return seeds_of(std::get<Volume3d>(*set.in_memory).geometry());
}

/// Whether one of some points is in a solid in blocks; nothing if these are too many points or faces.
Result<std::optional<bool>> has_one_of(const BlockedSet& solid, const std::vector<ExactPoint>& points) {
  if (points.size() > kMostSeeds) return std::optional<bool>();
  const std::vector<FaceBlockList::Block>& blocks = solid.blocks->list().blocks;
  for (const ExactPoint& point : points) {
    poll_interruption();
    Box3 ray = box_of(point);
    if (!ray.intersects(solid.box)) continue;
    ray.max.z = Box3::kInfinity;
    BlockIds above;
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (blocks[i].box.intersects(ray)) above.emplace_back(i);
    A3D_ASSIGN(const TriangleMesh faces, solid.blocks->faces(indices_of(above)));
    if (place_by_faces_above(point, faces) != Placement::outside) return std::optional(true);
  }
  return std::optional(false);
}

/// Whether one of two sets has a seed of the other; nothing if there are too many.
Result<std::optional<bool>> do_enclose(const BlockedSet& a, const BlockedSet& b) {
  for (const auto& [outer, inner] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    if (outer->blocks == nullptr || !outer->is_solid) continue;
    A3D_ASSIGN(const std::optional<bool> has_seed, has_one_of(*outer, seeds_of(*inner)));
    if (!has_seed.has_value() || *has_seed) return has_seed;
  }
  return std::optional(false);
}

/// Some of many pairs, at equal distances in their order.
std::vector<BlockPair> sample_of(std::span<const BlockPair> pairs, std::size_t count) {
  std::vector<BlockPair> sample;
  for (std::size_t i = 0; i < count; ++i) sample.push_back(pairs[i * pairs.size() / count]);
  return sample;
}

/// Whether faces of some pairs of blocks meet; a set in memory is taken as it is, with its inside.
Result<bool> do_faces_meet(const BlockedSet& a, const BlockedSet& b, std::span<const BlockPair> pairs,
                           const Monitor& monitor) {
  return ask_parts(a, blocks_of(pairs, &BlockPair::first), b, blocks_of(pairs, &BlockPair::second),
                   [&](const SpatialSet& first, const SpatialSet& second) { return do_meet(first, second, monitor); });
}

/// The block that is nearest to a box.
BlockId nearest_block(const BlockTree& tree, const Box3& box) {
  const std::vector<Box3>& blocks = tree.blocks();
  const auto nearest =
      std::ranges::min_element(blocks, {}, [&](const Box3& block) { return squared_distance(block, box); });
  return BlockId(nearest - blocks.begin());
}

/// An upper bound of the distance: that of two blocks that are near each other.
Result<double> reach_of(const BlockedSet& a, const BlockTree& tree_a, const BlockedSet& b, const BlockTree& tree_b,
                        const Monitor& monitor) {
  BlockId first = nearest_block(tree_a, b.box);
  const BlockId second = nearest_block(tree_b, tree_a.blocks()[first.index()]);
  first = nearest_block(tree_a, tree_b.blocks()[second.index()]);
  A3D_ASSIGN(const auto square,
             ask_parts(a, {&first, 1}, b, {&second, 1}, [&](const SpatialSet& one, const SpatialSet& other) {
               return squared_distance_of(one, other, monitor);
             }));
  return square ? square->nearest_root() * (1 + 0x1p-40) + 0x1p-1070 : Box3::kInfinity;
}

}  // namespace

BlockedSet::BlockedSet(SpatialSet set, const Box3& bounds) : in_memory(std::move(set)), box(bounds) {}

BlockedSet::BlockedSet(const FaceBlocks& its_blocks, bool bounds_solid) : blocks(&its_blocks), is_solid(bounds_solid) {
  for (const FaceBlockList::Block& block : its_blocks.list().blocks) box.extend(block.box);
}

Result<std::optional<bool>> do_meet_by_blocks(const BlockedSet& a, const BlockedSet& b, const Monitor& monitor) {
  if (!a.box.intersects(b.box)) return std::optional(false);
  const std::vector<BlockPair> pairs = near_pairs(BlockTree(a), BlockTree(b), 0);
  // Sets that meet mostly do so in many places.
  constexpr std::size_t kSample = 16;
  if (pairs.size() > 4 * kSample) {
    A3D_ASSIGN(const bool sample_meets, do_faces_meet(a, b, sample_of(pairs, kSample), monitor));
    if (sample_meets) return std::optional(true);
  }
  if (are_too_many(a, blocks_of(pairs, &BlockPair::first), b, blocks_of(pairs, &BlockPair::second)))
    return std::optional<bool>();
  if (!pairs.empty()) {
    A3D_ASSIGN(const bool faces_meet, do_faces_meet(a, b, pairs, monitor));
    if (faces_meet) return std::optional(true);
  }
  return do_enclose(a, b);
}

Result<std::optional<Rational>> squared_distance_by_blocks(const BlockedSet& a, const BlockedSet& b,
                                                           const Monitor& monitor) {
  A3D_ASSIGN(const std::optional<bool> meet, do_meet_by_blocks(a, b, monitor));
  if (!meet) return std::optional<Rational>();
  if (*meet) return std::optional(Rational(0));
  const BlockTree tree_a(a), tree_b(b);
  A3D_ASSIGN(const double reach, reach_of(a, tree_a, b, tree_b, monitor));
  const std::vector<BlockPair> pairs = near_pairs(tree_a, tree_b, reach);
  const BlockIds of_a = blocks_of(pairs, &BlockPair::first), of_b = blocks_of(pairs, &BlockPair::second);
  if (are_too_many(a, of_a, b, of_b)) return std::optional<Rational>();
  return ask_parts(a, of_a, b, of_b, [&](const SpatialSet& first, const SpatialSet& second) {
    return squared_distance_of(first, second, monitor);
  });
}

Result<std::optional<bool>> are_within_by_blocks(const BlockedSet& a, const BlockedSet& b, double distance,
                                                 const Monitor& monitor) {
  if (distance < 0) return std::optional(false);
  const std::vector<BlockPair> pairs = near_pairs(BlockTree(a), BlockTree(b), distance);
  if (!pairs.empty()) {
    const BlockIds of_a = blocks_of(pairs, &BlockPair::first), of_b = blocks_of(pairs, &BlockPair::second);
    if (are_too_many(a, of_a, b, of_b)) return std::optional<bool>();
    A3D_ASSIGN(const bool are_near, ask_parts(a, of_a, b, of_b, [&](const SpatialSet& first, const SpatialSet& second) {
                 return are_within(first, second, Rational(distance), monitor);
               }));
    if (are_near) return std::optional(true);
  }
  return do_enclose(a, b);
}

}  // namespace algebra3d
