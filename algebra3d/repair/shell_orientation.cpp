#include "algebra3d/repair/shell_orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algebra3d/exact/exact_sum.h"
#include "algebra3d/exact/vertical_line.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/facet_parts.h"
#include "algebra3d/repair/shell_volumes.h"

namespace algebra3d {
namespace {

struct OrientedShell {
  std::vector<std::uint32_t> facets;
  /// Of large shells perhaps rounded, but then neither the sign nor the order by size depends on it.
  Rational volume;
  bool is_turned = false;
  Box3 box;
};

class ShellOrientation {
 public:
  ShellOrientation(FacetList& facets, RepairReport& report)
      : facets_(facets), report_(report), linked_(facets.mesh()), mesh_(*linked_) {}

  Status run(const Monitor& monitor);

 private:
  arrangement::DisjointSets parts() const;
  Result<std::vector<OrientedShell>> find_shells(const Monitor& monitor) const;
  Status measure(std::vector<OrientedShell>& shells, const Monitor& monitor) const;
  bool is_closed(const OrientedShell& shell) const;
  Result<Rational> volume_of_closed(const OrientedShell& shell) const;
  Rational volume_of_open(const OrientedShell& shell) const;
  void turn(OrientedShell& shell);
  int winding(const OrientedShell& shell, const PointRef& point) const;
  std::vector<std::uint32_t> telling_facets(const OrientedShell& shell) const;
  template <typename IsEnough>
  bool is_all(const OrientedShell& shell, std::span<const OrientedShell> others, IsEnough is_enough) const;
  bool is_within(const OrientedShell& shell, std::span<const OrientedShell> others) const;
  const OrientedShell* shell_around(const OrientedShell& shell, std::span<const OrientedShell> others) const;
  void apply(const std::vector<OrientedShell>& shells);

  FacetList& facets_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> linked_;  // the facets as given
  const TriangleMesh& mesh_;
};

/// Facets of a shell are in one set.
arrangement::DisjointSets ShellOrientation::parts() const {
  arrangement::DisjointSets sets = parts_across_simple_edges(mesh_);
  for (std::size_t n = 0; n < mesh_.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh_.nonmanifold_edge(n);
    std::map<std::uint32_t, int> balances;
    for (const HalfedgeId h : edge)
      balances[sets.find(h.index() / 3)] += mesh_.origin(h) == mesh_.origin(edge[0]) ? 1 : -1;
    std::optional<std::uint32_t> unbalanced;
    for (const auto& [part, balance] : balances) {
      if (balance == 0) continue;
      if (unbalanced) sets.unite(*unbalanced, part);
      unbalanced = part;
    }
  }
  return sets;
}

Result<std::vector<OrientedShell>> ShellOrientation::find_shells(const Monitor& monitor) const {
  arrangement::DisjointSets sets = parts();
  std::map<std::uint32_t, std::size_t> numbers;
  std::vector<OrientedShell> shells;
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
    const auto [number, is_new] = numbers.try_emplace(sets.find(f), shells.size());
    if (is_new) shells.emplace_back();
    shells[number->second].facets.push_back(f);
  }
  for (OrientedShell& shell : shells)
    for (const std::uint32_t f : shell.facets)
      for (std::size_t i = 0; i < 3; ++i) shell.box.extend(facets_.corner(f, i));
  RETURN_IF_ERROR(measure(shells, monitor));
  return shells;
}

/// The exact volume of a large closed shell takes long, and is hardly ever needed: its estimate will do if it is apart
/// from 0 and from the sizes of all other shells.
Status ShellOrientation::measure(std::vector<OrientedShell>& shells, const Monitor& monitor) const {
  constexpr std::size_t kLarge = 1000;
  /// Where the size of a shell lies.
  struct Range {
    double low, high;
    std::uint32_t shell;
    bool is_estimate;
  };
  std::vector<Range> ranges;
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    OrientedShell& shell = shells[i];
    RETURN_IF_ERROR(monitor.check());
    const bool closed = is_closed(shell);
    if (closed && shell.facets.size() >= kLarge) {
      const auto [value, error] = estimated_volume(mesh_, shell.facets);
      ranges.push_back({std::abs(value) - error, std::abs(value) + error, i, true});
      if (std::isfinite(value)) shell.volume = Rational(value);
      continue;
    }
    ASSIGN_OR_RETURN(shell.volume, closed ? volume_of_closed(shell) : volume_of_open(shell));
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double size = std::abs(shell.volume.nearest_double());
    ranges.push_back({std::nextafter(size, -kInfinity), std::nextafter(size, kInfinity), i, false});
  }
  std::ranges::sort(ranges, {}, [](const Range& range) { return std::pair(range.low, range.shell); });
  double highest = 0;  // of those before
  for (std::size_t i = 0; i < ranges.size(); highest = std::max(highest, ranges[i++].high)) {
    const bool is_apart = ranges[i].low > highest && (i + 1 == ranges.size() || ranges[i].high < ranges[i + 1].low);
    if (!ranges[i].is_estimate || is_apart) continue;
    RETURN_IF_ERROR(monitor.check());
    OrientedShell& shell = shells[ranges[i].shell];
    ASSIGN_OR_RETURN(shell.volume, volume_of_closed(shell));
  }
  return {};
}

/// True if along each of its edges as many facets run one way as the other.
bool ShellOrientation::is_closed(const OrientedShell& shell) const {
  for (const std::uint32_t f : shell.facets)
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const HalfedgeId halfedge(h);
      if (mesh_.is_boundary(halfedge)) return false;
      if (!mesh_.is_nonmanifold(halfedge)) continue;
      if (!is_balanced(mesh_, mesh_.edge_halfedges(halfedge))) return false;
    }
  return true;
}

/// Of its own points alone: a file may have thousands of shells.
Result<Rational> ShellOrientation::volume_of_closed(const OrientedShell& shell) const {
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const std::uint32_t f : shell.facets) {
    TriangleMesh::Triangle triangle = facets_.triangles[f];
    for (std::uint32_t& corner : triangle) {
      const auto [number, is_new] = numbers.try_emplace(corner, static_cast<std::uint32_t>(points.size()));
      if (is_new) points.push_back(facets_.points[corner]);
      corner = number->second;
    }
    triangles.push_back(triangle);
  }
  return exact_volume(PointArray(std::move(points)), triangles);
}

Rational ShellOrientation::volume_of_open(const OrientedShell& shell) const {
  const Vec3 top = 0.5 * shell.box.min + 0.5 * shell.box.max;
  double sum = 0;
  for (const std::uint32_t f : shell.facets)
    sum += dot(facets_.corner(f, 0) - top, cross(facets_.corner(f, 1) - top, facets_.corner(f, 2) - top));
  return std::isfinite(sum) ? Rational(sum / 6) : Rational();
}

void ShellOrientation::turn(OrientedShell& shell) {
  shell.is_turned = !shell.is_turned;
  shell.volume = -shell.volume;
}

/// Of the shell about the point.
int ShellOrientation::winding(const OrientedShell& shell, const PointRef& point) const {
  int sum = 0;
  for (const std::uint32_t f : shell.facets) {
    const LineCrossing crossing = cross_vertical_line(point, mesh_.corners(FaceId(f)));
    if (crossing.side == -1) sum += crossing.sign;
  }
  return shell.is_turned ? -sum : sum;
}

/// Of the shell: all, or its largest ones and those with the largest and the smallest coordinates.
std::vector<std::uint32_t> ShellOrientation::telling_facets(const OrientedShell& shell) const {
  constexpr std::size_t kMost = 24;
  if (shell.facets.size() <= kMost) return shell.facets;
  const auto negative_area = [&](std::uint32_t f) {
    return -length(cross(facets_.corner(f, 1) - facets_.corner(f, 0), facets_.corner(f, 2) - facets_.corner(f, 0)));
  };
  std::vector<std::pair<double, std::uint32_t>> by_area;
  for (const std::uint32_t f : shell.facets) by_area.emplace_back(negative_area(f), f);
  std::ranges::partial_sort(by_area, by_area.begin() + kMost);
  std::vector<std::uint32_t> result;
  for (const auto& [area, f] : std::span(by_area).first(kMost)) result.push_back(f);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto low = [&](std::uint32_t f) {
      return std::min({facets_.corner(f, 0)[axis], facets_.corner(f, 1)[axis], facets_.corner(f, 2)[axis]});
    };
    const auto high = [&](std::uint32_t f) {
      return std::max({facets_.corner(f, 0)[axis], facets_.corner(f, 1)[axis], facets_.corner(f, 2)[axis]});
    };
    result.push_back(*std::ranges::min_element(shell.facets, {}, low));
    result.push_back(*std::ranges::max_element(shell.facets, {}, high));
  }
  return result;
}

/// True if that is enough how often the others go round each of the facets that tell where the shell lies.
template <typename IsEnough>
bool ShellOrientation::is_all(const OrientedShell& shell, std::span<const OrientedShell> others,
                              IsEnough is_enough) const {
  return std::ranges::all_of(telling_facets(shell), [&](std::uint32_t f) {
    const TriangleRef facet = mesh_.corners(FaceId(f));
    // Shells may touch in corners and edges, so those decide nothing.
    const ExactPoint middle(Rational(1, 3) * (facet[0].rational() + facet[1].rational() + facet[2].rational()));
    Box3 box;
    for (const PointRef& corner : facet) box.extend(corner.approx);
    int around = 0;
    for (const OrientedShell& other : others)
      if (other.box.intersects(box)) around += winding(other, middle);
    return is_enough(around);
  });
}

/// True if the others hold all of the shell, as far as those facets can tell.
bool ShellOrientation::is_within(const OrientedShell& shell, std::span<const OrientedShell> others) const {
  return is_all(shell, others, [](int winding) { return winding > 0; });
}

/// The smallest of the others, which descend, that goes round all of the shell, as far as those facets can tell; null
/// if none does.
const OrientedShell* ShellOrientation::shell_around(const OrientedShell& shell,
                                                    std::span<const OrientedShell> others) const {
  for (std::size_t i = others.size(); i-- > 0;)
    if (others[i].box.contains(shell.box) &&
        is_all(shell, others.subspan(i, 1), [](int winding) { return winding != 0; }))
      return &others[i];
  return nullptr;
}

Status ShellOrientation::run(const Monitor& monitor) {
  ASSIGN_OR_RETURN(std::vector<OrientedShell> shells, find_shells(monitor));
  const auto size = [](const OrientedShell& shell) { return shell.volume.sign() < 0 ? -shell.volume : shell.volume; };
  std::ranges::stable_sort(shells, [&](const OrientedShell& a, const OrientedShell& b) { return size(a) > size(b); });
  bool has_turned = false;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const bool is_negative = shells[i].volume.sign() < 0;
    if (!is_negative && !has_turned) continue;
    RETURN_IF_ERROR(monitor.check());
    const auto larger = std::span(shells).first(i);
    // What was turned inside out is so with all that is in it.
    const OrientedShell* around = has_turned ? shell_around(shells[i], larger) : nullptr;
    const bool goes_along =
        around != nullptr && around->is_turned && (around->volume.sign() > 0) == (shells[i].volume.sign() > 0);
    if (!goes_along && (!is_negative || is_within(shells[i], larger))) continue;
    turn(shells[i]);
    has_turned = true;
  }
  apply(shells);
  return {};
}

void ShellOrientation::apply(const std::vector<OrientedShell>& shells) {
  for (const OrientedShell& shell : shells) {
    if (!shell.is_turned) continue;
    report_.add(RepairStep::turned_shells, facets_.corner(shell.facets[0], 0));
    for (const std::uint32_t f : shell.facets) std::swap(facets_.triangles[f][1], facets_.triangles[f][2]);
    facets_.changed();
  }
}

}  // namespace

Status orient_shells(FacetList& facets, RepairReport& report, const Monitor& monitor) {
  return ShellOrientation(facets, report).run(monitor);
}

}  // namespace algebra3d
