#include "algebra3d/arrangement/candidates.h"

#include <algorithm>

#include "algebra3d/arrangement/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {
namespace {

/// The places in which an operand meets boxes of others: one box for each such operand, or one around them all.
std::vector<std::vector<Box3>> meeting_places(const Operands& operands) {
  constexpr std::size_t kMostPlaces = 16;
  std::vector<rtree::Entry<std::uint32_t>> boxes;
  for (std::uint32_t i = 0; i < operands.count(); ++i) boxes.push_back({box_of_mesh(operands.mesh(i)), i});
  std::vector<std::vector<Box3>> places(operands.count());
  const auto add = [&](std::uint32_t operand, const Box3& place) {
    if (places[operand].size() < kMostPlaces)
      places[operand].push_back(place);
    else
      places[operand].back().extend(place);
  };
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(boxes);
  auto meeting = tree.self_join();
  while (const auto pair = meeting.next()) {
    const Box3 common = intersect(boxes[pair->first].box, boxes[pair->second].box);
    add(pair->first, common);
    add(pair->second, common);
  }
  return places;
}

}  // namespace

Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> candidate_pairs(const Operands& operands,
                                                                             const std::atomic<bool>* cancel) {
  const std::vector<std::vector<Box3>> places = meeting_places(operands);
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t i = 0; i < operands.count(); ++i) {
    if (places[i].empty()) continue;
    for (std::size_t f = 0; f < operands.mesh(i).face_count(); ++f) {
      const Box3 box = box_of_triangle(operands.mesh(i).corners(FaceId(f)));
      if (std::ranges::any_of(places[i], [&](const Box3& place) { return place.intersects(box); }))
        entries.push_back({box, operands.first_face(i) + static_cast<std::uint32_t>(f)});
    }
  }
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  auto join = tree.self_join();
  for (auto batch = join.next_batch(); !batch.empty(); batch = join.next_batch()) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed))
      return Error{ErrorCode::interrupted, "interrupted"};
    for (const auto& pair : batch)
      if (operands.operand_of_face(pair.first) != operands.operand_of_face(pair.second))
        pairs.emplace_back(pair.first, pair.second);
  }
  return pairs;
}

}  // namespace algebra3d::arrangement
