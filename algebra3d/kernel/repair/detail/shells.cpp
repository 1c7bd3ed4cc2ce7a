#include "algebra3d/kernel/repair/detail/shells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/manifold_patches.h"
#include "algebra3d/kernel/repair/detail/shell_volumes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The triangles in shells, each named by its first triangle.
DisjointIds<FaceId> shell_sets(const TriangleMesh& mesh) {
  DisjointIds<FaceId> sets = manifold_patches(mesh);
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    std::map<FaceId, int> balances;  // of each patch along the edge
    for (const HalfedgeId h : edge)
      balances[sets.find(TriangleMesh::face(h))] += mesh.origin(h) == mesh.origin(edge[0]) ? 1 : -1;
    FaceId unbalanced;
    for (const auto& [patch, balance] : balances) {
      if (balance == 0) continue;
      if (unbalanced.is_valid()) sets.unite(unbalanced, patch);
      unbalanced = patch;
    }
  }
  return sets;
}

/// Where the size of a shell lies.
struct SizeRange {
  double low, high;
  ShellId shell;
  bool is_estimate;
};

/// Measures shells. The exact volume of a large closed shell takes long, and is hardly ever needed: an estimate will do
/// if it is apart from 0 and from the sizes of all other shells.
class ShellMeasure {
 public:
  explicit ShellMeasure(const IndexedSoup& soup) : soup_(soup), mesh_(soup.mesh()) {}

  Status run(IdVector<ShellId, Shell>& shells, const Monitor& monitor) const;

 private:
  Result<SizeRange> first_range(ShellId id, Shell& shell) const;
  bool is_closed(const Shell& shell) const;
  Result<Rational> volume_of_closed(const Shell& shell) const;
  Rational volume_of_open(const Shell& shell) const;

  const IndexedSoup& soup_;
  std::shared_ptr<const TriangleMesh> mesh_;
};

/// True if along each of its edges as many triangles run one way as the other.
bool ShellMeasure::is_closed(const Shell& shell) const {
  const auto is_balanced_at = [&](HalfedgeId h) {
    if (mesh_->is_boundary(h)) return false;
    return !mesh_->is_nonmanifold(h) || is_balanced(*mesh_, mesh_->edge_halfedges(h));
  };
  return std::ranges::all_of(shell.triangles, [&](FaceId triangle) {
    return std::ranges::all_of(halfedges_of(*mesh_, triangle), is_balanced_at);
  });
}

/// With points of its own: a file may have thousands of shells.
Result<Rational> ShellMeasure::volume_of_closed(const Shell& shell) const {
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const FaceId f : shell.triangles) {
    TriangleMesh::Triangle triangle = soup_.triangles[f];
    for (std::uint32_t& corner : triangle) {
      const auto [number, is_new] = numbers.try_emplace(corner, static_cast<std::uint32_t>(points.size()));
      if (is_new) points.push_back(soup_.points[corner]);
      corner = number->second;
    }
    triangles.push_back(triangle);
  }
  return exact_volume(PointArray(std::move(points)), triangles);
}

Rational ShellMeasure::volume_of_open(const Shell& shell) const {
  const Vec3 apex = 0.5 * shell.box.min + 0.5 * shell.box.max;
  double sum = 0;
  for (const FaceId f : shell.triangles)
    sum += dot(soup_.corner(f, 0) - apex, cross(soup_.corner(f, 1) - apex, soup_.corner(f, 2) - apex));
  return std::isfinite(sum) ? Rational(sum / 6) : Rational();
}

/// Measures the shell, a large closed one by an estimate.
Result<SizeRange> ShellMeasure::first_range(ShellId id, Shell& shell) const {
  constexpr std::size_t kLarge = 1000;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool closed = is_closed(shell);
  if (closed && shell.triangles.size() >= kLarge) {
    const auto [value, error] = estimated_volume(*mesh_, shell.triangles);
    if (std::isfinite(value)) shell.volume = Rational(value);
    return SizeRange{std::abs(value) - error, std::abs(value) + error, id, true};
  }
  A3D_ASSIGN(shell.volume, closed ? volume_of_closed(shell) : volume_of_open(shell));
  const double size = std::abs(shell.volume.nearest_double());
  return SizeRange{std::nextafter(size, -kInfinity), std::nextafter(size, kInfinity), id, false};
}

Status ShellMeasure::run(IdVector<ShellId, Shell>& shells, const Monitor& monitor) const {
  std::vector<SizeRange> ranges;
  for (const ShellId id : shells.ids()) {
    A3D_TRY(monitor.check());
    A3D_ASSIGN(const SizeRange range, first_range(id, shells[id]));
    ranges.push_back(range);
  }
  std::ranges::sort(ranges, {}, [](const SizeRange& range) { return std::pair(range.low, range.shell); });
  double highest = 0;  // of those before
  for (std::size_t i = 0; i < ranges.size(); highest = std::max(highest, ranges[i++].high)) {
    const bool is_apart = ranges[i].low > highest && (i + 1 == ranges.size() || ranges[i].high < ranges[i + 1].low);
    if (!ranges[i].is_estimate || is_apart) continue;
    A3D_TRY(monitor.check());
    Shell& shell = shells[ranges[i].shell];
    A3D_ASSIGN(shell.volume, volume_of_closed(shell));
  }
  return {};
}

}  // namespace

Result<IdVector<ShellId, Shell>> find_shells(const IndexedSoup& soup, const Monitor& monitor) {
  DisjointIds<FaceId> sets = shell_sets(*soup.mesh());
  IdVector<FaceId, ShellId> shell_of(soup.triangles.size());  // of the first triangle of each
  IdVector<ShellId, Shell> shells;
  for (const FaceId triangle : soup.triangles.ids()) {
    ShellId& id = shell_of[sets.find(triangle)];
    if (id.is_none()) id = shells.push_back({});
    shells[id].triangles.push_back(triangle);
    for (std::size_t i = 0; i < 3; ++i) shells[id].box.extend(soup.corner(triangle, i));
  }
  A3D_TRY(ShellMeasure(soup).run(shells, monitor));
  return shells;
}

}  // namespace algebra3d
