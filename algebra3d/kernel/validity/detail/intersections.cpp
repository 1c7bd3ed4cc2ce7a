#include "algebra3d/kernel/validity/detail/intersections.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The corners that two triangles share: positions in the first and the second, in order of the first.
struct SharedCorners {
  std::size_t count = 0;
  std::array<std::size_t, 3> in_first{}, in_second{};
};

SharedCorners shared_corners(const TriangleMesh::Triangle& s, const TriangleMesh::Triangle& t) {
  SharedCorners shared;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (s[i] != t[j]) continue;
      shared.in_first[shared.count] = i;
      shared.in_second[shared.count] = j;
      ++shared.count;
    }
  }
  return shared;
}

/// The intersection of two faces without their common corners and edge.
enum class Excess : std::uint8_t {
  none,
  point,    ///< one point; they have no corner in common
  improper  ///< more than a valid surface allows
};

class PairTest {
 public:
  PairTest(const TriangleMesh& mesh, const ProvedParts& proved)
      : mesh_(mesh), proved_(proved), all_double_(mesh.points().exact_count() == 0) {}

  /// The plane of the face that was asked for last: pairs come in runs with the same first face.
  struct LastPlane {
    FaceId face;
    std::optional<detail::PlaneFilter> plane;
  };

  /// Excess::none for pairs that are proved or known.
  Excess excess(FaceId f, FaceId g, LastPlane& last) const {
    if (proved_.fields.are_in_one(f, g)) return Excess::none;
    if (proved_.known.contains(f.index()) && proved_.known.contains(g.index())) return Excess::none;
    const TriangleMesh::Triangle s = mesh_.triangle(f), t = mesh_.triangle(g);
    // Without branches: three of four pairs end here, but which is hard to predict.
    const int has0 = is_corner(s[0], t), has1 = is_corner(s[1], t), has2 = is_corner(s[2], t);
    const int embedded = (has0 & is_embedded(s[0])) | (has1 & is_embedded(s[1])) | (has2 & is_embedded(s[2]));
    if (embedded != 0) return Excess::none;
    if ((has0 | has1 | has2) == 0) return excess_of_strangers(f, g, last);
    return is_improper_neighbour(s, t) ? Excess::improper : Excess::none;
  }

 private:
  // Both 0 or 1, as numbers, so that they combine without branches.
  static int is_corner(std::uint32_t vertex, const TriangleMesh::Triangle& t) {
    return static_cast<int>(vertex == t[0]) | static_cast<int>(vertex == t[1]) | static_cast<int>(vertex == t[2]);
  }
  int is_embedded(std::uint32_t vertex) const { return static_cast<int>(proved_.stars.is_embedded(VertexId(vertex))); }

  Excess excess_of_strangers(FaceId f, FaceId g, LastPlane& last) const {
    std::array<int, 3> sides{detail::kUndecided, detail::kUndecided, detail::kUndecided};
    if (all_double_) {
      if (f != last.face) last = {f, plane_filter(f)};
      sides = last.plane->sides(doubles(g));
      detail::count_calls(3);
      if (sides[0] != detail::kUndecided && sides[0] == sides[1] && sides[0] == sides[2]) return Excess::none;
    }
    const Contact contact = contact_of_triangles(mesh_.corners(f), mesh_.corners(g), sides).kind;
    if (contact == Contact::none) return Excess::none;
    return contact == Contact::point ? Excess::point : Excess::improper;
  }

  bool is_improper_neighbour(const TriangleMesh::Triangle& s, const TriangleMesh::Triangle& t) const {
    const SharedCorners shared = shared_corners(s, t);
    const auto s_point = [&](std::size_t corner) { return mesh_.point(VertexId(s[corner % 3])); };
    const auto t_point = [&](std::size_t corner) { return mesh_.point(VertexId(t[corner % 3])); };
    const std::size_t i = shared.in_first[0], j = shared.in_second[0];
    if (shared.count == 1)
      return meet_beyond_shared_vertex(s_point(i), s_point(i + 1), s_point(i + 2), t_point(j + 1), t_point(j + 2));
    // The third corner is the one whose position is missing from 0 + 1 + 2.
    const std::size_t s_apex = 3 - i - shared.in_first[1], t_apex = 3 - j - shared.in_second[1];
    return overlap_beyond_shared_edge(s_point(i), s_point(shared.in_first[1]), s_point(s_apex), t_point(t_apex));
  }

  std::array<const Vec3*, 3> doubles(FaceId face) const {
    const TriangleMesh::Triangle t = mesh_.triangle(face);
    const std::vector<Vec3>& points = mesh_.points().approx();
    return {&points[t[0]], &points[t[1]], &points[t[2]]};
  }

  detail::PlaneFilter plane_filter(FaceId face) const {
    const auto [a, b, c] = doubles(face);
    return {*a, *b, *c};
  }

  const TriangleMesh& mesh_;
  const ProvedParts& proved_;
  bool all_double_;
};

/// The first corner of the leaf's first face that is embedded and belongs to all its faces, or kNone.
std::uint32_t common_embedded_corner(const TriangleMesh& mesh, const EmbeddedStars& stars,
                                     std::span<const std::uint32_t> faces) {
  for (const std::uint32_t corner : mesh.triangle(FaceId(faces[0]))) {
    const auto has_corner = [&](std::uint32_t face) {
      const TriangleMesh::Triangle t = mesh.triangle(FaceId(face));
      return t[0] == corner || t[1] == corner || t[2] == corner;
    };
    if (stars.is_embedded(VertexId(corner)) && std::ranges::all_of(faces, has_corner)) return corner;
  }
  return kNone;
}

constexpr std::size_t kLeavesPerTask = 1024;

/// The field that contains all faces of a leaf; none if there is none.
RegionId common_field(const HeightFields& fields, std::span<const std::uint32_t> faces) {
  const RegionId field = fields.field(FaceId(faces[0]));
  const auto is_in_field = [&](std::uint32_t face) { return fields.field(FaceId(face)) == field; };
  return std::ranges::all_of(faces, is_in_field) ? field : RegionId();
}

// Pairs of leaves of one group need no test. Leaves with known faces alone are one group, those in one height field
// another. All triangles at the tip of a cone meet there, so their boxes do, and their pairs are quadratically many:
// the group of such a leaf is the corner, also where it lies in a field, since other leaves at the tip lie in other
// fields. The three kinds have different numbers.
void group_leaves(const TriangleMesh& mesh, const ProvedParts& proved, BoxHierarchy& hierarchy) {
  const auto known_group = static_cast<std::uint32_t>(mesh.vertex_count()), first_field = known_group + 1;
  const auto is_known = [&](std::uint32_t face) { return proved.known.contains(face); };
  std::vector<std::uint32_t> groups(hierarchy.leaf_count());
  parallel_for(groups.size(), kLeavesPerTask, [&](std::size_t leaf) {
    const auto faces = hierarchy.leaf_faces(leaf);
    const std::uint32_t corner = common_embedded_corner(mesh, proved.stars, faces);
    const RegionId field = common_field(proved.fields, faces);
    const bool is_within_field = corner == kNone || proved.fields.is_inside(VertexId(corner));
    if (std::ranges::all_of(faces, is_known))
      groups[leaf] = known_group;
    else if (!field.is_none() && is_within_field)
      groups[leaf] = first_field + field.index();
    else
      groups[leaf] = corner;
  });
  hierarchy.set_groups(groups);
}

/// Middle of the common part of the triangles' boxes.
Vec3 place_of(const TriangleMesh& mesh, FaceId f, FaceId g) {
  std::array<Box3, 2> boxes;
  for (const PointRef& corner : mesh.corners(f)) boxes[0].extend(corner.approx);
  for (const PointRef& corner : mesh.corners(g)) boxes[1].extend(corner.approx);
  const Box3 common = intersect(boxes[0], boxes[1]);
  // Rounded corners may leave no common part where the exact triangles just meet.
  if (common.is_empty()) return mesh.corners(f)[0].approx;
  return 0.5 * common.min + 0.5 * common.max;
}

/// So many parts of a search are searched in parallel, if there are more faces than that.
constexpr std::size_t kParts = 256;
constexpr std::size_t kFewFaces = 2'000;
/// More pairs are not kept, but searched again.
constexpr std::size_t kMostPairs = 1'000'000;

/// The pairs that a part of a search has found.
struct FoundPairs {
  FacePairs improper, touching;
};

/// Searches parts of a hierarchy for pairs that intersect.
class PairSearch {
 public:
  /// `limit`: of the work with exact numbers, or null.
  PairSearch(const PairTest& test, const BoxHierarchy& hierarchy, const std::atomic<bool>* cancel,
             ExactWorkLimit* limit)
      : test_(test), hierarchy_(hierarchy), cancel_(cancel), limit_(limit) {}

  bool is_cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }
  bool is_beyond_limit() const { return limit_ != nullptr && limit_->is_exceeded(); }

  /// Adds the pairs of a part that touch in a point, and calls visit for each that intersects in more, until it returns
  /// false, or go_on, which is asked now and then.
  template <typename Visit, typename GoOn>
  void search(const BoxHierarchy::NodePair& part, FacePairs& touching, const Visit& visit, const GoOn& go_on) const {
    PairTest::LastPlane last;
    hierarchy_.for_each_pair(
        part,
        [&](std::uint32_t a, std::uint32_t b) {
          const auto tested = [&] { return test_.excess(FaceId(a), FaceId(b), last); };
          const Excess excess = limit_ == nullptr ? tested() : limit_->measured(tested);
          if (is_beyond_limit()) return false;
          if (excess == Excess::none) return true;
          const FaceId first(std::min(a, b)), second(std::max(a, b));
          if (excess == Excess::point) touching.emplace_back(first, second);
          return excess != Excess::improper || visit(first, second);
        },
        go_on);
  }

  /// All pairs, searched in parallel, or all up to the first improper one; in order. Nothing if there are too many.
  std::optional<FoundPairs> all_pairs(const std::vector<BoxHierarchy::NodePair>& parts, bool only_first) const {
    std::atomic<std::size_t> first_with_pair = SIZE_MAX, count = 0;
    std::vector<FoundPairs> found(parts.size());
    parallel_for(parts.size(), 1, [&](std::size_t part) {
      const auto go_on = [&] {
        return !is_cancelled() && !is_beyond_limit() && (!only_first || part <= first_with_pair) && count <= kMostPairs;
      };
      const auto add = [&](FaceId first, FaceId second) {
        found[part].improper.emplace_back(first, second);
        ++count;
        std::size_t other = first_with_pair;
        while (part < other && !first_with_pair.compare_exchange_weak(other, part)) continue;
        return !only_first;
      };
      if (go_on()) search(parts[part], found[part].touching, add, go_on);
    });
    if (count > kMostPairs) return std::nullopt;
    FoundPairs all;
    for (const FoundPairs& pairs : found) {
      all.improper.insert(all.improper.end(), pairs.improper.begin(), pairs.improper.end());
      all.touching.insert(all.touching.end(), pairs.touching.begin(), pairs.touching.end());
    }
    return all;
  }

 private:
  const PairTest& test_;
  const BoxHierarchy& hierarchy_;
  const std::atomic<bool>* cancel_;
  ExactWorkLimit* limit_;
};

}  // namespace

Result<FacePairs> for_each_intersection(const TriangleMesh& mesh, const ProvedParts& proved, BoxHierarchy& hierarchy,
                                        const std::atomic<bool>* cancel,
                                        const std::function<bool(FaceId, FaceId)>& visit, bool only_first,
                                        ExactWorkLimit* limit) {
  group_leaves(mesh, proved, hierarchy);
  const PairTest test(mesh, proved);
  const PairSearch search(test, hierarchy, cancel, limit);
  const bool is_large = hierarchy.face_count() > kFewFaces;
  const std::vector<BoxHierarchy::NodePair> parts = hierarchy.parts_of_search(is_large ? kParts : 1);
  auto pairs = is_large ? search.all_pairs(parts, only_first) : std::nullopt;
  FacePairs touching;
  bool goes_on = true;
  if (pairs) {
    for (const auto& [first, second] : pairs->improper) {
      if (!goes_on) break;
      goes_on = visit(first, second);
    }
    touching = std::move(pairs->touching);
  } else {
    for (const BoxHierarchy::NodePair& part : parts) {
      if (!goes_on) break;
      search.search(
          part, touching, [&](FaceId first, FaceId second) { return goes_on = visit(first, second); },
          [&] { return !search.is_cancelled() && !search.is_beyond_limit(); });
    }
  }
  if (search.is_cancelled()) return Error{ErrorCode::interrupted, "interrupted"};
  if (search.is_beyond_limit())
    return Error{ErrorCode::limit_exceeded, "the coordinates are so far apart that the proof takes too long"};
  return touching;
}

Result<FacePairs> find_intersections(const TriangleMesh& mesh, const ProvedParts& proved, BoxHierarchy& hierarchy,
                                     const ProofOptions& options, ValidityReport& report, FaceSet& free,
                                     ExactWorkLimit* limit) {
  const std::uint64_t most_pairs = options.thoroughness == Thoroughness::first_defect
                                       ? 1
                                       : std::max<std::uint64_t>(options.max_intersecting_pairs, 1);
  const auto add = [&](FaceId first, FaceId second) {
    if (!free.is_empty()) free.remove(first.index());
    if (!free.is_empty()) free.remove(second.index());
    report.add({Defect::intersecting_triangles, first, second, place_of(mesh, first, second)});
    report.is_cut_short = report.count(Defect::intersecting_triangles) == most_pairs;
    return !report.is_cut_short;
  };
  return for_each_intersection(mesh, proved, hierarchy, options.cancel, add, most_pairs == 1, limit);
}

}  // namespace algebra3d
