#include "algebra3d/rounding/detail/crossing_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/exact/predicates.h"

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

CrossingSearch::CrossingSearch(const SnappedFaces& faces) : faces_(faces), given_(faces.given_mesh()) {
  for (std::size_t given = 0; given < faces.given_count(); ++given) is_flat_.push_back(is_flat(faces, given));
}

Result<std::vector<FacePair>> CrossingSearch::find(const std::atomic<bool>* cancel) const {
  const auto without_flat = [&](std::vector<std::size_t> numbers) {
    std::erase_if(numbers, [&](std::size_t f) { return is_flat(faces_, f); });
    return numbers;
  };
  const SomeFaces open(faces_, without_flat(faces_.open_faces())),
      changed(faces_, without_flat(faces_.changed_faces()));
  std::vector<FacePair> pairs;
  const auto add = [&](std::size_t f, std::size_t g) {  // an open one, and any
    const bool comes_twice = faces_.is_open(g) && f >= g;
    if (!comes_twice && do_cross(faces_, f, g)) pairs.emplace_back(std::min(f, g), std::max(f, g));
  };
  const Monitor monitor(cancel);
  const auto go_on = [&] { return !monitor.is_cancelled(); };
  open.hierarchy().for_each_pair_with(
      given_,
      [&](std::uint32_t f, std::uint32_t given) {
        if (faces_.is_there(given) && !is_flat_[given]) add(open[f], given);
        return true;
      },
      go_on);
  open.hierarchy().for_each_pair_with(
      changed.hierarchy(),
      [&](std::uint32_t f, std::uint32_t g) {
        add(open[f], changed[g]);
        return true;
      },
      go_on);
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace algebra3d
