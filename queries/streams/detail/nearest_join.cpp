#include "queries/streams/detail/nearest_join.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {
namespace {

/// The tuples of a stream as probes, in blocks, the first of which are small.
class ProbeBlocks {
 public:
  ProbeBlocks(TupleStreamPtr stream, const NearestTask& task, const Context& context)
      : stream_(std::move(stream)), task_(task), account_(context.memory) {}

  /// The next block; empty at the end. Errors: those of the stream.
  Status read(std::vector<NearestProbe>& probes) {
    probes.clear();
    account_.clear();
    while (probes.size() < size_) {
      A3D_ASSIGN(TuplePtr tuple, stream_->next());
      if (tuple == nullptr) break;
      const std::uint64_t place = place_++;
      if (window_of(tuple->attributes[task_.probe_key]).is_empty()) continue;
      // The tuple that no longer fits is taken, and ends the block.
      constexpr std::size_t kBytesOfNeighbour = 256;
      const bool has_room =
          account_.take(heap_bytes(*tuple) + kBytesOfNeighbour * std::min(task_.limit, kLargestBlock));
      probes.push_back({std::move(tuple), place});
      if (!has_room) break;
    }
    size_ = std::min(4 * size_, kLargestBlock);
    return {};
  }

 private:
  static constexpr std::size_t kLargestBlock = 4096;

  TupleStreamPtr stream_;
  NearestTask task_;
  algebra3d::MemoryAccount account_;
  std::size_t size_ = 16;    // of the next block
  std::uint64_t place_ = 0;  // of the next tuple
};

class NearestJoin final : public TupleStream {
 public:
  NearestJoin(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task, const Context& context)
      : blocks_(std::move(probes), task, context), search_(std::move(partners), task, context) {}

  Result<TuplePtr> next() override {
    while (true) {
      for (; probe_ < probes_.size(); ++probe_, neighbour_ = 0)
        if (const auto& nearest = probes_[probe_].nearest; neighbour_ < nearest.size())
          return concatenated(*probes_[probe_].tuple, *nearest[neighbour_++].tuple);
      probe_ = 0;
      A3D_TRY(blocks_.read(probes_));
      if (probes_.empty()) return TuplePtr();
      A3D_TRY(search_.search(probes_));
    }
  }
  std::vector<StageCount> stages() const override { return search_.stages(); }

 private:
  ProbeBlocks blocks_;
  NearestSearch search_;
  std::vector<NearestProbe> probes_;
  std::size_t probe_ = 0, neighbour_ = 0;  // of the next pair
};

class ClosestPair final : public TupleStream {
 public:
  ClosestPair(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task, const Context& context)
      : blocks_(std::move(probes), task, context), search_(std::move(partners), task, context) {}

  Result<TuplePtr> next() override {
    if (std::exchange(is_done_, true)) return TuplePtr();
    std::optional<NearTuple> best;
    TuplePtr best_probe;
    std::vector<NearestProbe> probes;
    // Nothing is nearer than 0, and later tuples do not precede.
    while (!best || best->squared_distance->sign() > 0) {
      A3D_TRY(blocks_.read(probes));
      if (probes.empty()) break;
      A3D_TRY(search_.search(probes));
      A3D_TRY(search_.make_first_exact(probes));
      for (NearestProbe& probe : probes) {
        // Those without an exact distance are farther away than another one of the block.
        if (probe.nearest.empty() || !probe.nearest.front().squared_distance) continue;
        if (best && *probe.nearest.front().squared_distance >= *best->squared_distance) continue;
        best = std::move(probe.nearest.front());
        best_probe = probe.tuple;
        search_.set_reach(distance_bound(*best->squared_distance));
      }
    }
    return best ? concatenated(*best_probe, *best->tuple) : TuplePtr();
  }
  std::vector<StageCount> stages() const override { return search_.stages(); }

 private:
  ProbeBlocks blocks_;
  NearestSearch search_;
  bool is_done_ = false;
};

}  // namespace

TupleStreamPtr nearest_join(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task,
                            const Context& context) {
  return std::make_shared<NearestJoin>(std::move(probes), std::move(partners), task, context);
}

TupleStreamPtr closest_pair(TupleStreamPtr probes, TupleBuffer partners, const NearestTask& task,
                            const Context& context) {
  return std::make_shared<ClosestPair>(std::move(probes), std::move(partners), task, context);
}

}  // namespace queries
