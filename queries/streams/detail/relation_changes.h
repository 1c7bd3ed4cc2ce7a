#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

// Shared by the operators that change stored relations. At the first `next` of their result they read all input and
// then write, since a relation must not change while it is being read.

/// A stream that calls `make` when its first tuple is pulled, and returns the tuples of the stream made.
template <typename Make>
TupleStreamPtr made_when_asked(Make make) {
  class Stream final : public TupleStream {
   public:
    explicit Stream(Make function) : make_(std::move(function)) {}
    Result<TuplePtr> next() override {
      A3D_TRY(open());
      return made_->next();
    }
    bool has_batches() const override { return true; }
    Result<const Batch*> next_batch(std::size_t most) override {
      A3D_TRY(open());
      return batches_->next(most);
    }

   private:
    Status open() {
      if (made_ != nullptr) return {};
      A3D_ASSIGN(made_, make_());
      batches_.emplace(*made_);
      return {};
    }
    Make make_;
    TupleStreamPtr made_;
    std::optional<BatchReader> batches_;  // of its tuples
  };
  return std::make_shared<Stream>(std::move(make));
}

/// The tuple with its id as a further attribute.
TuplePtr tuple_with_id(const Tuple& tuple, TupleId id);
/// The tuples of a buffer, each with its id as a further attribute.
TupleStreamPtr tuples_with_ids(const TupleBuffer& tuples);

/// A copy of the tuple with all values loaded, valid after the stored tuple is erased. It keeps its id.
Result<TuplePtr> loaded_tuple(const Tuple& tuple);

/// Hash of all attributes. Of spatial values it takes box and count only, so no geometry is read.
std::size_t quick_hash(const Tuple& tuple);
/// Whether all attributes are equal. Undefined equals undefined.
Result<bool> are_equal(const Tuple& a, const Tuple& b);

/// Tuples that an operator is to change.
struct Operand {
  TupleStreamPtr tuples;
  RelationPtr relation;  ///< of which they are to be
  std::string op;        ///< the operator, for errors
  bool are_own = false;  ///< the plan says that they are of the relation: then of `tuples` the ids alone may be known
};

/// The tuples of the operand without duplicates; checks that they are tuples of the relation. They can be read after
/// they were changed in it. Errors: wrong_usage for a tuple without an id or one that differs from that of the
/// relation.
Result<TupleBuffer> own_tuples(const Operand& operand, const Context& context);

/// The tuples of the operand as they come, without duplicates, of which it lists the ids; checks that they are tuples
/// of the relation. Errors: as for `own_tuples`.
class OwnTuples final : public TupleStream {
 public:
  explicit OwnTuples(Operand operand) : operand_(std::move(operand)) {}

  Result<TuplePtr> next() override;
  bool has_batches() const override { return operand_.tuples->has_batches(); }
  Result<const Batch*> next_batch(std::size_t most) override;
  /// The ids of the tuples so far.
  std::vector<TupleId> take_ids() { return std::exchange(ids_, {}); }

 private:
  Result<bool> is_new(TupleId id);
  Status compare_with_stored(const Batch& batch);

  Operand operand_;
  std::unique_ptr<TuplesById> stored_;  // if they are compared
  std::vector<TupleId> ids_;
  bool are_ascending_ = true;
  std::unordered_set<TupleId> seen_;  // if they are not ascending
  std::vector<std::uint32_t> rows_;
  Batch batch_;
};

/// Some attributes of the tuples of a stream, by their places there, each with its id as a further attribute.
TupleStreamPtr attributes_with_ids(TupleStreamPtr tuples, std::vector<std::size_t> attributes,
                                   std::vector<TupleId> ids);

/// The tuple with this id (tid or int), which can be read after it was changed; an empty buffer if there is none.
Result<TupleBuffer> tuple_by_id(const Value& id, Relation& relation);

}  // namespace queries
