#include "algebra3d/geometry/box_index.h"

#include <new>

#include "base/nearest_rounding.h"
#include "rtree/rtree.h"

namespace algebra3d {

struct BoxIndex::Tree {
  rtree::RTree<Number> entries;
};

namespace {

std::vector<std::pair<BoxIndex::Number, BoxIndex::Number>> all_pairs(rtree::JoinCursor<BoxIndex::Number> cursor) {
  std::vector<std::pair<BoxIndex::Number, BoxIndex::Number>> pairs;
  for (auto batch = cursor.next_batch(); !batch.empty(); batch = cursor.next_batch())
    for (const auto& [first, second] : batch) pairs.emplace_back(first, second);
  return pairs;
}

}  // namespace

const BoxIndex::Tree& BoxIndex::tree() const {
  static const Tree empty;
  return tree_ ? *tree_ : empty;
}

BoxIndex::BoxIndex() = default;
BoxIndex::~BoxIndex() = default;
BoxIndex::BoxIndex(BoxIndex&& other) noexcept = default;
BoxIndex& BoxIndex::operator=(BoxIndex&& other) noexcept = default;

BoxIndex::BoxIndex(std::span<const Box3> boxes) : tree_(std::make_unique<Tree>()) {
  if (boxes.size() > kMaxBoxes) throw std::bad_alloc();
  const NearestRounding rounding;
  std::vector<rtree::Entry<Number>> entries;
  entries.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) entries.push_back({boxes[i], i});
  tree_->entries = rtree::RTree<Number>::bulk_load(entries);
}

std::size_t BoxIndex::size() const {
  return tree().entries.size();
}

bool BoxIndex::insert(const Box3& box, Number number) {
  if (!tree_) tree_ = std::make_unique<Tree>();
  return tree_->entries.insert(box, number);
}

bool BoxIndex::erase(const Box3& box, Number number) {
  return tree_ && tree_->entries.erase(box, number);
}

std::vector<BoxIndex::Number> BoxIndex::meeting(const Box3& window) const {
  std::vector<Number> numbers;
  for (const Number number : tree().entries.window(window)) numbers.push_back(number);
  return numbers;
}

std::vector<BoxIndex::Neighbour> BoxIndex::nearest(const Box3& box, std::size_t limit) const {
  const NearestRounding rounding;
  std::vector<Neighbour> neighbours;
  auto cursor = tree().entries.nearest(box, limit);
  while (const auto next = cursor.next()) neighbours.push_back({next->payload, next->distance});
  return neighbours;
}

std::vector<std::pair<BoxIndex::Number, BoxIndex::Number>> BoxIndex::meeting_pairs() const {
  return all_pairs(tree().entries.self_join());
}

std::vector<std::pair<BoxIndex::Number, BoxIndex::Number>> BoxIndex::meeting_pairs(const BoxIndex& other) const {
  return all_pairs(tree().entries.join(other.tree().entries));
}

}  // namespace algebra3d
