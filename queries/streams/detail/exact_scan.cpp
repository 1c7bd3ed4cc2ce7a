#include "queries/streams/detail/exact_scan.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "base/propagate.h"
#include "queries/streams/detail/index_operands.h"
#include "queries/streams/detail/nearest_entries.h"
#include "queries/streams/detail/nearest_search.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {
namespace {

using algebra3d::Rational;

class ExactDistanceScan final : public TupleStream {
 public:
  ExactDistanceScan(IndexSearch search, Value to, std::uint64_t limit, const Context& context)
      : search_(std::move(search)),
        to_(std::move(to)),
        left_(limit),
        context_(context),
        examiner_(context),
        candidates_(search_.index, window_of(to_)) {}

  Result<TuplePtr> next() override {
    if (left_ == 0) return TuplePtr();
    if (!std::exchange(is_started_, true)) {
      A3D_ASSIGN(pending_, candidates_.next());
    }
    while (pending_ &&
           (near_.empty() || may_be_within(pending_->distance, distance_bound(*near_.front().squared_distance))))
      A3D_TRY(take_candidates());
    if (near_.empty()) return TuplePtr();
    --left_;
    std::ranges::pop_heap(near_, is_after);
    TuplePtr result = std::move(near_.back().tuple);
    near_.pop_back();
    return result;
  }
  std::vector<StageCount> stages() const override {
    return {{"exact distances", distance_count_}, {"geometries loaded", examiner_.load_count()}};
  }

 private:
  static constexpr std::size_t kLargestBatch = 1024;

  static bool is_after(const NearTuple& a, const NearTuple& b) { return b.is_before(a); }
  bool is_as_far(const Tuple& tuple, const rtree::Neighbor<std::uint64_t>& entry) const {
    return has_box_at(tuple.attributes[search_.attribute], window_of(to_), entry.distance);
  }

  /// The next candidates by their boxes, more and more at a time, with their distances.
  Status take_candidates() {
    A3D_TRY(context_.check_cancelled());
    std::vector<TuplePtr> tuples;
    std::vector<ValuePair> pairs;
    while (pending_ && tuples.size() < batch_) {
      A3D_ASSIGN(TuplePtr tuple,
                 indexed_tuple(*search_.relation, *search_.index, static_cast<TupleId>(pending_->payload),
                               [&](const Tuple& each) { return is_as_far(each, *pending_); }));
      A3D_ASSIGN(pending_, candidates_.next());
      // A frozen index may know tuples that have changed since.
      if (tuple == nullptr || window_of(tuple->attributes[search_.attribute]).is_empty()) continue;
      pairs.push_back({&to_, &tuple->attributes[search_.attribute]});
      tuples.push_back(std::move(tuple));
    }
    batch_ = std::min(2 * batch_, kLargestBatch);
    std::vector<std::optional<Rational>> distances(pairs.size());
    const auto question = [&](std::size_t i, const LoadedSet& a, const LoadedSet& b,
                              const algebra3d::Monitor& monitor) -> Status {
      A3D_ASSIGN(distances[i], squared_distance_of(a.set, b.set, monitor));
      return {};
    };
    A3D_TRY(examiner_.ask(pairs, "distances", question));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!distances[i]) continue;
      ++distance_count_;
      const auto id = static_cast<std::uint64_t>(tuples[i]->id);
      near_.push_back({{}, std::move(distances[i]), id, std::move(tuples[i])});
      std::ranges::push_heap(near_, is_after);
    }
    return {};
  }

  IndexSearch search_;
  Value to_;
  std::uint64_t left_;
  const Context& context_;
  SpatialPairs examiner_;
  NearestEntries candidates_;
  bool is_started_ = false;
  std::optional<rtree::Neighbor<std::uint64_t>> pending_;  // the next candidate
  std::vector<NearTuple> near_;                            // a heap, the nearest one first
  std::size_t batch_ = 8;
  std::uint64_t distance_count_ = 0;
};

}  // namespace

TupleStreamPtr exact_distance_scan(IndexSearch search, Value to, std::uint64_t limit, const Context& context) {
  return std::make_shared<ExactDistanceScan>(std::move(search), std::move(to), limit, context);
}

}  // namespace queries
