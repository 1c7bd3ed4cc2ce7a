#include "algebra3d/kernel/search/box_hierarchy.h"

#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/search/detail/curve_order.h"
#include "algebra3d/kernel/search/node_slabs.h"
#include "algebra3d/kernel/search/oriented_boxes.h"
#include "base/hilbert.h"
#include "base/interruption_scope.h"
#include "base/next_number.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Faces or points of one task.
constexpr std::size_t kFacesPerTask = 10000;

/// A box that reaches at least `margin` beyond the point. Not the smallest: made without a look at exact coordinates,
/// which would have to be fetched from far off.
Box3 wide_box_of(const PointRef& point, double margin) {
  Box3 box = Box3::of(point.approx);
  if (point.is_double() && margin == 0) return box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Rounding moved it by 2^-53 of it at most, or by half the smallest double; the sums here are rounded too. The
    // smallest normal double covers both: a subnormal constant takes the processor a hundred cycles.
    const double width =
        margin + margin * 0x1p-50 + 0x1p-51 * std::abs(point.approx[axis]) + std::numeric_limits<double>::min();
    // Never infinite; so the ends of the range of doubles stand for values beyond them.
    constexpr double kLargest = std::numeric_limits<double>::max();
    box.min[axis] = std::max(box.min[axis] - width, -kLargest);
    box.max[axis] = std::min(box.max[axis] + width, kLargest);
  }
  return box;
}

Box3 wide_bounds(const PointArray& points, double margin) {
  const std::vector<Box3> parts =
      parallel_collect(points.size(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
        Box3 bounds;
        for (std::size_t i = begin; i < end; ++i) bounds.extend(wide_box_of(points[i], margin));
        return std::vector<Box3>{bounds};
      });
  Box3 bounds;
  for (const Box3& part : parts) bounds.extend(part);
  return bounds;
}

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

}  // namespace

struct BoxHierarchy::LazyBounds {
  std::once_flag once, once_for_boxes;
  std::unique_ptr<const OrientedBoxes> boxes;
  std::optional<const NodeSlabs> slabs;
  std::atomic<bool> are_made = false;
  std::atomic<std::size_t> steps = 0;  // of searches without them
};

BoxHierarchy::BoxHierarchy(const TriangleMesh& mesh, double margin)
    : BoxHierarchy(mesh, all_faces(mesh), margin, margin == 0 ? mesh.face_order() : nullptr) {}

BoxHierarchy::BoxHierarchy(const TriangleMesh& mesh, std::vector<std::uint32_t> faces, double margin)
    : BoxHierarchy(mesh, std::move(faces), margin, nullptr) {}

BoxHierarchy::BoxHierarchy(const TriangleMesh& mesh, std::vector<std::uint32_t> faces, double margin,
                           const FaceOrder* known)
    : faces_(std::move(faces)), lazy_(std::make_shared<LazyBounds>()) {
  if (faces_.empty()) return;
  poll_interruption();
  const PointArray& points = mesh.points();
  choose_scale(points, margin);
  const auto box_of_point = [&](std::size_t i) { return scaled(wide_box_of(points[i], margin)); };
  // Boxes of points are made once, unless the faces are few: a part of the mesh near a seam.
  const bool has_few_faces = 3 * faces_.size() < points.size();
  LargeVector<Box> boxes_of_points(has_few_faces ? 0 : points.size());
  parallel_for(boxes_of_points.size(), kFacesPerTask, [&](std::size_t i) { boxes_of_points[i] = box_of_point(i); });
  const auto fill = [&](const auto& box_of_corner) {
    const auto box_of_face = [&](std::size_t i) {
      const TriangleMesh::Triangle triangle = mesh.triangle(FaceId(faces_[i]));
      Box box = box_of_corner(triangle[0]);
      box.extend(box_of_corner(triangle[1]));
      box.extend(box_of_corner(triangle[2]));
      return box;
    };
    sort_faces(box_of_face, known);
    face_boxes_.resize(faces_.size());
    parallel_for(faces_.size(), kFacesPerTask, [&](std::size_t i) { face_boxes_[i] = box_of_face(i); });
  };
  if (has_few_faces)
    fill(box_of_point);
  else
    fill([&](std::size_t v) -> const Box& { return boxes_of_points[v]; });
  build_levels();
}

void BoxHierarchy::choose_scale(const PointArray& points, double margin) {
  const Box3 bounds = wide_bounds(points, margin);
  frame_.origin = bounds.min;
  // Halved first, so that the extent of the largest doubles is finite. A power of two, so that few coordinates are
  // rounded; the codes resolve 2^20 units.
  double half_extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    half_extent = std::max(half_extent, bounds.max[axis] / 2 - bounds.min[axis] / 2);
  frame_.scale = half_extent > 0 ? std::ldexp(1.0, std::min(19 - std::ilogb(half_extent), 1000)) : 1;
}

BoxHierarchy::Box BoxHierarchy::scaled(const Box3& box) const {
  const auto corner = [this](const Vec3& p) {
    return std::array<float, 4>{scaled(p.x, 0), scaled(p.y, 1), scaled(p.z, 2), 0};
  };
  return {corner(box.min), corner(box.max)};
}

Box3 BoxHierarchy::unscaled(const Box& box) const {
  Box3 result;
  const double unit = 1 / frame_.scale;  // exact: a power of two
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A step of float covers the rounding to float, and a step of double that of the sum.
    const double half_origin = frame_.origin[axis] / 2;
    const double min = (double{next_below(box.min[axis])} * unit + half_origin) * 2;
    const double max = (double{next_above(box.max[axis])} * unit + half_origin) * 2;
    result.min[axis] = next_below(min);
    result.max[axis] = next_above(max);
  }
  return result;
}

std::size_t BoxHierarchy::filter_windows(std::span<const Box> windows, const Box& box, std::size_t begin,
                                         std::size_t end, std::vector<std::uint32_t>& reaching) {
  if (reaching.size() < 2 * end - begin) reaching.resize(2 * end - begin);
  std::size_t size = end;
  for (std::size_t i = begin; i < end; ++i) {
    // No branch: whether a window meets the box is unpredictable.
    reaching[size] = reaching[i];
    size += static_cast<std::size_t>(box.meets(windows[reaching[i]]));
  }
  return size;
}

std::span<const std::uint32_t> BoxHierarchy::faces_of(Node node) const {
  const std::size_t faces = kLeafSize << node.level, first = node.index * faces;
  return std::span(faces_).subspan(first, std::min(faces, faces_.size() - first));
}

Box3 BoxHierarchy::bounds() const {
  return faces_.empty() ? Box3{} : unscaled(levels_.back().boxes[0]);
}

const NodeSlabs& BoxHierarchy::slabs(const TriangleMesh& mesh) const {
  std::call_once(lazy_->once, [&] {
    lazy_->slabs.emplace(mesh, *this);
    lazy_->are_made = true;
  });
  return *lazy_->slabs;
}

const NodeSlabs* BoxHierarchy::slabs_after(std::size_t steps, const TriangleMesh& mesh) const {
  constexpr std::size_t kFacesForAStep = 4;
  const bool are_paid_for = (lazy_->steps += steps) * kFacesForAStep > faces_.size();
  return lazy_->are_made || are_paid_for ? &slabs(mesh) : nullptr;
}

const OrientedBoxes* BoxHierarchy::oriented_boxes(const TriangleMesh& mesh) const {
  std::call_once(lazy_->once_for_boxes, [&] { lazy_->boxes = OrientedBoxes::where_much_tighter(mesh, *this); });
  return lazy_->boxes.get();
}

BoxHierarchy::FrameChange BoxHierarchy::change_from(const BoxHierarchy& other) const {
  constexpr double kFar = 0x1p100;
  const double factor = frame_.scale / other.frame_.scale;
  FrameChange change{{}, {}, factor > 1 / kFar && factor < kFar};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double shift = (other.frame_.origin[axis] / 2 - frame_.origin[axis] / 2) * frame_.scale;
    change.is_known = change.is_known && std::abs(shift) < kFar;
    change.factor[axis] = change.is_known ? static_cast<float>(factor) : 0;
    change.shift[axis] = change.is_known ? static_cast<float>(shift) : 0;
  }
  return change;
}

BoxHierarchy::CrossLevel BoxHierarchy::cross_roots(const BoxHierarchy& other, const FrameChange& change) const {
  // A small search is not worth the division.
  constexpr std::size_t kEnough = 48, kFewLeaves = 64;
  CrossLevel roots{level_count() - 1, other.level_count() - 1};
  if (levels_.back().boxes[0].meets(changed(change, other.levels_.back().boxes[0]))) roots.pairs.push_back({0, 0});
  if (leaf_count() <= kFewLeaves && other.leaf_count() <= kFewLeaves) return roots;
  while (!roots.pairs.empty() && roots.pairs.size() < kEnough && roots.own_level + roots.other_level > 0) {
    // One level at a time, so that there are not many more.
    const bool opens_own = roots.own_level > roots.other_level;
    const Opened opened{opens_own, !opens_own};
    CrossLevel below = level_below(roots, opened);
    LastOpened last;
    for (const CrossLevel::Pair pair : roots.pairs) open(other, change, pair, opened, below, last);
    roots = std::move(below);
  }
  return roots;
}

double BoxHierarchy::squared_gap(const Box& own, const Box& other) {
  // Twice what rounding to float moves a coordinate of this frame, which is 2^20 at most.
  constexpr double kRounding = 0x1p-3;
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float gap = std::max(other.min[axis] - own.max[axis], own.min[axis] - other.max[axis]);
    // A place beyond the range of float is infinite here, and certain is only that it is as far as this range.
    const double finite = std::min(gap, std::numeric_limits<float>::max());
    const double certain = std::max(0.0, finite * (1 - 0x1p-20) - kRounding);
    sum += certain * certain;
  }
  return sum;
}

double BoxHierarchy::squared_in_frame(double length) const {
  const double scaled_length = length / 2 * frame_.scale;
  return scaled_length * scaled_length * (1 + 0x1p-40);
}

double BoxHierarchy::least_gap(const Box3& where, double reach) const {
  const Box place = scaled(where);
  const double limit = squared_in_frame(reach);
  double least = Box3::kInfinity;
  std::vector<NearNode> stack;
  if (!faces_.empty()) stack.push_back({{static_cast<std::uint32_t>(levels_.size() - 1), 0}, 0});
  while (!stack.empty() && least > 0) {
    const NearNode node = stack.back();
    stack.pop_back();
    if (node.squared_gap > limit || node.squared_gap >= least) continue;
    if (node.level > 0) {
      push_near_children(node, place, std::min(limit, least), no_gap, stack);
      continue;
    }
    for (std::size_t i = node.index * kLeafSize; i < std::min((node.index + 1) * kLeafSize, faces_.size()); ++i)
      least = std::min(least, squared_gap(face_boxes_[i], place));
  }
  if (least > limit) return Box3::kInfinity;
  return std::min(std::sqrt(least) * (1 - 0x1p-40) / frame_.scale * 2, std::numeric_limits<double>::max());
}

/// The higher node is opened, as for pairs that meet.
void BoxHierarchy::push_near_children(const BoxHierarchy& other, const FrameChange& change, const NearPair& pair,
                                      std::vector<NearPair>& stack) const {
  const bool opens_own = pair.own.level > pair.other.level;
  const Node& opened = opens_own ? pair.own : pair.other;
  const LargeVector<Box>& below = (opens_own ? levels_ : other.levels_)[opened.level - 1].boxes;
  const std::size_t first_new = stack.size();
  const auto end = std::min(2 * opened.index + 2, static_cast<std::uint32_t>(below.size()));
  for (std::uint32_t child = 2 * opened.index; child < end; ++child) {
    const Node node{opened.level - 1, child};
    const Box box = opens_own ? pair.box : changed(change, below[child]);
    const Box& own = opens_own ? below[child] : levels_[pair.own.level].boxes[pair.own.index];
    stack.push_back({opens_own ? node : pair.own, opens_own ? pair.other : node, box, squared_gap(own, box)});
  }
  if (stack.size() == first_new + 2 && stack[first_new].squared_gap < stack[first_new + 1].squared_gap)
    std::swap(stack[first_new], stack[first_new + 1]);
}

template <typename BoxOfFace>
void BoxHierarchy::sort_faces(const BoxOfFace& box_of_face, const FaceOrder* known) {
  // Cells of the sums of two coordinates up to 2^20; 21 bits hold all but the very last value. The number of bits of a
  // code is even, so the first three are 0.
  const auto cells_of = [&](std::size_t i) {
    const Box box = box_of_face(i);
    const auto cell = [&](std::size_t axis) {
      return std::min(static_cast<std::uint32_t>(box.min[axis] + box.max[axis]), std::uint32_t{0x1FFFFF});
    };
    return std::array{cell(0), cell(1), cell(2)};
  };
  const auto code_of = [&](std::size_t i) {
    const auto [x, y, z] = cells_of(i);
    return hilbert_code<22>(x, y, z);
  };
  // With the upper 32 of the 63 bits.
  const auto placed = [&](std::size_t i) {
    const auto [x, y, z] = cells_of(i);
    return PlacedFace(static_cast<std::uint32_t>(hilbert_code<12>(x >> 10, y >> 10, z >> 10) >> 1),
                      static_cast<std::uint32_t>(i));
  };
  LargeVector<PlacedFace> order = may_take_over(known) ? completed(*known, placed) : sorted(placed);
  curve_order::sort_ties(order, kLeafSize, code_of);
  std::vector<std::uint32_t> faces(order.size());
  places_.resize(order.size());
  parallel_for(order.size(), kFacesPerTask, [&](std::size_t i) {
    faces[i] = faces_[order[i].face()];
    places_[i] = order[i].place();
  });
  faces_ = std::move(faces);
}

/// If many faces are new, sorting takes no longer.
bool BoxHierarchy::may_take_over(const FaceOrder* known) const {
  return known != nullptr && known->frame == frame_ && known->faces.size() >= faces_.size() - faces_.size() / 4;
}

template <typename Placed>
LargeVector<PlacedFace> BoxHierarchy::sorted(const Placed& placed) const {
  LargeVector<PlacedFace> order(faces_.size());
  parallel_for(order.size(), kFacesPerTask, [&](std::size_t i) { order[i] = placed(i); });
  curve_order::sort_by_places(order);
  return order;
}

template <typename Placed>
LargeVector<PlacedFace> BoxHierarchy::completed(const FaceOrder& known, const Placed& placed) const {
  assert(std::ranges::all_of(known.faces, [&](PlacedFace face) { return face == placed(face.face()); }));
  const std::vector<std::uint32_t> others = curve_order::faces_beyond(known.faces, faces_.size());
  LargeVector<PlacedFace> placed_others(others.size());
  for (std::size_t i = 0; i < others.size(); ++i) placed_others[i] = placed(others[i]);
  curve_order::sort_by_places(placed_others);
  return curve_order::merged(known.faces, placed_others);
}

void BoxHierarchy::build_levels() {
  // A box around the next `count` boxes of the level below.
  const auto make_level = [](const LargeVector<Box>& below, std::size_t count) {
    Level level;
    level.boxes.resize((below.size() + count - 1) / count);
    parallel_for(level.boxes.size(), kFacesPerTask / count, [&](std::size_t node) {
      const std::size_t begin = node * count, end = std::min(begin + count, below.size());
      Box box = below[begin];
      for (std::size_t i = begin + 1; i < end; ++i) box.extend(below[i]);
      level.boxes[node] = box;
    });
    return level;
  };
  levels_.push_back(make_level(face_boxes_, kLeafSize));
  while (levels_.back().boxes.size() > 1) levels_.push_back(make_level(levels_.back().boxes, 2));
}

std::span<const std::uint32_t> BoxHierarchy::leaf_faces(std::size_t leaf) const {
  const std::size_t begin = leaf * kLeafSize;
  return std::span(faces_).subspan(begin, std::min(kLeafSize, faces_.size() - begin));
}

void BoxHierarchy::set_groups(std::span<const std::uint32_t> leaf_groups) {
  assert(leaf_groups.size() == leaf_count());
  if (leaf_groups.empty()) return;
  levels_[0].groups.assign(leaf_groups.begin(), leaf_groups.end());
  for (std::size_t height = 1; height < levels_.size(); ++height) {
    const std::vector<std::uint32_t>& below = levels_[height - 1].groups;
    std::vector<std::uint32_t>& groups = levels_[height].groups;
    groups.clear();
    for (std::size_t i = 0; i < below.size(); i += 2)
      groups.push_back(i + 1 == below.size() || below[i] == below[i + 1] ? below[i] : kNone);
  }
}

void BoxHierarchy::push_from_highest(const Node& node, std::vector<Node>& stack) const {
  const LargeVector<Box>& below = levels_[node.level - 1].boxes;
  const std::uint32_t first = 2 * node.index, second = first + 1;
  if (second == below.size()) {
    stack.push_back({node.level - 1, first});
    return;
  }
  const bool is_first_lower = below[first].min[2] <= below[second].min[2];
  stack.push_back({node.level - 1, is_first_lower ? second : first});
  stack.push_back({node.level - 1, is_first_lower ? first : second});
}

void BoxHierarchy::push_children(NodePair pair, std::vector<NodePair>& stack) const {
  const std::uint32_t level = pair.level - 1;
  const Level& below = levels_[level];
  const auto child_count = static_cast<std::uint32_t>(below.boxes.size());
  const std::uint32_t first_end = std::min(2 * pair.first + 2, child_count);
  const std::uint32_t second_end = std::min(2 * pair.second + 2, child_count);
  for (std::uint32_t a = 2 * pair.first; a < first_end; ++a) {
    const std::uint32_t second_begin = pair.first == pair.second ? a : 2 * pair.second;
    for (std::uint32_t b = second_begin; b < second_end; ++b)
      if ((a == b || below.boxes[a].meets(below.boxes[b])) && !is_one_group(below, a, b))
        stack.push_back({level, a, b});
  }
}

std::vector<BoxHierarchy::NodePair> BoxHierarchy::parts_of_search(std::size_t least) const {
  if (faces_.empty()) return {};
  std::vector<NodePair> parts{{static_cast<std::uint32_t>(levels_.size() - 1), 0, 0}}, children, next;
  while (parts.size() < least && !parts.empty() && parts.front().level > 0) {
    next.clear();
    for (const NodePair& part : parts) {
      children.clear();
      push_children(part, children);
      next.insert(next.end(), children.rbegin(), children.rend());  // the search goes on with the last one
    }
    parts.swap(next);
  }
  return parts;
}

}  // namespace algebra3d
