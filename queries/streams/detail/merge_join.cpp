#include "queries/streams/detail/merge_join.h"

#include "base/propagate.h"

namespace queries {
namespace {

/// The groups of one side, proved to come in ascending order.
class Side {
 public:
  Side(TupleStreamPtr tuples, std::size_t key, std::string unsorted)
      : groups_(std::move(tuples), {key}), unsorted_(std::move(unsorted)) {}

  Status advance(const Context& context) {
    std::vector<Value> last = group_ ? std::move(group_->keys) : std::vector<Value>();
    A3D_ASSIGN(group_, groups_.next(context));
    if (group_ && !last.empty() && compare_keys(last, group_->keys) > 0)
      return Error{ErrorCode::wrong_usage, unsorted_};
    return {};
  }
  bool is_at_end() const { return !group_; }
  const Value& key() const { return group_->keys.front(); }
  const TupleBuffer& tuples() const { return group_->tuples; }

 private:
  AdjacentGroups groups_;
  std::string unsorted_;
  std::optional<AdjacentGroups::Group> group_;
};

std::string unsorted(const MergeJoinParameters& parameters, const char* which, const TypeExpr& tuple, std::size_t key) {
  return fmt::format("{}: the {} stream is not sorted by {}; write `sortby[{}]`, or use sortmergejoin", parameters.name,
                     which, tuple.attributes()[key].name, tuple.attributes()[key].name);
}

/// Each tuple beside the padding, which stands on the left or on the right.
TupleStreamPtr beside(const TuplePtr& padding, TupleStreamPtr tuples, bool is_on_the_left) {
  return make_stream([padding, tuples = std::move(tuples), is_on_the_left]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return TuplePtr();
    return is_on_the_left ? concatenated(*padding, *tuple) : concatenated(*tuple, *padding);
  });
}

class MergeJoin final : public TupleStream {
 public:
  MergeJoin(TupleStreamPtr left, TupleStreamPtr right, const MergeJoinParameters& parameters, const Context& context)
      : left_(std::move(left), parameters.keys.left,
              unsorted(parameters, "first", parameters.types.left, parameters.keys.left)),
        right_(std::move(right), parameters.keys.right,
               unsorted(parameters, "second", parameters.types.right, parameters.keys.right)),
        left_padding_(undefined_tuple(parameters.types.left)),
        right_padding_(undefined_tuple(parameters.types.right)),
        is_outer_(parameters.is_outer),
        context_(context) {}

  Result<TuplePtr> next() override {
    if (!has_begun_) {
      has_begun_ = true;
      A3D_TRY(left_.advance(context_));
      A3D_TRY(right_.advance(context_));
    }
    while (true) {
      if (output_ != nullptr) {
        A3D_ASSIGN(TuplePtr next, output_->next());
        if (next != nullptr) return next;
        output_ = nullptr;
      }
      if (is_at_end()) return read_to_the_end();
      A3D_TRY(step());
    }
  }

 private:
  bool is_at_end() const {
    return is_outer_ ? left_.is_at_end() && right_.is_at_end() : left_.is_at_end() || right_.is_at_end();
  }

  // Tuples after the last possible match must still be sorted: else a match may have been missed.
  Result<TuplePtr> read_to_the_end() {
    while (!left_.is_at_end()) A3D_TRY(left_.advance(context_));
    while (!right_.is_at_end()) A3D_TRY(right_.advance(context_));
    return TuplePtr();
  }

  // Undefined keys come first on either side and have no partners.
  Status step() {
    const bool takes_left = !left_.is_at_end() && (right_.is_at_end() || !left_.key().is_defined() ||
                                                   compare(left_.key(), right_.key()) <= 0);
    if (!takes_left) {
      if (is_outer_) output_ = beside(left_padding_, right_.tuples().scan(), true);
      return right_.advance(context_);
    }
    const bool is_match = !right_.is_at_end() && left_.key().is_defined() && compare(left_.key(), right_.key()) == 0;
    if (is_match)
      output_ = joined_pairs(left_.tuples().scan(), right_.tuples(), nullptr, context_);
    else if (is_outer_)
      output_ = beside(right_padding_, left_.tuples().scan(), false);
    A3D_TRY(left_.advance(context_));
    return is_match ? right_.advance(context_) : Status();
  }

  Side left_;
  Side right_;
  TuplePtr left_padding_;
  TuplePtr right_padding_;
  bool is_outer_;
  const Context& context_;
  TupleStreamPtr output_;
  bool has_begun_ = false;
};

}  // namespace

TupleStreamPtr merge_join(TupleStreamPtr left, TupleStreamPtr right, const MergeJoinParameters& parameters,
                          const Context& context) {
  return std::make_shared<MergeJoin>(std::move(left), std::move(right), parameters, context);
}

}  // namespace queries
