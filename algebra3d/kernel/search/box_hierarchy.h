#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/face_order.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/indices.h"
#include "base/large_allocator.h"

namespace algebra3d {

class NodeSlabs;
class OrientedBoxes;

/// An implicit bounding volume hierarchy over triangles of one mesh: triangles along a Hilbert curve, kLeafSize per
/// leaf, and a complete binary tree of boxes over the leaves, in flat arrays without pointers.
///
/// Boxes are floats, scaled to the mesh by a monotonic map (subtract, scale, round), so boxes that touch or overlap
/// still do so afterwards: a query may find too many candidates, never too few, however far from the origin the mesh
/// lies. Immutable after construction and `set_groups`; refers to nothing. Memory: 54 bytes per triangle, 5 more for
/// slabs once they are asked for, and 18 for oriented boxes where there are needles. Deterministic. Source:
/// [lauterbach2009] for the order of the triangles.
class BoxHierarchy {
 public:
  static constexpr std::size_t kLeafSize = 8;

  /// Builds the hierarchy over `faces` of `mesh`. Boxes are enlarged by `margin` on each side, so that boxes of faces
  /// up to two margins apart meet. Cost: linear (radix sort).
  BoxHierarchy(const TriangleMesh& mesh, std::vector<std::uint32_t> faces, double margin = 0);
  /// Builds the hierarchy over all faces. If the mesh knows most of their order (TriangleMesh::face_order), only the
  /// others are sorted; the hierarchy is the same. `margin` as above.
  explicit BoxHierarchy(const TriangleMesh& mesh, double margin = 0);

  std::size_t face_count() const { return faces_.size(); }
  std::size_t leaf_count() const { return (faces_.size() + kLeafSize - 1) / kLeafSize; }
  /// All faces in their order, with their places along the curve; of faces that were not given in ascending order, or
  /// with a margin, this order means nothing to other hierarchies.
  PlacedFace placed(std::size_t i) const { return {places_[i], faces_[i]}; }
  /// Faces of a leaf: at most kLeafSize.
  std::span<const std::uint32_t> leaf_faces(std::size_t leaf) const;

  /// Node `index` of a level has the children 2 `index` and 2 `index` + 1 in the level below, if they exist; those of
  /// level 0 are the leaves.
  struct Node {
    std::uint32_t level, index;

    friend bool operator==(const Node&, const Node&) = default;
  };
  std::uint32_t level_count() const { return static_cast<std::uint32_t>(levels_.size()); }
  std::uint32_t node_count(std::uint32_t level) const {
    return static_cast<std::uint32_t>(levels_[level].boxes.size());
  }
  /// The node over all faces, if there are any.
  Node root() const { return {level_count() - 1, 0}; }

  /// The faces below a node.
  std::span<const std::uint32_t> faces_of(Node node) const;
  /// A box around the faces of a node, slightly larger than the smallest one.
  Box3 bounds(Node node) const { return unscaled(levels_[node.level].boxes[node.index]); }

  using Frame = BoxFrame;
  /// The frame of the boxes.
  const Frame& frame() const { return frame_; }
  /// A box around the faces of a node by its middle and half its sides, in the frame.
  struct Place {
    Vec3 middle, half;

    /// How far the box reaches along a direction from its middle.
    double reach(const Vec3& direction) const {
      return std::abs(direction.x) * half.x + std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
    }
  };
  Place place(Node node) const;
  /// Slabs around the nodes, of the mesh that the hierarchy was built over. Made at the first call, by any thread.
  /// Cost: linear at the first call, some 30 nanoseconds per face.
  const NodeSlabs& slabs(const TriangleMesh& mesh) const;
  /// Like `slabs`, but null until the reported search steps exceed the cost of building them.
  const NodeSlabs* slabs_after(std::size_t steps, const TriangleMesh& mesh) const;
  /// Oriented boxes around the nodes, of the mesh that the hierarchy was built over; null where those along the axes
  /// do. Made at the first call, by any thread. Cost: linear at the first call, some 40 nanoseconds per face.
  const OrientedBoxes* oriented_boxes(const TriangleMesh& mesh) const;

  /// Assigns each leaf a group or kNone. A node whose leaves are all in one group is in that group; `for_each_pair`
  /// skips pairs within a group without enumerating them.
  void set_groups(std::span<const std::uint32_t> leaf_groups);

  /// Calls visit(f, g) once for each pair of different faces whose boxes meet (and for some whose boxes nearly meet),
  /// except pairs in leaves of one group. Ends when it returns false. `pause` is called every few thousand steps and
  /// ends the search when it returns false. The order depends on the mesh only. No recursion.
  template <typename Visit, typename Pause>
  void for_each_pair(Visit visit, Pause pause) const;

  /// Two nodes of one level, whose pairs of faces are a part of that search.
  struct NodePair {
    std::uint32_t level, first, second;
  };
  /// Parts of the search, at least `least` if it has so many, for several threads: one after the other they give the
  /// pairs in the order of for_each_pair.
  std::vector<NodePair> parts_of_search(std::size_t least) const;
  template <typename Visit, typename Pause>
  void for_each_pair(const NodePair& part, Visit visit, Pause pause) const;

  /// The `index`-th of `count` parts of a search, for several threads.
  struct Share {
    std::uint32_t index, count;
  };

  /// Like `for_each_pair`, for pairs of a face of this hierarchy and a face of another one, regardless of groups. Each
  /// pair is in one share, which depends only on the meshes and the number of shares.
  template <typename Visit, typename Pause>
  void for_each_pair_with(const BoxHierarchy& other, Visit visit, Pause pause, Share share = {0, 1}) const {
    for_each_pair_with(
        other, visit, [](Node, Node) { return false; }, pause, share);
  }
  /// As above, but skips the pairs of faces of two nodes for which `are_apart(m, n)` is true, m a node of this
  /// hierarchy, n one of the other.
  template <typename Visit, typename Apart, typename Pause>
  void for_each_pair_with(const BoxHierarchy& other, Visit visit, Apart are_apart, Pause pause, Share share) const;

  /// Calls visit(f, g) for pairs of a face of this hierarchy and a face of another one, near ones first as far as the
  /// boxes show it. It returns a distance: pairs whose boxes are farther from each other are left out from then on, all
  /// at the beginning that are farther apart than `reach`; a negative one ends the search. `are_apart` and `pause` as
  /// above. No recursion. Cost: that of the pairs of nodes within the last distance, and of the way to the first pair.
  template <typename Visit, typename Apart, typename Pause>
  void for_each_near_pair_with(const BoxHierarchy& other, double reach, Visit visit, Apart are_apart,
                               Pause pause) const;

  /// Calls visit(f) for faces near a place (a box around a point), near ones first as far as the boxes show it. It
  /// returns a distance, as above: faces whose boxes are farther from the place are left out from then on, all at the
  /// beginning that are farther than `reach`.
  template <typename Visit>
  void for_each_near(const Box3& where, double reach, Visit visit) const {
    for_each_near(where, reach, no_gap, visit);
  }
  /// As above, with gap(node), a further lower bound of the distance of a node's faces from the place.
  template <typename Gap, typename Visit>
  void for_each_near(const Box3& where, double reach, Gap gap, Visit visit) const;

  /// A lower bound of the distance between a box and the box of each face, in coordinate units: infinite if all are
  /// farther than `reach` or there are no faces. A finite bound is at most some roundings above `reach`. Cost: that of
  /// the nodes within the bound.
  double least_gap(const Box3& where, double reach) const;

  /// A box around all faces, slightly larger than the smallest one; empty without faces.
  Box3 bounds() const;

  /// Calls visit(f) for each face whose box meets `box`, until it returns false.
  template <typename Visit>
  void for_each_meeting(const Box3& box, Visit visit) const;

  /// Calls visit(f) for each face whose box passes a test; `test` is called with a box around that of the face, and
  /// around those of all nodes above it. It must be true for every box around one for which it is true.
  template <typename Test, typename Visit>
  void for_each_where(const Test& test, Visit visit) const;

  /// Calls visit(f) for each face whose box meets the vertical ray from `where` (a box around a point in the mesh's
  /// box), upwards if `upward` is positive, else downwards; `where` itself belongs to the ray.
  template <typename Visit>
  void for_each_on_vertical_ray(const Box3& where, int upward, Visit visit) const;

  /// Calls visit(i, f) for each face whose box meets the ray upwards from point i (a box around it), face by face. The
  /// points go down the hierarchy together, so this is several times as fast as one ray after the other.
  template <typename Visit>
  void for_each_on_upward_rays(std::span<const Box3> points, Visit visit) const;

  /// Calls visit(f) for each face whose box meets the ray upwards from a place, nodes with lower boxes first. It
  /// returns a height (infinite: none); faces whose boxes lie above it are skipped from then on.
  template <typename Visit>
  void for_each_above(const Box3& where, Visit visit) const;

 private:
  /// The fourth numbers are 0, so that each triple fills a SIMD register.
  struct alignas(16) Box {
    std::array<float, 4> min, max;

    bool meets(const Box& other) const;
    void extend(const Box& other);
  };
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  /// The nodes of one level.
  struct Level {
    LargeVector<Box> boxes;
    std::vector<std::uint32_t> groups;  // empty: none
  };

  BoxHierarchy(const TriangleMesh& mesh, std::vector<std::uint32_t> faces, double margin, const FaceOrder* known);
  void choose_scale(const PointArray& points, double margin);
  /// Maps a coordinate to the scaled frame; monotonic.
  float scaled(double coordinate, std::size_t axis) const {
    return static_cast<float>((coordinate / 2 - frame_.origin[axis] / 2) * frame_.scale);
  }
  Box scaled(const Box3& box) const;
  /// A box around all points that `scaled` maps into `box`.
  Box3 unscaled(const Box& box) const;
  /// The map from the frame of another hierarchy to this one: a factor (a power of two) and the position of the other's
  /// origin.
  struct FrameChange {
    std::array<float, 4> factor, shift;
    bool is_known;  ///< false if the frames are too different for floats
  };

  FrameChange change_from(const BoxHierarchy& other) const;
  static Box changed(const FrameChange& change, const Box& box);
  /// Nodes of this hierarchy and of another one, by their indices: all of one level here, and of one level there.
  struct CrossLevel {
    struct Pair {
      std::uint32_t own, other;
    };
    std::uint32_t own_level, other_level;
    std::vector<Pair> pairs = {};  ///< in the order of the search
  };
  /// Which of two nodes are replaced by their children.
  struct Opened {
    bool own, other;
  };
  /// The higher level is opened, or both.
  static Opened opened_below(const CrossLevel& level) {
    return {level.own_level >= level.other_level, level.other_level >= level.own_level};
  }
  /// Without pairs.
  static CrossLevel level_below(const CrossLevel& level, Opened opened) {
    return {level.own_level - (opened.own ? 1U : 0U), level.other_level - (opened.other ? 1U : 0U)};
  }
  /// Pairs of nodes that meet, up to some dozens; together they contain all pairs of faces that meet.
  CrossLevel cross_roots(const BoxHierarchy& other, const FrameChange& change) const;
  /// Boxes of the other hierarchy in the frame of this one, those of the pair before: the next one often has the same.
  struct LastOpened {
    std::uint32_t level = 0, begin = 0, end = 0;
    std::array<Box, 2> boxes{};
  };
  /// Adds to the level below a level the pairs that meet of those that a pair contains.
  void open(const BoxHierarchy& other, const FrameChange& change, CrossLevel::Pair pair, Opened opened,
            CrossLevel& below, LastOpened& last) const;
  /// A leaf of another hierarchy, and the boxes of its faces, in the frame of this one.
  struct ChangedLeaf {
    std::uint32_t index = kNone;
    Box box{};
    std::array<Box, kLeafSize> face_boxes{};
  };
  class ChangedLeaves;
  /// A node of this hierarchy and one of another, whose box is given in the frame of this one; the squared distance of
  /// their boxes.
  struct NearPair {
    Node own, other;
    Box box;
    double squared_gap;
  };
  /// Pushes all pairs of children, the nearest one on top.
  void push_near_children(const BoxHierarchy& other, const FrameChange& change, const NearPair& pair,
                          std::vector<NearPair>& stack) const;
  /// A node, and a lower bound of its squared distance from a place, in this frame.
  struct NearNode : Node {
    double squared_gap;
  };
  /// Pushes the children of an inner node that are within the limit, the nearest one on top.
  template <typename Gap>
  void push_near_children(const Node& node, const Box& where, double limit, Gap gap,
                          std::vector<NearNode>& stack) const;
  static double no_gap(Node) { return 0; }
  /// A lower bound of the squared distance of the faces in the boxes, in this frame.
  static double squared_gap(const Box& own, const Box& other);
  /// The square of a length in coordinate units, in this frame, rounded up.
  double squared_in_frame(double length) const;
  /// Brings the faces into the order of a Hilbert curve; box_of_face(i) is the box of the i-th one before. `known` may
  /// be null; else the faces must be those of the mesh, ascending.
  template <typename BoxOfFace>
  void sort_faces(const BoxOfFace& box_of_face, const FaceOrder* known);
  bool may_take_over(const FaceOrder* known) const;
  /// All faces by their places; placed(i) gives that of the i-th one, with i in place of the face.
  template <typename Placed>
  LargeVector<PlacedFace> sorted(const Placed& placed) const;
  /// All faces by their places, where the places of most are known.
  template <typename Placed>
  LargeVector<PlacedFace> completed(const FaceOrder& known, const Placed& placed) const;
  void build_levels();
  static bool is_one_group(const Level& level, std::uint32_t a, std::uint32_t b) {
    return !level.groups.empty() && level.groups[a] != kNone && level.groups[a] == level.groups[b];
  }
  void push_children(NodePair pair, std::vector<NodePair>& stack) const;
  /// Pushes the children of an inner node, the one with the lower box last.
  void push_from_highest(const Node& node, std::vector<Node>& stack) const;
  /// Writes to `positions` the positions of the leaf's faces whose boxes meet `box`.
  std::span<const std::uint32_t> reaching(std::size_t leaf, const Box& box,
                                          std::array<std::uint32_t, kLeafSize>& positions) const;
  template <typename Visit>
  bool visit_hits(std::size_t face, std::span<const std::uint32_t> others, Visit& visit) const;
  template <typename Visit>
  bool visit_leaf_pair(std::size_t a, std::size_t b, Visit& visit) const;
  template <typename Visit>
  bool visit_leaf(std::size_t leaf, Visit& visit) const;
  template <typename Visit>
  bool visit_cross_leaves(std::uint32_t leaf, const ChangedLeaf& of_other, std::span<const std::uint32_t> other_faces,
                          Visit& visit) const;
  /// Appends to the first `end` of `reaching` those from `begin` on whose windows meet the box. Returns the new end.
  static std::size_t filter_windows(std::span<const Box> windows, const Box& box, std::size_t begin, std::size_t end,
                                    std::vector<std::uint32_t>& reaching);
  /// Calls visit(f) for each face whose box meets the window, until it returns false.
  template <typename Visit>
  void visit_window(const Box& window, Visit& visit) const;

  struct LazyBounds;

  Frame frame_;
  std::vector<std::uint32_t> faces_;   // along a Hilbert curve
  std::vector<std::uint32_t> places_;  // parallel to faces_: on the curve
  LargeVector<Box> face_boxes_;        // parallel to faces_
  std::vector<Level> levels_;          // [0]: the leaves; the last has one node
  std::shared_ptr<LazyBounds> lazy_;
};

inline bool BoxHierarchy::Box::meets(const Box& other) const {
#ifdef __SSE2__
  const __m128 below = _mm_cmple_ps(_mm_load_ps(min.data()), _mm_load_ps(other.max.data()));
  const __m128 above = _mm_cmple_ps(_mm_load_ps(other.min.data()), _mm_load_ps(max.data()));
  return _mm_movemask_ps(_mm_and_ps(below, above)) == 0xF;
#else
  // No short-circuit evaluation: the result is unpredictable, and six comparisons cost less than a branch
  // misprediction.
  return (min[0] <= other.max[0]) & (other.min[0] <= max[0]) & (min[1] <= other.max[1]) & (other.min[1] <= max[1]) &
         (min[2] <= other.max[2]) & (other.min[2] <= max[2]);
#endif
}

inline void BoxHierarchy::Box::extend(const Box& other) {
#ifdef __SSE2__
  _mm_store_ps(min.data(), _mm_min_ps(_mm_load_ps(other.min.data()), _mm_load_ps(min.data())));
  _mm_store_ps(max.data(), _mm_max_ps(_mm_load_ps(other.max.data()), _mm_load_ps(max.data())));
#else
  for (std::size_t axis = 0; axis < 4; ++axis) {
    min[axis] = std::min(min[axis], other.min[axis]);
    max[axis] = std::max(max[axis], other.max[axis]);
  }
#endif
}

inline BoxHierarchy::Place BoxHierarchy::place(Node node) const {
  // The largest change of a coordinate of this frame by rounding to float.
  constexpr double kRounding = 0x1p-4;
  const Box& box = levels_[node.level].boxes[node.index];
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.middle[axis] = 0.5 * (double{box.min[axis]} + double{box.max[axis]});
    place.half[axis] = 0.5 * (double{box.max[axis]} - double{box.min[axis]}) + kRounding;
  }
  return place;
}

/// A box in this frame around what the other frame's box stands for. Both frames round to float, by 2^-24 of the
/// number, and so do the shift and the sum: the margin covers these and its own roundings. Frames that are too
/// different give a box without bounds.
inline BoxHierarchy::Box BoxHierarchy::changed(const FrameChange& change, const Box& box) {
  Box result{};
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const float min = box.min[axis] * change.factor[axis], max = box.max[axis] * change.factor[axis];
    const float shift = change.shift[axis], size = std::abs(shift);
    result.min[axis] = min + shift - ((std::abs(min) + size) * 0x1p-20F + 0x1p-100F);
    result.max[axis] = max + shift + ((std::abs(max) + size) * 0x1p-20F + 0x1p-100F);
  }
  if (change.is_known) return result;
  result.min.fill(-kInfinity);
  result.max.fill(kInfinity);
  return result;
}

inline std::span<const std::uint32_t> BoxHierarchy::reaching(std::size_t leaf, const Box& box,
                                                             std::array<std::uint32_t, kLeafSize>& positions) const {
  const std::size_t begin = leaf * kLeafSize, end = std::min(begin + kLeafSize, faces_.size());
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    positions[count] = static_cast<std::uint32_t>(i);
    count += static_cast<std::size_t>(box.meets(face_boxes_[i]));
  }
  return std::span(positions).first(count);
}

template <typename Visit>
bool BoxHierarchy::visit_hits(std::size_t face, std::span<const std::uint32_t> others, Visit& visit) const {
  // First all comparisons, then all visits, so that no unpredictable branch is needed.
  std::array<std::uint32_t, kLeafSize> hits{};
  std::size_t hit_count = 0;
  const Box box = face_boxes_[face];
  for (const std::uint32_t other : others) {
    hits[hit_count] = other;
    hit_count += static_cast<std::size_t>(box.meets(face_boxes_[other]));
  }
  for (std::size_t k = 0; k < hit_count; ++k)
    if (!visit(faces_[face], faces_[hits[k]])) return false;
  return true;
}

template <typename Visit>
bool BoxHierarchy::visit_leaf(std::size_t leaf, Visit& visit) const {
  const std::size_t begin = leaf * kLeafSize, count = leaf_faces(leaf).size();
  std::array<std::uint32_t, kLeafSize> positions{};
  for (std::size_t i = 0; i < count; ++i) positions[i] = static_cast<std::uint32_t>(begin + i);
  for (std::size_t i = 0; i + 1 < count; ++i)
    if (!visit_hits(begin + i, std::span(positions).subspan(i + 1, count - i - 1), visit)) return false;
  return true;
}

template <typename Visit>
bool BoxHierarchy::visit_leaf_pair(std::size_t a, std::size_t b, Visit& visit) const {
  // Few triangles of a leaf reach into the box of the other; only those are paired.
  std::array<std::uint32_t, kLeafSize> from_a{}, from_b{};
  const std::span<const std::uint32_t> reaching_a = reaching(a, levels_[0].boxes[b], from_a);
  const std::span<const std::uint32_t> reaching_b = reaching(b, levels_[0].boxes[a], from_b);
  if (reaching_b.empty()) return true;
  for (const std::uint32_t i : reaching_a)
    if (!visit_hits(i, reaching_b, visit)) return false;
  return true;
}

template <typename Visit, typename Pause>
void BoxHierarchy::for_each_pair(Visit visit, Pause pause) const {
  if (!faces_.empty()) for_each_pair({static_cast<std::uint32_t>(levels_.size() - 1), 0, 0}, visit, pause);
}

template <typename Visit, typename Pause>
void BoxHierarchy::for_each_pair(const NodePair& part, Visit visit, Pause pause) const {
  std::vector<NodePair> stack{part};
  std::uint32_t steps = 0;
  while (!stack.empty()) {
    const NodePair pair = stack.back();
    stack.pop_back();
    if (++steps % 4096 == 0 && !pause()) return;
    if (pair.level > 0) {
      push_children(pair, stack);
    } else if (pair.first == pair.second) {
      if (!visit_leaf(pair.first, visit)) return;
    } else {
      if (!visit_leaf_pair(pair.first, pair.second, visit)) return;
    }
  }
}

template <typename Visit>
void BoxHierarchy::visit_window(const Box& window, Visit& visit) const {
  if (faces_.empty()) return;
  // Depth-first search: at most one sibling of each level waits.
  std::array<Node, 40> stack;  // NOLINT(cppcoreguidelines-pro-type-member-init): as far as it is used
  std::size_t waiting = 0;
  stack[waiting++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
  while (waiting > 0) {
    const Node node = stack[--waiting];
    if (!levels_[node.level].boxes[node.index].meets(window)) continue;
    if (node.level > 0) {
      const auto child_count = static_cast<std::uint32_t>(levels_[node.level - 1].boxes.size());
      for (std::uint32_t child = std::min(2 * node.index + 2, child_count); child-- > 2 * node.index;)
        stack[waiting++] = {node.level - 1, child};
      continue;
    }
    const std::size_t begin = node.index * kLeafSize, end = std::min(begin + kLeafSize, faces_.size());
    for (std::size_t i = begin; i < end; ++i)
      if (face_boxes_[i].meets(window) && !visit(faces_[i])) return;
  }
}

template <typename Visit>
void BoxHierarchy::for_each_meeting(const Box3& box, Visit visit) const {
  visit_window(scaled(box), visit);
}

template <typename Test, typename Visit>
void BoxHierarchy::for_each_where(const Test& test, Visit visit) const {
  if (faces_.empty()) return;
  std::vector<Node> stack{{static_cast<std::uint32_t>(levels_.size() - 1), 0}};
  while (!stack.empty()) {
    const Node node = stack.back();
    stack.pop_back();
    if (!test(unscaled(levels_[node.level].boxes[node.index]))) continue;
    if (node.level > 0) {
      const auto child_count = static_cast<std::uint32_t>(levels_[node.level - 1].boxes.size());
      for (std::uint32_t child = std::min(2 * node.index + 2, child_count); child-- > 2 * node.index;)
        stack.push_back({node.level - 1, child});
      continue;
    }
    const std::size_t begin = node.index * kLeafSize, end = std::min(begin + kLeafSize, faces_.size());
    for (std::size_t i = begin; i < end; ++i)
      if (test(unscaled(face_boxes_[i]))) visit(faces_[i]);
  }
}

template <typename Visit>
void BoxHierarchy::for_each_on_vertical_ray(const Box3& where, int upward, Visit visit) const {
  Box window = scaled(where);
  (upward > 0 ? window.max : window.min)[2] = upward > 0 ? kInfinity : -kInfinity;
  const auto visit_all = [&](std::uint32_t face) {
    visit(face);
    return true;
  };
  visit_window(window, visit_all);
}

template <typename Visit>
void BoxHierarchy::for_each_on_upward_rays(std::span<const Box3> points, Visit visit) const {
  if (faces_.empty() || points.empty()) return;
  std::vector<Box> windows(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    windows[i] = scaled(points[i]);
    windows[i].max[2] = kInfinity;
  }
  // The points that reach a node, after those that reach its parent. Of a waiting node the points of the parent are
  // kept.
  struct Waiting {
    Node node;
    std::size_t begin, end;
  };
  std::vector<std::uint32_t> reaching(points.size());
  for (std::uint32_t i = 0; i < reaching.size(); ++i) reaching[i] = i;
  std::vector<Waiting> stack{{{static_cast<std::uint32_t>(levels_.size() - 1), 0}, 0, reaching.size()}};
  while (!stack.empty()) {
    const auto [node, begin, end] = stack.back();
    stack.pop_back();
    const std::size_t size = filter_windows(windows, levels_[node.level].boxes[node.index], begin, end, reaching);
    if (size == end) continue;
    if (node.level > 0) {
      const auto child_count = static_cast<std::uint32_t>(levels_[node.level - 1].boxes.size());
      for (std::uint32_t child = std::min(2 * node.index + 2, child_count); child-- > 2 * node.index;)
        stack.push_back({{node.level - 1, child}, end, size});
      continue;
    }
    const std::size_t first = node.index * kLeafSize, last = std::min(first + kLeafSize, faces_.size());
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = end; k < size; ++k)
        if (face_boxes_[i].meets(windows[reaching[k]])) visit(reaching[k], faces_[i]);
  }
}

template <typename Visit>
void BoxHierarchy::for_each_above(const Box3& where, Visit visit) const {
  if (faces_.empty()) return;
  Box window = scaled(where);
  window.max[2] = kInfinity;
  std::vector<Node> stack{{static_cast<std::uint32_t>(levels_.size() - 1), 0}};
  while (!stack.empty()) {
    const Node node = stack.back();
    stack.pop_back();
    if (!levels_[node.level].boxes[node.index].meets(window)) continue;
    if (node.level > 0) {
      push_from_highest(node, stack);
      continue;
    }
    const std::size_t begin = node.index * kLeafSize, end = std::min(begin + kLeafSize, faces_.size());
    for (std::size_t i = begin; i < end; ++i) {
      if (!face_boxes_[i].meets(window)) continue;
      const double height = visit(faces_[i]);
      if (height < Box3::kInfinity) window.max[2] = scaled(height, 2);
    }
  }
}

}  // namespace algebra3d

#include "algebra3d/kernel/search/detail/cross_search.h"  // for_each_pair_with
#include "algebra3d/kernel/search/detail/near_search.h"   // for_each_near, for_each_near_pair_with
