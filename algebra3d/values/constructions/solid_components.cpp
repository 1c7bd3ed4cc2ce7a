// Why a vertical line finds the body around a cavity.
//
// Every shell of a valid volume is a closed surface by itself, and next to it the winding number of the shell alone
// steps from w in front to w + 1 behind, with one w for the whole shell (validity/detail/winding.cpp says why). Far
// away it is 0, so w is 0 or -1: in the first case the shell bounds a body from outside and encloses a positive volume,
// in the second it bounds a cavity and encloses a negative one. Shells do not cross each other, so of any two either
// one lies inside the other or they lie apart, and those around a given point form a chain. The material behind a
// cavity's wall belongs to the innermost body of that chain: any body further out is separated from it by a cavity
// around that body.

#include "algebra3d/values/constructions/solid_components.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "algebra3d/kernel/exact/inner_point.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/validity/shell_tops.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The bodies around a shell by counting all that a vertical ray passes: for the few shells whose tops touch others.
class BodiesByRays {
 public:
  BodiesByRays(const TriangleMesh& mesh, const FaceComponents& shells, const std::vector<std::vector<FaceId>>& faces,
               const BoxHierarchy& hierarchy, const std::vector<int>& orientations)
      : mesh_(mesh), shells_(shells), faces_(faces), hierarchy_(hierarchy), orientations_(orientations) {}

  /// The body right around a cavity.
  std::uint32_t body_around(std::uint32_t cavity) {
    const std::vector<std::uint32_t> bodies = bodies_around(cavity);
    // The chain from outside to inside: each further body is inside all the ones before it.
    return *std::ranges::max_element(bodies, {}, [&](std::uint32_t body) { return depth_of(body); });
  }

 private:
  std::size_t depth_of(std::uint32_t body) {
    const auto known = depths_.find(body);
    if (known != depths_.end()) return known->second;
    return depths_[body] = bodies_around(body).size();
  }

  /// The other bodies inside of which a shell lies, ascending.
  std::vector<std::uint32_t> bodies_around(std::uint32_t shell) const {
    const TriangleRef triangle = mesh_.corners(faces_[shell].front());
    // Another shell can touch the triangle in finitely many points only.
    for (int attempt = 0;; ++attempt)
      if (auto bodies = bodies_around(shell, inner_point(triangle, attempt))) return *std::move(bodies);
  }

  /// Nothing if the point lies on another shell.
  std::optional<std::vector<std::uint32_t>> bodies_around(std::uint32_t shell, const ExactPoint& point) const {
    std::map<std::uint32_t, int> windings;
    bool is_on_other = false;
    hierarchy_.for_each_on_vertical_ray(box_of(point), 1, [&](std::uint32_t face) {
      const std::uint32_t other = shells_.of_face[face];
      if (other == shell || orientations_[other] < 0) return;
      const LineCrossing crossing = cross_vertical_line(point, mesh_.corners(FaceId(face)));
      if (crossing.sign == 0) return;
      if (crossing.side == 0) is_on_other = true;
      if (crossing.side == -1) windings[other] += crossing.sign;
    });
    if (is_on_other) return std::nullopt;
    std::vector<std::uint32_t> bodies;
    for (const auto& [body, winding] : windings)
      if (winding != 0) bodies.push_back(body);
    return bodies;
  }

  const TriangleMesh& mesh_;
  const FaceComponents& shells_;
  const std::vector<std::vector<FaceId>>& faces_;
  const BoxHierarchy& hierarchy_;
  const std::vector<int>& orientations_;
  std::map<std::uint32_t, std::size_t> depths_;
};

/// Joins the faces of shells with the same leader, in order of their lowest faces.
std::vector<std::vector<FaceId>> join_shells(std::vector<std::vector<FaceId>> shells,
                                             const std::vector<std::size_t>& leaders) {
  std::vector<std::vector<FaceId>> joined;
  std::vector<std::size_t> places(shells.size(), shells.size());
  for (std::size_t shell = 0; shell < shells.size(); ++shell) {
    std::size_t& place = places[leaders[shell]];
    if (place == shells.size()) {
      place = joined.size();
      joined.push_back(std::move(shells[shell]));
    } else {
      joined[place].insert(joined[place].end(), shells[shell].begin(), shells[shell].end());
    }
  }
  for (auto& faces : joined) std::ranges::sort(faces);
  return joined;
}

}  // namespace

Result<std::vector<std::vector<FaceId>>> solid_components(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                          const std::atomic<bool>* cancel) {
  const FaceComponents shells = connected_components(mesh);
  std::vector<std::vector<FaceId>> faces = shells.faces();
  if (shells.count <= 1) return faces;
  const ShellTops tops(mesh, hierarchy, shells.of_face, shells.count);
  const std::vector<int> orientations = shell_orientations(mesh, shells.of_face, shells.count);
  BodiesByRays rays(mesh, shells, faces, hierarchy, orientations);
  std::vector<std::size_t> leaders(shells.count);
  for (const std::uint32_t shell : tops.from_highest()) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed))
      return Error{ErrorCode::interrupted, "interrupted"};
    leaders[shell] = shell;
    if (orientations[shell] > 0) continue;
    // Right above the top of a cavity is material, up to the wall that is met: of the body around, or of one of its
    // other cavities.
    const FaceOverhead above = tops.overhead(shell);
    const bool is_found = above.is_known && above.face.is_valid();
    leaders[shell] = is_found ? leaders[shells.of_face[above.face.index()]] : rays.body_around(shell);
  }
  return join_shells(std::move(faces), leaders);
}

namespace {

template <typename T>
Result<std::vector<T>> parts_of(Context& context, const T& geometry,
                                const std::vector<std::vector<FaceId>>& components) {
  if (components.size() == 1) return std::vector<T>{geometry};
  std::vector<T> result;
  SubmeshMaker maker(geometry.mesh());
  for (const std::vector<FaceId>& faces : components) {
    A3D_TRY(context.check_cancelled());
    // No proof: triangles that are fine among others are so among fewer. A component of a volume holds the outer shell
    // of a body and the walls of its cavities, so next to these the winding numbers are what they were in the whole.
    result.push_back(T::trusted(maker.make(faces)));
  }
  return result;
}

}  // namespace

Result<std::vector<Surface3d>> components_of(Context& context, const Surface3d& surface) {
  return parts_of(context, surface, connected_components(surface.mesh()).faces());
}

Result<std::vector<Volume3d>> components_of(Context& context, const Volume3d& solid) {
  A3D_ASSIGN(const auto components, solid_components(solid.mesh(), solid.geometry().hierarchy(), context.cancel));
  return parts_of(context, solid, components);
}

}  // namespace algebra3d
