#include "algebra3d/arrangement/candidates.h"

#include <algorithm>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/parallel.h"
#include "algebra3d/halfedge/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {
namespace {

using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using Tree = rtree::RTree<std::uint32_t>;

void pair_two(const Operands& operands, std::uint32_t a, std::uint32_t b, BoxHierarchy::Share share,
              const Monitor& monitor, std::size_t max_pairs, FacePairs& pairs) {
  operands.hierarchy(a).for_each_pair_with(
      operands.hierarchy(b),
      [&](std::uint32_t f, std::uint32_t g) {
        pairs.emplace_back(operands.first_face(a) + f, operands.first_face(b) + g);
        return pairs.size() <= max_pairs;
      },
      [&] { return !monitor.is_cancelled(); }, share);
}

/// Few operands: the hierarchy of each against that of each other one.
void pair_operands(const Operands& operands, const Monitor& monitor, std::size_t max_pairs, FacePairs& pairs) {
  constexpr std::size_t kFacesWorthAThread = 1500;
  const bool is_large = operands.face_count() >= kFacesWorthAThread;
  FacePairs others;
  for (std::uint32_t a = 0; a < operands.count(); ++a)
    for (std::uint32_t b = a + 1; b < operands.count(); ++b) {
      in_parallel(
          is_large,
          [&] {
            pair_two(operands, a, b, {0, 2}, monitor, max_pairs, pairs);
          },
          [&] {
            pair_two(operands, a, b, {1, 2}, monitor, max_pairs, others);
          });
      pairs.insert(pairs.end(), others.begin(), others.end());
      others.clear();
      if (pairs.size() > max_pairs) return;
    }
}

/// The operand that has more faces than all others together, if it is worth a search of its own; else kNone.
std::uint32_t dominant_operand(const Operands& operands) {
  for (std::uint32_t i = 0; i < operands.count(); ++i)
    if (operands.mesh(i).face_count() > std::max(operands.face_count() / 2, kWorthAThread)) return i;
  return kNone;
}

/// One operand against all others that its box meets.
void pair_with_others(const Operands& operands, std::uint32_t one, const Tree& operand_tree, const Monitor& monitor,
                      std::size_t max_pairs, FacePairs& pairs) {
  for (const std::uint32_t other : operand_tree.window(operands.hierarchy(one).bounds())) {
    if (other == one) continue;
    pair_two(operands, std::min(one, other), std::max(one, other), {0, 1}, monitor, max_pairs, pairs);
    if (monitor.is_cancelled() || pairs.size() > max_pairs) return;
  }
}

/// Many operands: one tree over the faces of all whose boxes meet others. Where one operand has nearly all faces and
/// few of them are near others, its hierarchy finds these sooner.
void pair_faces(const Operands& operands, const Monitor& monitor, std::size_t max_pairs, FacePairs& pairs) {
  std::vector<rtree::Entry<std::uint32_t>> boxes, faces;
  for (std::uint32_t i = 0; i < operands.count(); ++i) boxes.push_back({operands.hierarchy(i).bounds(), i});
  const Tree operand_tree = Tree::bulk_load(boxes);
  const std::uint32_t dominant = dominant_operand(operands);
  if (dominant != kNone) pair_with_others(operands, dominant, operand_tree, monitor, max_pairs, pairs);
  for (std::uint32_t i = 0; i < operands.count(); ++i) {
    if (i == dominant) continue;
    auto meeting = operand_tree.window(boxes[i].box);
    const bool is_alone = !(meeting.next() && meeting.next());
    for (std::uint32_t f = 0; !is_alone && f < operands.mesh(i).face_count(); ++f)
      faces.push_back({box_of_triangle(operands.mesh(i).corners(FaceId(f))), operands.first_face(i) + f});
  }
  const Tree face_tree = Tree::bulk_load(faces);
  auto join = face_tree.self_join();
  const auto goes_on = [&] { return !monitor.is_cancelled() && pairs.size() <= max_pairs; };
  for (auto batch = join.next_batch(); !batch.empty() && goes_on(); batch = join.next_batch())
    for (const auto& pair : batch)
      if (operands.operand_of_face(pair.first) != operands.operand_of_face(pair.second))
        pairs.emplace_back(pair.first, pair.second);
}

}  // namespace

Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> candidate_pairs(const Operands& operands,
                                                                             const Monitor& monitor,
                                                                             std::size_t max_pairs) {
  constexpr std::size_t kFewOperands = 8;
  FacePairs pairs;
  monitor.tell("finding what is near");
  if (operands.count() <= kFewOperands)
    pair_operands(operands, monitor, max_pairs, pairs);
  else
    pair_faces(operands, monitor, max_pairs, pairs);
  RETURN_IF_ERROR(monitor.check());
  if (pairs.size() > max_pairs)
    return Error{ErrorCode::limit_exceeded, "more than {} pairs of triangles may touch", max_pairs};
  return pairs;
}

}  // namespace algebra3d::arrangement
