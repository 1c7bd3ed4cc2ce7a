#include "algebra3d/arrangement/reduction.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "algebra3d/base/parallel.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// So many are one arrangement. Smaller and larger numbers were slower (docs/decisions/0007).
constexpr std::size_t kFewSolids = 8;

enum class Operation : std::uint8_t { unite, intersect };

class Reduction {
 public:
  Reduction(Operation operation, std::span<const Operand> solids, const Monitor& monitor)
      : operation_(operation), solids_(solids.begin(), solids.end()), monitor_(monitor) {
    for (Operand& solid : solids_) solid.group = 0;
  }

  Result<TriangleMesh> run();

 private:
  bool is_crowded() const;
  static void sort_by_place(std::span<Operand> solids);
  Result<TriangleMesh> at_once(std::span<const Operand> solids, const Monitor& monitor) const;
  /// With so many threads, of which the calling one is the first.
  Result<TriangleMesh> in_halves(std::span<Operand> solids, unsigned threads, const Monitor& monitor);
  void tell(const Monitor& monitor);

  Operation operation_;
  std::vector<Operand> solids_;
  std::vector<std::unique_ptr<const BoxHierarchy>> hierarchies_;  // of solids that came without one
  Monitor monitor_;
  std::atomic<std::size_t> done_ = 0;  // of the solids
};

/// The smallest one: hierarchies have boxes of floats, in which solids that nearly touch do so.
Box3 smallest_box_of(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t i = 0; i < mesh.points().size(); ++i) box.extend(box_of(mesh.points()[i]));
  return box;
}

/// True if a solid meets more than two others on the average.
bool Reduction::is_crowded() const {
  std::vector<rtree::Entry<std::uint32_t>> boxes;
  for (std::uint32_t i = 0; i < solids_.size(); ++i) boxes.push_back({smallest_box_of(*solids_[i].mesh), i});
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(boxes);
  std::size_t count = 0;
  auto pairs = tree.self_join();
  while (count <= solids_.size() && pairs.next()) ++count;
  return count > solids_.size();
}

/// Along the longest axis of the box around their middles.
void Reduction::sort_by_place(std::span<Operand> solids) {
  const auto middle = [](const Operand& solid) {
    const Box3 box = solid.hierarchy->bounds();
    return 0.5 * box.min + 0.5 * box.max;
  };
  Box3 all;
  for (const Operand& solid : solids) all.extend(middle(solid));
  const Vec3 size = 0.5 * all.max - 0.5 * all.min;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::stable_sort(solids, {}, [&](const Operand& solid) { return middle(solid)[axis]; });
}

Result<TriangleMesh> Reduction::at_once(std::span<const Operand> solids, const Monitor& monitor) const {
  const auto needed = operation_ == Operation::unite ? 1 : static_cast<std::int32_t>(solids.size());
  return combine_solids(
      solids, [needed](const Holding& holding) { return holding[0] >= needed; }, monitor);
}

void Reduction::tell(const Monitor& monitor) {
  const char* what = operation_ == Operation::unite ? "uniting parts, " : "intersecting parts, ";
  monitor.tell(what + std::to_string(done_ * 100 / solids_.size()) + " %");
}

Result<TriangleMesh> Reduction::in_halves(std::span<Operand> solids, unsigned threads, const Monitor& monitor) {
  if (solids.size() <= kFewSolids) {
    auto result = at_once(solids, monitor.silent());
    done_ += solids.size();
    tell(monitor);
    return result;
  }
  sort_by_place(solids);
  const std::size_t half = solids.size() / 2;
  Result<TriangleMesh> first = TriangleMesh(), second = TriangleMesh();
  const bool is_shared = threads > 1;
  in_parallel(
      is_shared, [&] { first = in_halves(solids.first(half), (threads + 1) / 2, monitor); },
      [&] { second = in_halves(solids.subspan(half), threads / 2, is_shared ? monitor.silent() : monitor); });
  if (!first.ok()) return first;
  if (!second.ok()) return second;
  const std::array<Operand, 2> halves{{{&*first}, {&*second}}};
  // The last and largest step tells of itself.
  return at_once(halves, solids.size() == solids_.size() ? monitor : monitor.silent());
}

Result<TriangleMesh> Reduction::run() {
  if (solids_.size() <= kFewSolids) return at_once(solids_, monitor_);
  for (Operand& solid : solids_) {
    if (solid.hierarchy != nullptr) continue;
    std::vector<std::uint32_t> faces(solid.mesh->face_count());
    std::iota(faces.begin(), faces.end(), 0U);
    hierarchies_.push_back(std::make_unique<const BoxHierarchy>(*solid.mesh, std::move(faces)));
    solid.hierarchy = hierarchies_.back().get();
  }
  if (!is_crowded()) return at_once(solids_, monitor_);
  return in_halves(solids_, std::max(1U, std::thread::hardware_concurrency()), monitor_);
}

}  // namespace

Result<TriangleMesh> unite_solids(std::span<const Operand> solids, const Monitor& monitor) {
  return Reduction(Operation::unite, solids, monitor).run();
}

Result<TriangleMesh> intersect_solids(std::span<const Operand> solids, const Monitor& monitor) {
  return Reduction(Operation::intersect, solids, monitor).run();
}

}  // namespace algebra3d
