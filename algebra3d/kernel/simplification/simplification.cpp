#include "algebra3d/kernel/simplification/simplification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/simplification/detail/edge_collapser.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Rounds after which everything is locked: the result is then the mesh itself.
constexpr std::size_t kMaxRounds = 24;

/// All faces: a shell may be on the wrong side because those around it moved.
std::vector<FaceId> all_faces(const TriangleMesh& mesh) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.emplace_back(f);
  return faces;
}

/// Sets the flags of the neighbours of flagged vertices.
void grow(const TriangleMesh& mesh, std::vector<std::uint8_t>& flags) {
  const std::vector<std::uint8_t> before = flags;
  for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
    poll_interruption_at(h);
    const std::uint32_t a = mesh.origin(HalfedgeId(h)).index(), b = mesh.target(HalfedgeId(h)).index();
    flags[a] |= before[b];
    flags[b] |= before[a];
  }
}

/// Faces at which a mesh is not a valid surface: those that cross others, and degenerate ones; empty if it is one.
/// Exact. Errors: interrupted. Cost: that of prove_surface.
Result<std::vector<FaceId>> defects_of_surface(const TriangleMesh& mesh, const Monitor& monitor) {
  ProofOptions options;
  options.thoroughness = Thoroughness::first_defect;
  options.cancel = monitor.cancel();
  A3D_ASSIGN(const ValidityReport report, prove_surface(mesh, options));
  std::vector<FaceId> faces;
  if (report.is_valid()) return faces;
  A3D_ASSIGN(const std::vector<Entanglement> found, disentangle(mesh, monitor.cancel()));
  for (std::size_t f = 0; f < found.size(); ++f)
    if (found[f] != Entanglement::none) faces.emplace_back(f);
  return faces;
}

/// Faces at which a mesh is not a valid volume: as for surfaces, and those of shells on the wrong side of others.
Result<std::vector<FaceId>> defects_of_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const VolumeExamination examination, examine_volume(mesh, monitor.cancel()));
  std::vector<FaceId> faces;
  if (examination.report.is_valid()) return faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (!examination.free.contains(static_cast<std::uint32_t>(f))) faces.emplace_back(f);
  return faces.empty() ? all_faces(mesh) : faces;
}

/// Locks the vertices of `before` that were merged into corners of `defects`, faces of `after`, and those around them:
/// the more steps of neighbours, the later the round. `images`: the vertex of `after` for each vertex. `locked` is
/// empty or has a flag for each; at least one more is set afterwards.
void lock_around(const TriangleMesh& before, const TriangleMesh& after, std::span<const std::uint32_t> images,
                 std::span<const FaceId> defects, std::size_t round, std::vector<std::uint8_t>& locked) {
  const std::vector<std::uint8_t> old = locked;
  locked.resize(before.vertex_count(), 0);
  if (round >= kMaxRounds) {
    std::ranges::fill(locked, std::uint8_t{1});
    return;
  }
  std::vector<std::uint8_t> is_wrong(after.vertex_count(), 0);
  for (const FaceId f : defects)
    for (const std::uint32_t v : after.triangle(f)) is_wrong[v] = 1;
  std::vector<std::uint8_t> more(before.vertex_count(), 0);
  for (std::size_t v = 0; v < images.size(); ++v)
    if (images[v] != kNone && is_wrong[images[v]] != 0) more[v] = 1;
  for (std::size_t step = 0; step < round / 2; ++step) grow(before, more);
  for (std::size_t v = 0; v < more.size(); ++v) locked[v] |= more[v];
  // Only if the mesh itself is not valid.
  if (locked == old) std::ranges::fill(locked, std::uint8_t{1});
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Attempts to come near to a deviation from below, and to get below it at all.
constexpr std::size_t kAttempts = 4, kMaxAttempts = 12;

/// The mesh itself.
Simplification unchanged(const TriangleMesh& mesh, std::size_t repetitions) {
  Simplification result{mesh, std::vector<std::uint32_t>(mesh.vertex_count()),
                        std::vector<std::uint32_t>(mesh.face_count()), 0, repetitions};
  std::iota(result.vertices.begin(), result.vertices.end(), 0U);
  std::iota(result.faces.begin(), result.faces.end(), 0U);
  return result;
}

Simplification collapsed(EdgeCollapser& collapser, std::size_t repetitions) {
  return {collapser.result(), collapser.vertex_sources(), collapser.face_sources(), kInfinity, repetitions};
}

/// An attempt of one kind: whatever the mesh, a surface or a volume.
using Attempter = Result<Simplification> (*)(const TriangleMesh&, const CollapseLimits&, const Monitor&,
                                             const CollapseConstraints&);

Result<Simplification> any_mesh(const TriangleMesh& mesh, const CollapseLimits& limits, const Monitor& monitor,
                                const CollapseConstraints& constraints) {
  EdgeCollapser collapser(mesh, constraints, monitor);
  A3D_TRY(collapser.run(limits));
  return collapsed(collapser, 0);
}

/// The faces with defects of a simplified surface or volume.
using DefectFinder = Result<std::vector<FaceId>> (*)(const TriangleMesh&, const Monitor&);

/// The search for a valid result.
class ValidSearch {
 public:
  ValidSearch(const TriangleMesh& mesh, const CollapseLimits& limits, double crease_degrees, DefectFinder find_defects,
              const Monitor& monitor)
      : mesh_(mesh), limits_(limits), crease_degrees_(crease_degrees), find_defects_(find_defects), monitor_(monitor) {}

  Result<Simplification> run() {
    A3D_TRY(lock_until_valid());
    if (best_.repetitions > 0) A3D_TRY(try_weaker_limits());
    return std::move(best_);
  }

 private:
  /// Repeats the simplification with more and more vertices locked until the result is valid. Every defect is at a
  /// vertex that moved or had others merged into it, since the mesh itself is valid; so each time some are locked, and
  /// at the latest it ends when all are.
  Status lock_until_valid() {
    std::vector<std::uint8_t> locked;
    for (std::size_t repetitions = 0;; ++repetitions) {
      EdgeCollapser collapser(mesh_, {locked, crease_degrees_}, monitor_);
      A3D_TRY(collapser.run(limits_));
      best_ = collapsed(collapser, repetitions);
      if (repetitions == 0) wanted_ = best_.mesh.face_count();
      A3D_ASSIGN(const std::vector<FaceId> defects, defects_of(best_));
      if (defects.empty()) return {};
      if (std::ranges::count(locked, 0) == 0 && !locked.empty()) {
        best_ = unchanged(mesh_, repetitions);
        return {};
      }
      lock_around(mesh_, best_.mesh, collapser.images(), defects, repetitions, locked);
    }
  }

  /// Where walls are thin, locks spread, and more triangles may be left than with a larger number to begin with. So the
  /// numbers between the result of the limits and that of the locks are halved, four to a factor of two, without locks.
  Status try_weaker_limits() {
    constexpr double kStepsToHalf = 4;
    const auto all = static_cast<double>(mesh_.face_count());
    const auto steps_to = [&](std::size_t faces) {
      return static_cast<int>(
          std::floor(kStepsToHalf * std::log2(all / static_cast<double>(std::max<std::size_t>(faces, 1)))));
    };
    int valid = steps_to(best_.mesh.face_count()), invalid = steps_to(wanted_) + 1;
    while (invalid - valid > 1) {
      const int middle = valid + (invalid - valid) / 2;
      const auto faces = static_cast<std::size_t>(all * std::exp2(-middle / kStepsToHalf));
      EdgeCollapser collapser(mesh_, {{}, crease_degrees_}, monitor_);
      A3D_TRY(collapser.run({faces, limits_.error}));
      Simplification attempt = collapsed(collapser, best_.repetitions + 1);
      A3D_ASSIGN(const std::vector<FaceId> defects, defects_of(attempt));
      (defects.empty() ? valid : invalid) = middle;
      if (defects.empty() && attempt.mesh.face_count() < best_.mesh.face_count()) best_ = std::move(attempt);
    }
    return {};
  }

  Result<std::vector<FaceId>> defects_of(const Simplification& attempt) const {
    monitor_.tell("proving");
    return find_defects_(attempt.mesh, monitor_);
  }

  const TriangleMesh& mesh_;
  const CollapseLimits limits_;
  const double crease_degrees_;
  const DefectFinder find_defects_;
  const Monitor& monitor_;
  Simplification best_;
  std::size_t wanted_ = 0;  // faces that the limits leave without locks
};

Result<Simplification> valid_surface(const TriangleMesh& mesh, const CollapseLimits& limits, const Monitor& monitor,
                                     const CollapseConstraints& constraints) {
  return ValidSearch(mesh, limits, constraints.crease_degrees, defects_of_surface, monitor).run();
}

Result<Simplification> valid_volume(const TriangleMesh& mesh, const CollapseLimits& limits, const Monitor& monitor,
                                    const CollapseConstraints& constraints) {
  return ValidSearch(mesh, limits, constraints.crease_degrees, defects_of_volume, monitor).run();
}

Result<double> deviation_of(const DistanceOperand& before, const TriangleMesh& after, const Monitor& monitor) {
  monitor.tell("measuring the deviation");
  const BoxHierarchy hierarchy(after);
  const DistanceOperand operand{&after, &hierarchy};
  A3D_ASSIGN(const auto farthest,
             farthest_point(std::array{FarthestSearch{before, operand}, FarthestSearch{operand, before}}, monitor));
  return farthest->upper_bound;
}

/// Searches for the largest error of the quadrics with which the measured deviation is small enough.
class DeviationSearch {
 public:
  DeviationSearch(const TriangleMesh& mesh, const SimplificationTarget& target, Attempter attempter,
                  const CollapseConstraints& constraints, const Monitor& monitor)
      : mesh_(mesh),
        hierarchy_(mesh),
        target_(target),
        attempter_(attempter),
        constraints_(constraints),
        monitor_(monitor) {}

  Result<Simplification> run() {
    const double allowed = target_.deviation + 0x1p-43 * largest_coordinate(mesh_);
    double error = 2 * target_.deviation;
    for (std::size_t i = 0; i < kMaxAttempts && (i < kAttempts || !best_); ++i) {
      A3D_ASSIGN(Simplification attempt, attempter_(mesh_, {target_.triangles, error}, monitor_, constraints_));
      A3D_ASSIGN(const double deviation, deviation_of({&mesh_, &hierarchy_}, attempt.mesh, monitor_));
      const bool is_enough = attempt.mesh.face_count() <= target_.triangles;
      if (deviation <= allowed) {
        keep(std::move(attempt), deviation);
        if (is_enough || deviation > 0.9 * allowed || error == 0) break;
        low_ = error;
      } else {
        high_ = error;
      }
      error = next_error(error, deviation);
    }
    if (!best_) best_ = unchanged(mesh_, kMaxAttempts);
    return *std::move(best_);
  }

 private:
  void keep(Simplification attempt, double deviation) {
    attempt.deviation = deviation;
    if (!best_ || attempt.mesh.face_count() < best_->mesh.face_count()) best_ = std::move(attempt);
  }
  double next_error(double error, double deviation) const {
    if (low_ > 0 && high_ < kInfinity) return std::sqrt(low_ * high_);
    if (deviation == 0) return 4 * error;
    return error * std::clamp(0.9 * target_.deviation / deviation, 0.05, 8.0);
  }

  const TriangleMesh& mesh_;
  const BoxHierarchy hierarchy_;
  const SimplificationTarget target_;
  const Attempter attempter_;
  const CollapseConstraints constraints_;
  const Monitor& monitor_;
  double low_ = 0, high_ = kInfinity;
  std::optional<Simplification> best_;
};

Result<Simplification> simplified_by(Attempter attempter, const TriangleMesh& mesh, const SimplificationTarget& target,
                                     const Monitor& monitor, std::span<const std::uint8_t> locked) {
  if (mesh.face_count() <= target.triangles || mesh.is_empty()) return unchanged(mesh, 0);
  const CollapseConstraints constraints{locked, target.crease_degrees};
  if (target.deviation < kInfinity) return DeviationSearch(mesh, target, attempter, constraints, monitor).run();
  return attempter(mesh, {target.triangles, kInfinity}, monitor, constraints);
}

}  // namespace

Result<Simplification> simplified(const TriangleMesh& mesh, const SimplificationTarget& target, const Monitor& monitor,
                                  std::span<const std::uint8_t> locked) {
  return simplified_by(any_mesh, mesh, target, monitor, locked);
}

Result<Simplification> simplified_surface(const TriangleMesh& surface, const SimplificationTarget& target,
                                          const Monitor& monitor) {
  return simplified_by(valid_surface, surface, target, monitor, {});
}

Result<Simplification> simplified_volume(const TriangleMesh& volume, const SimplificationTarget& target,
                                         const Monitor& monitor) {
  return simplified_by(valid_volume, volume, target, monitor, {});
}

MeshAttributes attributes_after(const MeshAttributes& attributes, const PolygonMesh& before, const PolygonMesh& after,
                                Simplification& simplification) {
  if (attributes.is_empty()) return {};
  ElementSources sources;
  sources.halfedges.reserve(after.halfedge_count());
  for (const std::uint32_t f : simplification.faces)
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      sources.halfedges.push_back(before.halfedge(FaceId(f), corner).index());
  sources.edges = edge_sources(after, before, sources.halfedges);
  sources.vertices = std::move(simplification.vertices);
  sources.faces = std::move(simplification.faces);
  return taken_over_merged(attributes, before, after, std::move(sources), ElementBlends(before));
}

}  // namespace algebra3d
