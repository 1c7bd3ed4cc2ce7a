#include "algebra3d/arrangement/candidates.h"

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

/// Many operands: one tree over the faces of all whose boxes meet others.
void pair_faces(const Operands& operands, const Monitor& monitor, std::size_t max_pairs, FacePairs& pairs) {
  std::vector<rtree::Entry<std::uint32_t>> boxes, faces;
  for (std::uint32_t i = 0; i < operands.count(); ++i) boxes.push_back({operands.hierarchy(i).bounds(), i});
  const Tree operand_tree = Tree::bulk_load(boxes);
  for (std::uint32_t i = 0; i < operands.count(); ++i) {
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
