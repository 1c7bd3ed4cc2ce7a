#include "algebra3d/kernel/arrangement/detail/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/search/node_gaps.h"
#include "algebra3d/kernel/search/slab_gaps.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

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
    std::uint32_t face = kNone;
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

constexpr std::size_t kMaxFacesOfSmall = 32, kMinFacesOfLarge = 256, kMaxSlabs = 8;

/// Cosine of the angle up to which two directions are taken for one: a slab along either says as much.
constexpr double kParallel = 1 - 0x1p-20;

bool is_along_an_axis(const Vec3& normal) {
  return detail::largest(normal) > kParallel;
}

// Lengths are in units of the frame, in which the large operand extends over 2^20. Corners are rounded to some 2^-52 of
// the largest coordinate, places and products by little more; another unit of 2^-8 covers underflows.
FacetSlabs::FacetSlabs(const TriangleMesh& small, const BoxHierarchy& of_small, const TriangleMesh& large,
                       const BoxHierarchy& of_large)
    : mesh_(large), hierarchy_(of_large) {
  constexpr double kFar = 0x1p100;
  if (small.face_count() > kMaxFacesOfSmall || large.face_count() < kMinFacesOfLarge) return;
  const Box3 box = unite(of_small.bounds(), of_large.bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max)) * of_large.frame().scale;
  if (!(size < kFar)) return;
  std::vector<Vec3> places;
  for (const Vec3& point : small.points().approx()) places.push_back(of_large.frame().place_of(point));
  for (std::uint32_t face = 0; face < small.face_count() && slabs_.size() < kMaxSlabs; ++face) {
    const auto [a, b, c] = small.triangle(FaceId(face));
    const Vec3 normal = cross(places[b] - places[a], places[c] - places[a]);
    const double length = std::sqrt(dot(normal, normal));
    if (length > 0x1p-400) add_slab((1 / length) * normal, places, 0x1p-46 * size + 0x1p-8);
  }
}

void FacetSlabs::add_slab(const Vec3& normal, const std::vector<Vec3>& places, double error) {
  const auto is_known = [&](const Slab& slab) { return std::abs(dot(slab.normal, normal)) > kParallel; };
  if (is_along_an_axis(normal) || std::ranges::any_of(slabs_, is_known)) return;
  double low = Box3::kInfinity, high = -Box3::kInfinity;
  for (const Vec3& place : places) {
    const double product = dot(normal, place);
    low = std::min(low, product);
    high = std::max(high, product);
  }
  slabs_.push_back({normal, low - error, high + error});
}

bool FacetSlabs::are_beyond(BoxHierarchy::Node node) const {
  const BoxHierarchy::Place place = hierarchy_.place(node);
  return std::ranges::any_of(slabs_, [&](const Slab& slab) {
    const double middle = dot(slab.normal, place.middle), reach = place.reach(slab.normal);
    return middle - reach > slab.high || middle + reach < slab.low;
  });
}

bool FacetSlabs::is_beyond(std::uint32_t face) const {
  const auto [a, b, c] = mesh_.triangle(FaceId(face));
  const std::vector<Vec3>& points = mesh_.points().approx();
  const BoxHierarchy::Frame& frame = hierarchy_.frame();
  const std::array corners{frame.place_of(points[a]), frame.place_of(points[b]), frame.place_of(points[c])};
  return std::ranges::any_of(slabs_, [&](const Slab& slab) {
    const double p = dot(slab.normal, corners[0]), q = dot(slab.normal, corners[1]), r = dot(slab.normal, corners[2]);
    return std::min(std::min(p, q), r) > slab.high || std::max(std::max(p, q), r) < slab.low;
  });
}

class CandidateFinder {
 public:
  CandidateFinder(const Operands& operands, const Monitor& monitor, std::size_t max_pairs)
      : operands_(operands), monitor_(monitor), max_pairs_(max_pairs) {}

  std::vector<FacePair> run() {
    constexpr std::size_t kFewOperands = 8;
    if (operands_.count() <= kFewOperands)
      pair_hierarchies();
    else
      pair_faces();
    return std::move(pairs_);
  }

 private:
  std::vector<FacePair> pair_two(OperandId a, OperandId b, BoxHierarchy::Share share) const;
  FacetSlabs slabs_around(OperandId one, OperandId other) const {
    return {operands_.mesh(one), operands_.hierarchy(one), operands_.mesh(other), operands_.hierarchy(other)};
  }
  std::size_t share_count() const;
  void add(std::vector<FacePair> pairs);
  void pair_hierarchies();
  OperandId dominant_operand() const;
  void pair_with_others(OperandId one, const IdTree<OperandId>& operand_tree);
  void pair_faces();
  IdTree<InputFaceId> faces_near_others(OperandId left_out, const IdTree<OperandId>& operand_tree) const;
  bool goes_on() const { return !monitor_.is_cancelled() && pairs_.size() <= max_pairs_; }

  const Operands& operands_;
  const Monitor& monitor_;
  std::size_t max_pairs_;
  std::vector<FacePair> pairs_;
};

std::vector<FacePair> CandidateFinder::pair_two(OperandId a, OperandId b, BoxHierarchy::Share share) const {
  std::vector<FacePair> pairs;
  NodeGaps gaps(operands_.mesh(a), operands_.hierarchy(a), operands_.mesh(b), operands_.hierarchy(b));
  SlabGaps slab_gaps(operands_.mesh(a), operands_.hierarchy(a), operands_.mesh(b), operands_.hierarchy(b));
  FacetSlabs around_a = slabs_around(a, b), around_b = slabs_around(b, a);
  // Beside needles boxes guide the search badly; elsewhere slabs would gain less than they cost. They are made at a
  // point that follows from the operands alone, so what is left out does.
  constexpr std::size_t kManyForAFace = 4;
  const std::size_t many = kManyForAFace * (operands_.mesh(a).face_count() + operands_.mesh(b).face_count());
  const auto are_far = [&](BoxHierarchy::Node m, BoxHierarchy::Node n) {
    if (pairs.size() * share.count <= many) return false;
    for (const OperandId operand : {a, b}) operands_.hierarchy(operand).slabs(operands_.mesh(operand));
    return slab_gaps.exceed(m, n, 0);
  };
  operands_.hierarchy(a).for_each_pair_with(
      operands_.hierarchy(b),
      [&](std::uint32_t f, std::uint32_t g) {
        if (around_a.misses(g) || around_b.misses(f)) return true;
        gaps.note_visit();
        pairs.push_back({operands_.input(a, FaceId(f)), operands_.input(b, FaceId(g))});
        return pairs.size() <= max_pairs_;
      },
      [&](BoxHierarchy::Node m, BoxHierarchy::Node n) {
        return around_a.miss(n) || around_b.miss(m) || are_far(m, n) || gaps.exceed(m, n, 0);
      },
      [&] { return !monitor_.is_cancelled(); }, share);
  return pairs;
}

/// Number of shares of a search. It follows from the operands alone, so that the order of the pairs does.
std::size_t CandidateFinder::share_count() const {
  constexpr std::size_t kFacesWorthAThread = 1500, kMaxShares = 16;
  if (operands_.face_count() < kFacesWorthAThread) return 1;
  return std::clamp<std::size_t>(operands_.face_count() / kWorthAThread, 2, kMaxShares);
}

void CandidateFinder::add(std::vector<FacePair> pairs) {
  if (pairs_.empty())
    pairs_ = std::move(pairs);
  else
    pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
}

/// Few operands: the hierarchy of each against that of each other one.
void CandidateFinder::pair_hierarchies() {
  const auto shares = static_cast<std::uint32_t>(share_count());
  for (const OperandId a : operands_.ids())
    for (const OperandId b : IdRange(OperandId(a.index() + 1), OperandId(operands_.count()))) {
      add(parallel_collect(shares, 1, [&](std::size_t share, std::size_t) {
        return pair_two(a, b, {static_cast<std::uint32_t>(share), shares});
      }));
      if (pairs_.size() > max_pairs_) return;
    }
}

/// The operand that has more faces than all others together, if it is worth a search of its own; else none.
OperandId CandidateFinder::dominant_operand() const {
  for (const OperandId i : operands_.ids())
    if (operands_.mesh(i).face_count() > std::max(operands_.face_count() / 2, kWorthAThread)) return i;
  return {};
}

/// One operand against all others that its box meets.
void CandidateFinder::pair_with_others(OperandId one, const IdTree<OperandId>& operand_tree) {
  operand_tree.for_each_in(operands_.hierarchy(one).bounds(), [&](OperandId other) {
    if (other != one && goes_on()) add(pair_two(std::min(one, other), std::max(one, other), {0, 1}));
  });
}

/// The faces of all operands whose boxes meet those of others.
IdTree<InputFaceId> CandidateFinder::faces_near_others(OperandId left_out,
                                                       const IdTree<OperandId>& operand_tree) const {
  IdTree<InputFaceId>::Boxes boxes;
  for (const OperandId i : operands_.ids()) {
    if (i == left_out || !operand_tree.has_more_in(operands_.hierarchy(i).bounds(), 1)) continue;
    for (const InputFaceId face : operands_.faces(i))
      boxes.add(box_of_triangle(operands_.mesh(i).corners(operands_.in_mesh(i, face))), face);
  }
  return boxes.tree();
}

/// Many operands: one tree over the faces of all whose boxes meet others. Where one operand has nearly all faces and
/// few of them are near others, its hierarchy finds these sooner.
void CandidateFinder::pair_faces() {
  IdTree<OperandId>::Boxes boxes;
  for (const OperandId i : operands_.ids()) boxes.add(operands_.hierarchy(i).bounds(), i);
  const IdTree<OperandId> operand_tree = boxes.tree();
  const OperandId dominant = dominant_operand();
  if (!dominant.is_none()) pair_with_others(dominant, operand_tree);
  faces_near_others(dominant, operand_tree).for_each_pair([&](InputFaceId first, InputFaceId second) {
    if (operands_.operand_of(first) != operands_.operand_of(second)) pairs_.push_back({first, second});
    return goes_on();
  });
}

}  // namespace

Result<Candidates> find_candidates(const Operands& operands, const Monitor& monitor, std::size_t max_pairs) {
  monitor.tell("finding near triangles");
  Candidates result{CandidateFinder(operands, monitor, max_pairs).run()};
  A3D_TRY(monitor.check());
  if (result.pairs.size() > max_pairs)
    return Error{ErrorCode::limit_exceeded, "more than {} pairs of triangles may touch", max_pairs};
  return result;
}

}  // namespace algebra3d::arrangement
