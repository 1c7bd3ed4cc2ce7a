#include "queries/streams/detail/partitioned_boxes.h"

#include <algorithm>
#include <utility>

#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/tuple_buffer.h"
#include "rtree/rtree.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::Context;
using algebra3d::MemoryAccount;
using algebra3d::Vec3;
using Tree = rtree::RTree<std::uint64_t>;
using Entry = rtree::Entry<std::uint64_t>;

constexpr std::size_t kMostParts = 1024, kSampleSize = 8192;

/// The low corner of what two boxes have in common.
Vec3 common_corner(const Box3& a, const Box3& b) {
  return {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)};
}

/// How much of the work memory this operator may expect.
std::size_t room_of(const Context& context) {
  return std::max(context.memory != nullptr ? context.memory->left() / 3 : 0, MemoryAccount::kLeast);
}

/// Enough that a block takes some kilobytes, unless many of them are to share the room.
template <typename Record>
std::size_t records_in_block(const Context& context, std::size_t sequences) {
  return std::clamp<std::size_t>(room_of(context) / 4 / sequences, 512, 16384) / sizeof(Record);
}

}  // namespace

Result<PartitionedBoxes::Side> PartitionedBoxes::make_side(const Context& context) {
  A3D_ASSIGN(auto tuples, TupleFile::make(context));
  A3D_ASSIGN(auto boxes, RecordSequences<PlacedBox>::make(context, records_in_block<PlacedBox>(context, 1)));
  boxes.add_sequence();
  return Side{std::move(tuples), std::move(boxes)};
}

Result<std::unique_ptr<PartitionedBoxes>> PartitionedBoxes::make(bool is_of_one_side, const Context& context) {
  A3D_ASSIGN(Side build, make_side(context));
  A3D_ASSIGN(Side probe, make_side(context));
  if (is_of_one_side) probe.tuples = build.tuples;
  return std::unique_ptr<PartitionedBoxes>(
      new PartitionedBoxes(is_of_one_side, std::move(build), std::move(probe), context));
}

Status PartitionedBoxes::add_build(const Tuple& tuple, const Box3& box) {
  sample(box);
  A3D_TRY(build_.boxes.append(0, {box, build_.tuples->end()}));
  if (is_of_one_side_) probe_place_ = build_.tuples->end();
  return build_.tuples->append(tuple);
}

Status PartitionedBoxes::add_probe(const Tuple& tuple, const Box3& window) {
  if (is_of_one_side_) return probe_.boxes.append(0, {window, probe_place_});
  sample(window);
  A3D_TRY(probe_.boxes.append(0, {window, probe_.tuples->end()}));
  return probe_.tuples->append(tuple);
}

/// Each box is in the sample with the same probability [vitter1985].
void PartitionedBoxes::sample(const Box3& box) {
  ++sampled_from_;
  if (sample_.size() < kSampleSize) {
    sample_.push_back(box);
  } else if (const std::uint64_t place = dice_() % sampled_from_; place < kSampleSize) {
    sample_[place] = box;
  }
}

Status PartitionedBoxes::join() {
  // A third more than needed, since parts are not equally large.
  const std::size_t needed = build_.boxes.size(0) * kBytesOfEntry / 3 * 4 / room_of(context_) + 1;
  const SpacePartition parts(std::exchange(sample_, {}), std::min(needed, kMostParts));
  A3D_ASSIGN(const auto build, divide(build_.boxes, parts));
  A3D_ASSIGN(const auto probe, divide(probe_.boxes, parts));
  A3D_ASSIGN(pairs_,
             RecordSequences<PlacedPair>::make(context_, records_in_block<PlacedPair>(context_, parts.count())));
  for (std::size_t part = 0; part < parts.count(); ++part) A3D_TRY(join_part(build, probe, parts, part));
  return begin_merge();
}

/// A sequence for each part, in the order in which the boxes were added.
auto PartitionedBoxes::divide(const RecordSequences<PlacedBox>& boxes, const SpacePartition& parts) const
    -> Result<RecordSequences<PlacedBox>> {
  A3D_ASSIGN(auto result,
             RecordSequences<PlacedBox>::make(context_, records_in_block<PlacedBox>(context_, 2 * parts.count())));
  for (std::size_t part = 0; part < parts.count(); ++part) result.add_sequence();
  auto reader = boxes.read(0);
  for (std::uint32_t step = 1;; ++step) {
    if (step % 4096 == 0) A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(const PlacedBox* const placed, reader.next());
    if (placed == nullptr) return result;
    A3D_TRY(parts.for_each(placed->box, [&](std::size_t part) { return result.append(part, *placed); }));
  }
}

/// Makes a sequence of the pairs of a part, in their order; more than one if its boxes do not fit into memory at once.
Status PartitionedBoxes::join_part(const RecordSequences<PlacedBox>& build, const RecordSequences<PlacedBox>& probe,
                                   const SpacePartition& parts, std::size_t part) {
  auto boxes = build.read(part);
  A3D_ASSIGN(const PlacedBox* next, boxes.next());
  while (next != nullptr) {
    MemoryAccount account(context_.memory);
    std::vector<PlacedBox> held;
    std::vector<Entry> entries;
    while (next != nullptr && (account.take(kBytesOfEntry + sizeof(PlacedBox)) || held.empty())) {
      entries.push_back({next->box, held.size()});
      held.push_back(*next);
      A3D_ASSIGN(next, boxes.next());
    }
    const Tree tree = Tree::bulk_load(std::move(entries));
    const std::size_t run = pairs_->count();
    pairs_->add_sequence();
    auto windows = probe.read(part);
    while (true) {
      if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const PlacedBox* const window, windows.next());
      if (window == nullptr) break;
      for (const std::uint64_t i : ids_in_window(tree, window->box)) {
        const PlacedBox& found = held[i];
        if (is_of_one_side_ && found.place >= window->place) continue;
        if (parts.part_of(common_corner(found.box, window->box)) != part) continue;
        A3D_TRY(pairs_->append(run, {window->place, found.place}));
      }
    }
  }
  return {};
}

Status PartitionedBoxes::begin_merge() {
  for (std::size_t run = 0; run < pairs_->count(); ++run) {
    readers_.push_back(pairs_->read(run));
    A3D_ASSIGN(const PlacedPair* const first, readers_.back().next());
    if (first != nullptr) runs_.push({*first, run});
  }
  build_scan_ = build_.tuples->scan(0, build_.tuples->end());
  probe_scan_ = probe_.tuples->scan(0, probe_.tuples->end());
  return {};
}

Result<TuplePair> PartitionedBoxes::next() {
  if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
  if (runs_.empty()) return TuplePair();
  const Run run = runs_.top();
  runs_.pop();
  A3D_ASSIGN(const PlacedPair* const following, readers_[run.reader].next());
  if (following != nullptr) runs_.push({*following, run.reader});
  if (probe_tuple_ == nullptr || probe_place_ != run.first.probe) {
    A3D_ASSIGN(probe_tuple_, probe_scan_->at(run.first.probe));
    probe_place_ = run.first.probe;
  }
  A3D_ASSIGN(TuplePtr build, build_tuple(run.first.build));
  return TuplePair{std::move(build), probe_tuple_};
}

/// Tuples are partners of several, and are kept while an eighth of the room lasts.
Result<TuplePtr> PartitionedBoxes::build_tuple(std::uint64_t place) {
  if (const auto known = kept_.find(place); known != kept_.end()) return known->second;
  A3D_ASSIGN(TuplePtr tuple, build_scan_->at(place));
  if (kept_bytes_ > room_of(context_) / 8) {
    kept_.clear();
    kept_bytes_ = 0;
  }
  kept_bytes_ += heap_bytes(*tuple);
  kept_.emplace(place, tuple);
  return tuple;
}

}  // namespace queries
