#include "queries/streams/relation.h"

#include <utility>

#include "base/propagate.h"
#include "queries/streams/index_object.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Error not_stored() {
  return {ErrorCode::wrong_usage, "only a relation that is stored as an object can be changed"};
}

/// Reads tuples by `Relation::fetch`.
class FetchedOneByOne final : public TuplesById {
 public:
  FetchedOneByOne(Relation& relation, std::vector<bool> read) : relation_(relation), read_(std::move(read)) {}

  Result<const Batch*> read(std::span<const TupleId> ids) override {
    own_.ids.clear();
    for (const TupleId id : ids) {
      A3D_ASSIGN(const TuplePtr tuple, relation_.fetch(id));
      if (tuple != nullptr) add(*tuple, ids.size());
    }
    own_.finish(own_.ids.size());
    return &own_.batch;
  }

 private:
  void add(const Tuple& tuple, std::size_t most) {
    if (own_.columns.empty()) {
      std::vector<const algebra3d::Type*> types;
      for (const Value& value : tuple.attributes) types.push_back(&value.type());
      own_.set_types(types);
    }
    for (std::size_t attribute = 0; attribute < read_.size(); ++attribute) {
      if (!read_[attribute]) continue;
      if (own_.ids.empty()) own_.columns[attribute].restart(most);
      own_.columns[attribute].set(own_.ids.size(), tuple.attributes[attribute]);
    }
    own_.ids.push_back(tuple.id);
  }

  Relation& relation_;
  std::vector<bool> read_;
  OwnBatch own_;
};

}  // namespace

Error index_disagrees(std::string_view relation, std::string_view attribute, std::int64_t tuple, bool has_row) {
  return {ErrorCode::database_corrupt,
          "{}: the index of '{}' has the tuple {}, {}; run check database to see what is damaged",
          relation,
          attribute,
          tuple,
          has_row ? "whose row has another value" : "whose row is not in the file"};
}

Result<std::unique_ptr<TuplesById>> Relation::by_id(std::vector<bool> read) {
  return std::unique_ptr<TuplesById>(std::make_unique<FetchedOneByOne>(*this, std::move(read)));
}

Result<TupleId> Relation::insert(const Tuple&) {
  return not_stored();
}

Result<TupleStreamPtr> Relation::insert_all(TupleStream& tuples, const algebra3d::Context& context) {
  A3D_ASSIGN(const TupleBuffer input, buffered(tuples, context));
  std::vector<TupleId> ids;
  A3D_TRY(for_each_tuple(*input.scan(), context, [&](const TuplePtr& tuple) -> Status {
    A3D_ASSIGN(const TupleId id, insert(*tuple));
    ids.push_back(id);
    return {};
  }));
  return make_stream(
      [scan = input.scan(), ids = std::move(ids), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
        A3D_ASSIGN(const TuplePtr next, scan->next());
        if (next == nullptr) return next;
        return TuplePtr(std::make_shared<const Tuple>(Tuple{next->attributes, ids[position++]}));
      });
}

Status Relation::erase(TupleId) {
  return not_stored();
}
Status Relation::update(TupleId, const Tuple&) {
  return not_stored();
}

Status Relation::erase_all(std::span<const TupleId> ids, const algebra3d::Context& context) {
  for (const TupleId id : ids) {
    A3D_TRY(context.check_cancelled());
    A3D_TRY(erase(id));
  }
  return {};
}
Status Relation::update_all(std::span<const TupleId>, std::span<const std::size_t>, TupleStream&,
                            const algebra3d::Context&) {
  return not_stored();
}

}  // namespace queries
