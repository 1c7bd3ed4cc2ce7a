#include "algebra3d/kernel/repair/detail/shell_orientation.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/repair/detail/shells.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Says how shells lie to each other.
class ShellNesting {
 public:
  explicit ShellNesting(const IndexedSoup& soup) : soup_(soup), mesh_(soup.mesh()) {}

  /// True if all of the shell is in bodies of the others, and some of it not in their cavities, judged by its sample
  /// triangles.
  bool is_within(const Shell& shell, std::span<const Shell> others) const;
  /// The smallest of the others, which descend, that goes around all of the shell, judged by its sample triangles; null
  /// if none does.
  const Shell* enclosing_shell(const Shell& shell, std::span<const Shell> others) const;

 private:
  int winding(const Shell& shell, const PointRef& point) const;
  /// The winding numbers of shells about a triangle: of those with a positive volume, and of all.
  struct Windings {
    int of_bodies = 0, of_all = 0;
  };
  Windings windings_at(FaceId triangle, std::span<const Shell> others) const;
  std::vector<FaceId> sample_triangles(const Shell& shell) const;

  const IndexedSoup& soup_;
  std::shared_ptr<const TriangleMesh> mesh_;
};

/// The winding number of a shell about a point.
int ShellNesting::winding(const Shell& shell, const PointRef& point) const {
  int sum = 0;
  for (const FaceId triangle : shell.triangles) {
    const LineCrossing crossing = cross_vertical_line(point, mesh_->corners(triangle));
    if (crossing.side == -1) sum += crossing.sign;
  }
  return shell.is_flipped ? -sum : sum;
}

/// About the middle of the triangle. Shells may touch in corners and edges, so those decide nothing.
ShellNesting::Windings ShellNesting::windings_at(FaceId triangle, std::span<const Shell> others) const {
  const TriangleRef c = mesh_->corners(triangle);
  const ExactPoint middle(Rational(1, 3) * (c[0].rational() + c[1].rational() + c[2].rational()));
  Box3 box;
  for (const PointRef& corner : c) box.extend(corner.approx);
  Windings result;
  for (const Shell& other : others) {
    if (!other.box.intersects(box)) continue;
    const int of_other = winding(other, middle);
    result.of_all += of_other;
    if (other.volume.sign() > 0) result.of_bodies += of_other;
  }
  return result;
}

/// All triangles of the shell, or its largest ones and those with the largest and the smallest coordinates.
std::vector<FaceId> ShellNesting::sample_triangles(const Shell& shell) const {
  constexpr std::size_t kMost = 24;
  if (shell.triangles.size() <= kMost) return shell.triangles;
  std::vector<std::pair<double, FaceId>> by_area;
  for (const FaceId f : shell.triangles) by_area.emplace_back(-length(soup_.normal(f)), f);
  std::ranges::partial_sort(by_area, by_area.begin() + kMost);
  std::vector<FaceId> result;
  for (const auto& [area, f] : std::span(by_area).first(kMost)) result.push_back(f);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](FaceId f, std::size_t i) { return soup_.corner(f, i)[axis]; };
    const auto low = [&](FaceId f) { return std::min({at(f, 0), at(f, 1), at(f, 2)}); };
    const auto high = [&](FaceId f) { return std::max({at(f, 0), at(f, 1), at(f, 2)}); };
    result.push_back(*std::ranges::min_element(shell.triangles, {}, low));
    result.push_back(*std::ranges::max_element(shell.triangles, {}, high));
  }
  return result;
}

bool ShellNesting::is_within(const Shell& shell, std::span<const Shell> others) const {
  bool is_in_material = false;
  for (const FaceId f : sample_triangles(shell)) {
    const Windings windings = windings_at(f, others);
    if (windings.of_bodies <= 0) return false;
    is_in_material = is_in_material || windings.of_all > 0;
  }
  return is_in_material;
}

const Shell* ShellNesting::enclosing_shell(const Shell& shell, std::span<const Shell> others) const {
  for (std::size_t i = others.size(); i-- > 0;) {
    if (!others[i].box.contains(shell.box)) continue;
    const auto is_enclosed = [&](FaceId f) { return windings_at(f, others.subspan(i, 1)).of_all != 0; };
    if (std::ranges::all_of(sample_triangles(shell), is_enclosed)) return &others[i];
  }
  return nullptr;
}

/// True if the enclosing shell was flipped, and this one was oriented the other way: they belong together.
bool goes_along_with(const Shell* enclosing, const Shell& shell) {
  return enclosing != nullptr && enclosing->is_flipped && (enclosing->volume.sign() > 0) == (shell.volume.sign() > 0);
}

/// Flips shells that are inside out; they descend by size.
Status flip_shells(const ShellNesting& nesting, std::span<Shell> shells, const Monitor& monitor) {
  bool has_flipped = false;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const bool is_negative = shells[i].volume.sign() < 0;
    if (!is_negative && !has_flipped) continue;
    A3D_TRY(monitor.check());
    const auto larger = shells.first(i);
    const Shell* enclosing = has_flipped ? nesting.enclosing_shell(shells[i], larger) : nullptr;
    const bool goes_along = goes_along_with(enclosing, shells[i]);
    if (!goes_along && (!is_negative || nesting.is_within(shells[i], larger))) continue;
    shells[i].flip();
    has_flipped = true;
  }
  return {};
}

}  // namespace

Status orient_shells(IndexedSoup& soup, RepairReport& report, const Monitor& monitor) {
  A3D_ASSIGN(auto found, find_shells(soup, monitor));
  std::vector<Shell>& shells = found.values();
  std::ranges::stable_sort(shells, std::greater<>(), &Shell::size);
  A3D_TRY(flip_shells(ShellNesting(soup), shells, monitor));
  for (const Shell& shell : shells) {
    if (!shell.is_flipped) continue;
    report.add(RepairStep::flipped_shells, soup.corner(shell.triangles[0], 0));
    for (const FaceId triangle : shell.triangles) soup.flip(triangle);
  }
  return {};
}

}  // namespace algebra3d
