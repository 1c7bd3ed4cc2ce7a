#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "queries/streams/batch.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// Reads tuples of a relation by their ids. Used by one thread; the relation outlives it.
class TuplesById {
 public:
  virtual ~TuplesById() = default;
  TuplesById() = default;
  TuplesById(const TuplesById&) = delete;
  TuplesById& operator=(const TuplesById&) = delete;
  /// The tuples with these ids, in their order, without those that are not there. Valid until the next call.
  virtual Result<const Batch*> read(std::span<const TupleId> ids) = 0;
};

/// A relation: stored in the database, or a list of tuples in memory. Used by one thread at a time.
class Relation {
 public:
  virtual ~Relation() = default;
  Relation() = default;
  Relation(const Relation&) = delete;
  Relation& operator=(const Relation&) = delete;

  virtual const TypeExpr& tuple_type() const = 0;
  virtual Result<std::int64_t> count() const = 0;
  /// A stream of all tuples in storage order. It shows the relation as it is at the first `next`.
  virtual Result<TupleStreamPtr> scan() = 0;
  /// A scan in columns, if the relation has them, else as `scan`. `read`: for each attribute, whether it is read;
  /// others may be undefined. Tuples that are not within all `bounds` may be left out.
  virtual Result<TupleStreamPtr> scan_columns(std::vector<bool> /*read*/, std::vector<AttributeBounds> /*bounds*/) {
    return scan();
  }
  /// The tuple with this id, or null.
  virtual Result<TuplePtr> fetch(TupleId id) = 0;
  /// Reads tuples by their ids, as they are when it reads first. `read`: as for `scan_columns`.
  virtual Result<std::unique_ptr<TuplesById>> by_id(std::vector<bool> read);
  /// True if the tuple that `fetch` returns now can be read until the statement ends, with its deferred values, even if
  /// the stored tuple is changed or deleted.
  virtual bool keeps(TupleId /*id*/) const { return false; }
  /// Name of a stored relation; empty for a relation in memory.
  virtual std::string name() const { return {}; }

  // Changes of a stored relation; its indexes are updated. Errors: wrong_usage for a relation in memory.
  virtual Result<TupleId> insert(const Tuple& tuple);
  /// Inserts all tuples of a stream, which is read to its end before the relation changes. A stream of the new tuples
  /// with their ids.
  virtual Result<TupleStreamPtr> insert_all(TupleStream& tuples, const algebra3d::Context& context);
  virtual Status erase(TupleId id);
  /// Writes only the values that differ.
  virtual Status update(TupleId id, const Tuple& tuple);
  /// Erases tuples, all different.
  virtual Status erase_all(std::span<const TupleId> ids, const algebra3d::Context& context);
  /// Whether it has `update_all`.
  virtual bool changes_in_columns() const { return false; }
  /// Gives tuples, all different, new values of some attributes: `values` has a tuple of these for each id, in their
  /// order.
  virtual Status update_all(std::span<const TupleId> ids, std::span<const std::size_t> attributes, TupleStream& values,
                            const algebra3d::Context& context);
};
using RelationPtr = std::shared_ptr<Relation>;

/// A relation that exists for one statement. Its tuples keep their ids.
class MemoryRelation final : public Relation {
 public:
  /// `tuples` must not be added to afterwards.
  MemoryRelation(TypeExpr tuple_type, TupleBuffer tuples)
      : tuple_type_(std::move(tuple_type)), tuples_(std::move(tuples)) {}

  const TypeExpr& tuple_type() const override { return tuple_type_; }
  Result<std::int64_t> count() const override { return static_cast<std::int64_t>(tuples_.size()); }
  Result<TupleStreamPtr> scan() override { return tuples_.scan(); }
  Result<TuplePtr> fetch(TupleId id) override { return tuples_.find(id); }

 private:
  TypeExpr tuple_type_;
  TupleBuffer tuples_;
};

}  // namespace queries
