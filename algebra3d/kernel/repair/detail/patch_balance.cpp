#include "algebra3d/kernel/repair/detail/patch_balance.h"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <vector>

namespace algebra3d {
namespace {

using SeamId = StrongId<struct SeamTag>;

/// The contribution of one patch to the balance of an edge.
struct PatchShare {
  ManifoldPatchId patch;
  int balance;
};

/// An edge of more than two triangles.
struct Seam {
  double length;
  int balance = 0;  ///< triangles that run one way, less those that run the other way
  std::vector<PatchShare> shares;

  PatchShare* find(ManifoldPatchId patch) {
    const auto found = std::ranges::find(shares, patch, &PatchShare::patch);
    return found == shares.end() ? nullptr : &*found;
  }
  void add(ManifoldPatchId patch, int direction) {
    balance += direction;
    if (PatchShare* known = find(patch); known != nullptr)
      known->balance += direction;
    else
      shares.push_back({patch, direction});
  }
  /// How much shorter the unbalanced edges would be if the patch were flipped.
  double gain(ManifoldPatchId patch) {
    return length * (std::abs(balance) - std::abs(balance - 2 * find(patch)->balance));
  }
  void flip(ManifoldPatchId patch) {
    PatchShare& share = *find(patch);
    balance -= 2 * share.balance;
    share.balance = -share.balance;
  }
};

class PatchBalance {
 public:
  explicit PatchBalance(const OrientedPatches& patches) : seams_of_(patches.count()), flips_(patches.count()) {
    const TriangleMesh& mesh = patches.mesh();
    for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
      if (const auto edge = mesh.nonmanifold_edge(n); edge.size() > 2) add_seam(patches, edge);
  }

  IdVector<ManifoldPatchId, bool> run();

 private:
  void add_seam(const OrientedPatches& patches, std::span<const HalfedgeId> edge);
  bool flip_if_better(ManifoldPatchId patch);

  IdVector<SeamId, Seam> seams_;
  IdVector<ManifoldPatchId, std::vector<SeamId>> seams_of_;  // where the patch has a share other than 0
  IdVector<ManifoldPatchId, bool> flips_;
};

void PatchBalance::add_seam(const OrientedPatches& patches, std::span<const HalfedgeId> edge) {
  const TriangleMesh& mesh = patches.mesh();
  Seam seam{length(mesh.point(mesh.target(edge[0])).approx - mesh.point(mesh.origin(edge[0])).approx), 0, {}};
  for (const HalfedgeId h : edge) seam.add(patches.of(TriangleMesh::face(h)), patches.direction(h, edge[0]));
  for (const auto& [patch, balance] : seam.shares)
    if (balance != 0) seams_of_[patch].push_back(seams_.next_id());
  seams_.push_back(std::move(seam));
}

bool PatchBalance::flip_if_better(ManifoldPatchId patch) {
  double gain = 0;
  for (const SeamId seam : seams_of_[patch]) gain += seams_[seam].gain(patch);
  if (!(gain > 0)) return false;
  flips_[patch] = !flips_[patch];
  for (const SeamId seam : seams_of_[patch]) seams_[seam].flip(patch);
  return true;
}

IdVector<ManifoldPatchId, bool> PatchBalance::run() {
  constexpr int kMostPasses = 20;
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMostPasses; ++pass) {
    has_changed = false;
    for (const ManifoldPatchId patch : flips_.ids()) has_changed = flip_if_better(patch) || has_changed;
  }
  return flips_;
}

}  // namespace

void balance_patches(OrientedPatches& patches) {
  patches.flip(PatchBalance(patches).run());
}

}  // namespace algebra3d
