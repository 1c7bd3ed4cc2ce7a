#include "queries/streams/detail/parallel_filter.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/propagate.h"
#include "base/scheduler.h"

namespace queries {
namespace {

class BlockFilter final : public TupleStream {
 public:
  BlockFilter(TupleStreamPtr stream, std::size_t largest_block, BlockCondition condition, const Context& context)
      : stream_(std::move(stream)),
        largest_block_(largest_block),
        condition_(std::move(condition)),
        context_(context) {}

  Result<TuplePtr> next() override {
    while (next_ == block_.size()) {
      if (is_at_end_) return TuplePtr();
      A3D_TRY(context_.check_cancelled());
      A3D_TRY(read_block());
      A3D_TRY(keep_fulfilling());
    }
    return std::move(block_[next_++]);
  }

 private:
  static constexpr std::size_t kFirstBlock = 16;

  Status read_block() {
    block_.clear();
    next_ = 0;
    while (block_.size() < size_ && !is_at_end_) {
      A3D_ASSIGN(TuplePtr tuple, stream_->next());
      is_at_end_ = tuple == nullptr;
      if (!is_at_end_) block_.push_back(std::move(tuple));
    }
    size_ = std::min(4 * size_, largest_block_);
    return {};
  }

  Status keep_fulfilling() {
    A3D_ASSIGN(const std::vector<bool> fulfil, condition_(block_));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < block_.size(); ++i)
      if (fulfil[i]) block_[kept++] = std::move(block_[i]);
    block_.resize(kept);
    return {};
  }

  TupleStreamPtr stream_;
  std::size_t largest_block_;
  BlockCondition condition_;
  const Context& context_;
  std::size_t size_ = kFirstBlock;  // of the next block
  std::vector<TuplePtr> block_;
  std::size_t next_ = 0;
  bool is_at_end_ = false;
};

/// The error of a tuple. Its condition is asked again, so that the context takes the call that failed.
Error error_of(const Tuple& tuple, const TupleCondition& condition, Error error, Context& context) {
  if (error.code != ErrorCode::internal) return error;
  const Result<bool> again = condition(tuple, context);
  return again ? error : again.error();
}

Result<std::vector<bool>> examined_in_parallel(std::span<const TuplePtr> block, const TupleCondition& condition,
                                               Context& context) {
  std::vector<Result<bool>> fulfil(block.size(), Result<bool>(false));
  algebra3d::parallel_for(block.size(), 1, [&](std::size_t i) {
    Context own = context;
    own.report = nullptr;
    own.failed_calls = nullptr;
    fulfil[i] = own.is_cancelled() ? Result<bool>(algebra3d::Monitor::interrupted()) : condition(*block[i], own);
  });
  std::vector<bool> result(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!fulfil[i]) return error_of(*block[i], condition, std::move(fulfil[i]).error(), context);
    result[i] = *fulfil[i];
  }
  return result;
}

}  // namespace

TupleStreamPtr block_filter(TupleStreamPtr stream, std::size_t largest_block, BlockCondition condition,
                            const Context& context) {
  return std::make_shared<BlockFilter>(std::move(stream), largest_block, std::move(condition), context);
}

TupleStreamPtr parallel_filter(TupleStreamPtr stream, TupleCondition condition, Context& context) {
  constexpr std::size_t kLargestBlock = 4096;
  const auto examine = [condition = std::move(condition), &context](std::span<const TuplePtr> block) {
    return examined_in_parallel(block, condition, context);
  };
  return block_filter(std::move(stream), kLargestBlock, examine, context);
}

}  // namespace queries
