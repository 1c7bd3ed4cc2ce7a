#include "queries/streams/detail/parallel_filter.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/base/scheduler.h"

namespace queries {
namespace {

class ParallelFilter final : public TupleStream {
 public:
  ParallelFilter(TupleStreamPtr stream, TupleCondition condition, Context& context)
      : stream_(std::move(stream)), condition_(std::move(condition)), context_(context) {}

  Result<TuplePtr> next() override {
    while (next_ == block_.size()) {
      if (is_at_end_) return TuplePtr();
      ALGEBRA3D_RETURN_IF_ERROR(read_block());
      ALGEBRA3D_RETURN_IF_ERROR(keep_fulfilling());
    }
    return std::move(block_[next_++]);
  }

 private:
  static constexpr std::size_t kFirstBlock = 16, kLargestBlock = 4096;

  Status read_block() {
    block_.clear();
    next_ = 0;
    while (block_.size() < size_ && !is_at_end_) {
      ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, stream_->next());
      is_at_end_ = tuple == nullptr;
      if (!is_at_end_) block_.push_back(std::move(tuple));
    }
    size_ = std::min(4 * size_, kLargestBlock);
    return {};
  }

  Status keep_fulfilling() {
    std::vector<Result<bool>> fulfil(block_.size(), Result<bool>(false));
    algebra3d::parallel_for(block_.size(), 1, [&](std::size_t i) {
      Context own = context_;
      own.report = nullptr;
      own.failed_calls = nullptr;
      fulfil[i] = own.is_cancelled() ? Result<bool>(algebra3d::Monitor::interrupted()) : condition_(*block_[i], own);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < block_.size(); ++i) {
      if (!fulfil[i]) return error_of(*block_[i], std::move(fulfil[i]).error());
      if (*fulfil[i]) block_[kept++] = std::move(block_[i]);
    }
    block_.resize(kept);
    return {};
  }

  /// The error of a tuple. Its condition is asked again, so that the context takes the call that failed.
  Error error_of(const Tuple& tuple, Error error) {
    if (error.code != ErrorCode::internal) return error;
    const Result<bool> again = condition_(tuple, context_);
    return again ? error : again.error();
  }

  TupleStreamPtr stream_;
  TupleCondition condition_;
  Context& context_;
  std::size_t size_ = kFirstBlock;  // of the next block
  std::vector<TuplePtr> block_;
  std::size_t next_ = 0;
  bool is_at_end_ = false;
};

}  // namespace

TupleStreamPtr parallel_filter(TupleStreamPtr stream, TupleCondition condition, Context& context) {
  return std::make_shared<ParallelFilter>(std::move(stream), std::move(condition), context);
}

}  // namespace queries
