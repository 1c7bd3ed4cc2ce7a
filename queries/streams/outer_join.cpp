// symmouterjoin: the full outer join by any predicate.
#include <array>

#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/pairs.h"

namespace queries {
namespace {

/// First every tuple of the left stream with its partners, or beside undefined values if it has none; then the tuples
/// on the right that were nobody's partner. The right side is the build side, with a mark for each tuple that has a
/// partner.
class OuterJoin final : public TupleStream {
 public:
  OuterJoin(TupleStreamPtr left, TupleBuffer right, std::shared_ptr<const Function> predicate, const JoinTypes& types,
            const Context& context)
      : left_(std::move(left)),
        right_(std::move(right)),
        predicate_(std::move(predicate)),
        left_padding_(undefined_tuple(types.left)),
        right_padding_(undefined_tuple(types.right)),
        has_partner_(right_.size()),
        context_(context) {}

  Result<TuplePtr> next() override {
    if (!has_begun_) A3D_TRY(begin_next_left());
    has_begun_ = true;
    while (current_ != nullptr) {
      A3D_ASSIGN(TuplePtr pair, next_pair());
      if (pair != nullptr) return pair;
      const TuplePtr left = current_;
      const bool is_alone = !is_matched_;
      A3D_TRY(begin_next_left());
      if (is_alone) return concatenated(*left, *right_padding_);
    }
    while (true) {
      A3D_ASSIGN(const TuplePtr right, next_right());
      if (right == nullptr) return TuplePtr();
      if (!has_partner_[position_ - 1]) return concatenated(*left_padding_, *right);
    }
  }

 private:
  // At the end of the left stream the right one is read once more, for tuples without a partner.
  Status begin_next_left() {
    A3D_ASSIGN(current_, left_->next());
    is_matched_ = false;
    position_ = 0;
    partners_ = right_.scan();
    return {};
  }

  Result<TuplePtr> next_right() {
    if (++steps_ % 4096 == 0) A3D_TRY(context_.check_cancelled());
    ++position_;
    return partners_->next();
  }

  /// The current left tuple with its next partner; null if there is no more.
  Result<TuplePtr> next_pair() {
    while (true) {
      A3D_ASSIGN(const TuplePtr right, next_right());
      if (right == nullptr) return TuplePtr();
      const std::array<Datum, 2> both = {Datum{current_}, Datum{right}};
      A3D_ASSIGN(const Value holds, predicate_->call_for_value(both));
      if (!is_true(holds)) continue;
      is_matched_ = true;
      has_partner_[position_ - 1] = true;
      return concatenated(*current_, *right);
    }
  }

  TupleStreamPtr left_;
  TupleBuffer right_;
  std::shared_ptr<const Function> predicate_;
  TuplePtr left_padding_;
  TuplePtr right_padding_;
  std::vector<bool> has_partner_;
  const Context& context_;

  TuplePtr current_;
  bool is_matched_ = false;
  TupleStreamPtr partners_;
  std::size_t position_ = 0;  // of the tuple that comes next on the right
  bool has_begun_ = false;
  std::uint32_t steps_ = 0;
};

Result<BoundOperator> map_symmouterjoin(std::span<const ArgumentType> arguments) {
  const MappingCheck check("symmouterjoin", arguments);
  A3D_ASSIGN(const JoinTypes types, join_types(check));
  A3D_TRY(check.function(2, {types.left, types.right}, "bool"));
  return BoundOperator{
      TypeExpr::stream(types.joined), [types](std::vector<Datum> given, Context& context) -> Result<Datum> {
        A3D_ASSIGN(TupleBuffer right, buffered(*given[1].tuples(), context));
        return Datum{TupleStreamPtr(
            std::make_shared<OuterJoin>(given[0].tuples(), std::move(right), given[2].function_ptr(), types, context))};
      }};
}

}  // namespace

void register_outer_join(algebra3d::OperatorGroup& group) {
  const std::string left = "[const rel(tuple([A: int])) value ((1) (2) (undefined))] feed ";
  const std::string right = "[const rel(tuple([B: int])) value ((2) (0) (undefined))] feed ";
  group.add({
      .name = "symmouterjoin",
      .syntax = "_ _ symmouterjoin[fun(TUPLE, TUPLE2)]",
      .doc = "The full outer join: the pairs for which the predicate is a defined TRUE, and every tuple without a "
             "partner, padded with undefined values.",
      .detail = "`.A` is an attribute of the first, `..B` of the second tuple. In the order of the first stream; "
                "then come the tuples of the second that have no partner. The second stream is materialised, beyond "
                "the memory of `set \"memory\"` in a temporary file.",
      .stream = stream_operator(map_symmouterjoin),
      .signatures = {"(stream(tuple) stream(tuple) (map tuple tuple bool)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + right + "symmouterjoin[.A < ..B] consume",
                          "((1 2) (2 undefined) (undefined undefined) (undefined 0) (undefined undefined))"}},
      .query_errors = {{"query " + left + right + "symmouterjoin[.A] count",
                        "symmouterjoin: expected a function that gives bool, got int"},
                       {"query " + left + left + "symmouterjoin[TRUE] count",
                        "symmouterjoin: duplicate attribute name 'A'"}},
  });
}

}  // namespace queries
