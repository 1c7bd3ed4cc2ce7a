#include "algebra3d/kernel/rounding/detail/crossing_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Corners = std::array<PointId, 3>;

/// The corners so that those that the other face has too stand first, and how many these are.
std::pair<Corners, std::size_t> shared_first(Corners corners, const Corners& other) {
  auto* const rest = std::partition(corners.begin(), corners.end(),
                                    [&](PointId p) { return std::ranges::find(other, p) != other.end(); });
  return {corners, static_cast<std::size_t>(rest - corners.begin())};
}

bool do_cross(const SnappedFaces& faces, std::size_t f, std::size_t g) {
  auto [s, shared] = shared_first(faces.corners(f), faces.corners(g));
  const auto at = [&](PointId p) { return faces.point(p); };
  if (shared == 0) {
    const Contact contact = intersect_triangles(faces.triangle(f), faces.triangle(g));
    return contact == Contact::segment || contact == Contact::area;
  }
  const Corners t = shared_first(faces.corners(g), faces.corners(f)).first;
  if (shared == 1) return meet_beyond_shared_vertex(at(s[0]), at(s[1]), at(s[2]), at(t[1]), at(t[2]));
  return shared == 2 && overlap_beyond_shared_edge(at(s[0]), at(s[1]), at(s[2]), at(t[2]));
}

/// A hierarchy over some faces.
class SomeFaces {
 public:
  SomeFaces(const SnappedFaces& faces, std::vector<std::size_t> numbers)
      : numbers_(std::move(numbers)), hierarchy_(faces.mesh_of(numbers_)) {}

  std::size_t operator[](std::uint32_t index) const { return numbers_[index]; }
  const BoxHierarchy& hierarchy() const { return hierarchy_; }

 private:
  std::vector<std::size_t> numbers_;
  BoxHierarchy hierarchy_;
};

bool is_flat(const SnappedFaces& faces, std::size_t face) {
  const auto [a, b, c] = faces.triangle(face);
  return collinear(a, b, c);
}

}  // namespace

CrossingSearch::CrossingSearch(const SnappedFaces& faces)
    : faces_(faces), given_mesh_(faces.given_mesh()), given_(given_mesh_) {
  for (std::size_t given = 0; given < faces.given_count(); ++given) is_flat_.push_back(is_flat(faces, given));
}

Result<std::vector<FacePair>> CrossingSearch::find(const std::atomic<bool>* cancel) const {
  const bool is_all_open = faces_.changed_faces().empty() && faces_.open_faces().size() == faces_.given_count();
  return is_all_open ? find_among_given(cancel) : find_of(faces_.open_faces(), cancel);
}

/// The pairs while all given faces are there and open, as a proof finds them.
Result<std::vector<FacePair>> CrossingSearch::find_among_given(const std::atomic<bool>* cancel) const {
  A3D_ASSIGN(const Crossings crossings, find_crossings(given_mesh_, cancel));
  std::vector<FacePair> pairs;
  pairs.reserve(crossings.pairs.size());
  for (const auto& [f, g] : crossings.pairs) pairs.emplace_back(f.index(), g.index());
  if (crossings.duplicates.empty()) return pairs;
  std::vector<std::size_t> duplicates;
  for (const FaceId face : crossings.duplicates) duplicates.push_back(face.index());
  A3D_ASSIGN(const std::vector<FacePair> others, find_of(duplicates, cancel));
  pairs.insert(pairs.end(), others.begin(), others.end());
  std::ranges::sort(pairs);
  return pairs;
}

/// The pairs of which at least one face is wanted, which are ascending.
Result<std::vector<FacePair>> CrossingSearch::find_of(const std::vector<std::size_t>& wanted,
                                                      const std::atomic<bool>* cancel) const {
  const auto without_flat = [&](std::vector<std::size_t> numbers) {
    std::erase_if(numbers, [&](std::size_t f) { return is_flat(faces_, f); });
    return numbers;
  };
  const SomeFaces some(faces_, without_flat(wanted)), changed(faces_, without_flat(faces_.changed_faces()));
  std::vector<FacePair> pairs;
  const auto add = [&](std::size_t f, std::size_t g) {  // a wanted one, and any
    const bool comes_twice = f >= g && std::ranges::binary_search(wanted, g);
    if (!comes_twice && do_cross(faces_, f, g)) pairs.emplace_back(std::min(f, g), std::max(f, g));
  };
  const Monitor monitor(cancel);
  const auto go_on = [&] { return !monitor.is_cancelled(); };
  some.hierarchy().for_each_pair_with(
      given_,
      [&](std::uint32_t f, std::uint32_t given) {
        if (faces_.is_there(given) && !is_flat_[given]) add(some[f], given);
        return true;
      },
      go_on);
  some.hierarchy().for_each_pair_with(
      changed.hierarchy(),
      [&](std::uint32_t f, std::uint32_t g) {
        add(some[f], changed[g]);
        return true;
      },
      go_on);
  A3D_TRY(monitor.check());
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace algebra3d
