#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "queries/streams/datum.h"

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

/// A relation in memory; its tuples keep the ids that they came with.
class MemoryRelation final : public Relation {
 public:
  MemoryRelation(TypeExpr tuple_type, std::vector<TuplePtr> tuples);
  /// Shares the tuples, which nobody changes any more.
  MemoryRelation(TypeExpr tuple_type, std::shared_ptr<const std::vector<TuplePtr>> tuples)
      : tuple_type_(std::move(tuple_type)), tuples_(std::move(tuples)) {}

  const TypeExpr& tuple_type() const override { return tuple_type_; }
  Result<std::int64_t> count() const override { return static_cast<std::int64_t>(tuples_->size()); }
  Result<TupleStreamPtr> scan() override;
  Result<TuplePtr> fetch(TupleId id) override;
  const std::vector<TuplePtr>& tuples() const { return *tuples_; }

 private:
  TypeExpr tuple_type_;
  std::shared_ptr<const std::vector<TuplePtr>> tuples_;
  std::unordered_map<TupleId, std::size_t> position_of_;  // filled by the first fetch
};

/// Pulls everything out of a stream. Errors: those of the stream, interrupted.
Result<std::vector<TuplePtr>> materialise(TupleStream& stream, const algebra3d::Context& context);

}  // namespace queries
