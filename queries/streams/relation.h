#pragma once

#include <memory>
#include <string>
#include <vector>

#include "queries/streams/datum.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A relation: stored in the database, or a list of tuples in memory. Used by one thread at a time.
class Relation {
 public:
  virtual ~Relation() = default;
  Relation() = default;
  Relation(const Relation&) = delete;
  Relation& operator=(const Relation&) = delete;

  virtual const TypeExpr& tuple_type() const = 0;
  virtual Result<std::int64_t> count() const = 0;
  /// All tuples in storage order. The stream sees the relation as at its first `next`.
  virtual Result<TupleStreamPtr> scan() = 0;
  /// The tuple of that id, or null.
  virtual Result<TuplePtr> fetch(TupleId id) = 0;
  /// Name of the stored relation; empty for one in memory.
  virtual std::string name() const { return {}; }

  // Changes: stored relations only; indexes on the relation follow. Errors on others: wrong_usage.
  virtual Result<TupleId> insert(const Tuple& tuple);
  virtual Status erase(TupleId id);
  virtual Status update(TupleId id, const Tuple& tuple);
};
using RelationPtr = std::shared_ptr<Relation>;

/// A relation that lives as long as its statement; its tuples keep the ids that they came with.
class MemoryRelation final : public Relation {
 public:
  /// Of tuples that nobody adds to any more.
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
