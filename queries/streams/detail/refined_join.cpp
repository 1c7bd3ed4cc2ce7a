#include "queries/streams/detail/refined_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/counters.h"
#include "base/propagate.h"
#include "queries/streams/detail/spatial_pairs.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

/// How the pairs of a join were decided.
struct DecisionCounts {
  std::uint64_t pairs = 0;
  std::uint64_t by_boxes = 0;      ///< without geometry
  std::uint64_t by_one_box = 0;    ///< by the box of the smaller value and the box hierarchy of the other one
  std::uint64_t by_hierarchy = 0;  ///< by the box hierarchies of both values
  std::uint64_t by_exact_tests = 0;
  std::uint64_t exact_tests = 0;  ///< signs of determinants
};

class RefinedJoin final : public TupleStream {
 public:
  RefinedJoin(PairStreamPtr pairs, PairKeys keys, PairTest test, const Context& context)
      : pairs_(std::move(pairs)),
        keys_(keys),
        test_(std::move(test)),
        context_(context),
        account_(context.memory),
        examiner_(context) {}

  Result<TuplePtr> next() override {
    while (true) {
      for (; next_ < block_.size(); ++next_)
        if (verdicts_[next_] != PairVerdict::no) return joined(next_++);
      if (is_at_end_) return TuplePtr();
      A3D_TRY(context_.check_cancelled());
      A3D_TRY(read_block());
      A3D_TRY(decide());
    }
  }

  std::vector<StageCount> stages() const override {
    return {{"pairs of boxes", counts_.pairs},
            {"decided by boxes", counts_.by_boxes},
            {"decided by one hierarchy", counts_.by_one_box},
            {"decided by hierarchies", counts_.by_hierarchy},
            {"decided by exact tests", counts_.by_exact_tests},
            {"exact tests", counts_.exact_tests},
            {"geometries loaded", examiner_.load_count()}};
  }

 private:
  static constexpr std::size_t kFirstBlock = 16, kGrowth = 64, kLargestBlock = std::size_t{1} << 22;
  static constexpr std::size_t kBytesOfPair = 160;  // in all lists together

  const Value& build_key(const TuplePair& pair) const { return pair.build->attributes[keys_.build]; }
  const Value& probe_key(const TuplePair& pair) const { return pair.probe->attributes[keys_.probe]; }

  TuplePtr joined(std::size_t i) const {
    const TuplePair& pair = block_[i];
    return verdicts_[i] == PairVerdict::turned ? concatenated(*pair.probe, *pair.build)
                                               : concatenated(*pair.build, *pair.probe);
  }

  // Pairs of one tuple of the probe side follow one another. The first block is small, so that the first results come
  // soon. The next ones are far larger: the values of a block come from everywhere, so that the next one needs most of
  // them again.
  Status read_block() {
    block_.clear();
    next_ = 0;
    account_.clear();
    const Tuple* last_probe = nullptr;
    while (block_.size() < size_) {
      if (pending_.build == nullptr) {
        A3D_ASSIGN(pending_, pairs_->next());
      }
      is_at_end_ = pending_.build == nullptr;
      if (is_at_end_) break;
      const std::size_t probe_bytes = pending_.probe.get() == last_probe ? 0 : heap_bytes(*pending_.probe);
      if (!account_.take(kBytesOfPair + probe_bytes) && !block_.empty()) break;
      last_probe = pending_.probe.get();
      block_.push_back(std::exchange(pending_, {}));
    }
    size_ = std::min(kGrowth * size_, kLargestBlock);
    return {};
  }

  Status decide() {
    verdicts_.assign(block_.size(), PairVerdict::no);
    counts_.pairs += block_.size();
    OpenPairs open;
    for (std::uint32_t i = 0; i < block_.size(); ++i) {
      const Value &a = build_key(block_[i]), &b = probe_key(block_[i]);
      if (const auto verdict = test_.by_boxes(a.header().box, b.header().box)) {
        verdicts_[i] = *verdict;
        ++counts_.by_boxes;
        continue;
      }
      open.values.push_back({&a, &b});
      open.positions.push_back(i);
    }
    A3D_TRY(ask_boxes(open));
    return ask(open);
  }

  /// Pairs that are not decided yet, and their positions in the block.
  struct OpenPairs {
    std::vector<ValuePair> values;
    std::vector<std::uint32_t> positions;
  };

  std::string progress(const OpenPairs& open) const {
    return fmt::format("examining {} pairs after {}", open.values.size(), counts_.pairs - block_.size());
  }

  /// Leaves those pairs that the box of one value and the geometry of the other do not decide.
  Status ask_boxes(OpenPairs& open) {
    std::vector<std::uint8_t> is_decided(open.values.size());
    const auto question = [&](std::size_t i, const algebra3d::Box3& box, bool is_box_of_first, const LoadedSet& other) {
      const auto verdict = test_.by_one_box(box, is_box_of_first, other.set);
      is_decided[i] = verdict ? 1 : 0;
      if (verdict) verdicts_[open.positions[i]] = *verdict;
    };
    A3D_TRY(examiner_.ask_boxes(open.values, progress(open), question));
    std::size_t left = 0;
    for (std::size_t i = 0; i < is_decided.size(); ++i) {
      if (is_decided[i] != 0) continue;
      open.values[left] = open.values[i];
      open.positions[left++] = open.positions[i];
    }
    counts_.by_one_box += is_decided.size() - left;
    open.values.resize(left);
    open.positions.resize(left);
    return {};
  }

  Status ask(const OpenPairs& open) {
    std::vector<std::uint64_t> exact_tests(open.values.size());
    const auto question = [&](std::size_t i, const LoadedSet& a, const LoadedSet& b,
                              const algebra3d::Monitor& monitor) -> Status {
      const std::uint64_t before = algebra3d::exact_calls_of_this_thread();
      A3D_ASSIGN(verdicts_[open.positions[i]], test_.by_geometry(a.set, b.set, monitor));
      exact_tests[i] = algebra3d::exact_calls_of_this_thread() - before;
      return {};
    };
    A3D_TRY(examiner_.ask(open.values, progress(open), question));
    for (const std::uint64_t count : exact_tests) {
      ++(count == 0 ? counts_.by_hierarchy : counts_.by_exact_tests);
      counts_.exact_tests += count;
    }
    return {};
  }

  PairStreamPtr pairs_;
  PairKeys keys_;
  PairTest test_;
  const Context& context_;
  algebra3d::MemoryAccount account_;
  SpatialPairs examiner_;
  DecisionCounts counts_;
  std::size_t size_ = kFirstBlock;  // of the next block
  TuplePair pending_;               // the first one of the next block
  std::vector<TuplePair> block_;
  std::vector<PairVerdict> verdicts_;
  std::size_t next_ = 0;
  bool is_at_end_ = false;
};

}  // namespace

TupleStreamPtr refined_join(PairStreamPtr pairs, PairKeys keys, PairTest test, const Context& context) {
  return std::make_shared<RefinedJoin>(std::move(pairs), keys, std::move(test), context);
}

}  // namespace queries
