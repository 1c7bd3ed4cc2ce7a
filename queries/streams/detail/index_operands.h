#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/index_object.h"
#include "queries/streams/listed_tuples.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {

/// The source of an index: a relation, whose tuples have ids, or a stream. A stream may carry the ids in an attribute
/// of type tid; otherwise its tuples must come unchanged from a stored relation.
struct IndexSource {
  TypeExpr given;                           ///< tuple type of the operand
  TypeExpr indexed;                         ///< tuple type without the attribute that holds ids
  std::optional<std::size_t> id_attribute;  ///< in `given`
};
Result<IndexSource> index_source(const MappingCheck& check);

/// Calls `add(tuple, id)` for each tuple of the operand. Tuples whose id is undefined are left out. Errors: wrong_usage
/// for a tuple without an id.
template <typename Add>
Status for_each_indexed(const Datum& source, std::optional<std::size_t> id_attribute, std::string_view op,
                        const Context& context, Add add) {
  A3D_ASSIGN(const TupleStreamPtr stream, tuples_of(source));
  return for_each_tuple(*stream, context, [&](const TuplePtr& tuple) -> Status {
    if (id_attribute) {
      const Value& id = tuple->attributes[*id_attribute];
      return id.is_defined() ? add(*tuple, id_of(id)) : Status();
    }
    if (tuple->id != 0) return add(*tuple, tuple->id);
    return Error{
        ErrorCode::wrong_usage,
        "{}: the tuples have no ids; build the index on a stored relation, or on a filtered scan of one, or first "
        "give them an attribute of type tid",
        op};
  });
}

/// The name of the operand if it is a stored relation; else empty.
std::string stored_name(const Datum& source);

/// Checks that the index was made for tuples of this type and, if it follows a stored relation, for this relation.
template <typename Index>
Status check_fits(const Index& index, const Relation& relation, std::string_view op) {
  if (!index.is_definition() || index.relation() == relation.name()) return {};
  return Error{ErrorCode::wrong_usage, "{}: the index is on the relation '{}', not on '{}'", op, index.relation(),
               relation.name()};
}

/// The tuple that a search in an index has found, or null if it is gone. Of an index that follows its relation, a tuple
/// without a row, or whose row has a key for which `fits(tuple)` is false, is an error: database_corrupt. A frozen
/// index may know tuples that have changed since, and so may a search that began before its statement changed them.
template <typename Fits>
Result<TuplePtr> indexed_tuple(Relation& relation, const IndexObject& index, TupleId id, Fits fits) {
  A3D_ASSIGN(TuplePtr tuple, relation.fetch(id));
  const bool is_right = tuple != nullptr && fits(*tuple);
  if (is_right || !index.is_definition() || !relation.keeps(id)) return tuple;
  return index_disagrees(relation.name(), index.attribute(), id, tuple != nullptr);
}

/// A stream of the tuples that a search in an index has found; `next` returns a Result of an optional value, whose id
/// is `id_of_found(value)`, and `fits(tuple, value)` is as for `indexed_tuple`. Tuples that are gone are skipped.
template <typename Index, typename Next, typename IdOfFound, typename Fits>
TupleStreamPtr fetched(RelationPtr relation, std::shared_ptr<Index> index, Next next, IdOfFound id_of_found,
                       Fits fits) {
  return make_stream([relation = std::move(relation), index = std::move(index), next = std::move(next), id_of_found,
                      fits]() mutable -> Result<TuplePtr> {
    while (true) {
      A3D_ASSIGN(const auto found, next());
      if (!found) return TuplePtr();
      const auto id = static_cast<TupleId>(std::invoke(id_of_found, *found));
      A3D_ASSIGN(TuplePtr tuple,
                 indexed_tuple(*relation, *index, id, [&](const Tuple& each) { return fits(each, *found); }));
      if (tuple != nullptr) return tuple;
    }
  });
}

/// As `fetched`, of listed tuples in columns.
TupleStreamPtr found_tuples(const RelationPtr& relation, const std::shared_ptr<const IndexObject>& index,
                            TupleList list, const Context& context);

/// A function object that returns the elements of a vector one by one, then nothing.
template <typename T>
auto one_by_one(std::vector<T> elements) {
  return [elements = std::move(elements), position = std::size_t{0}]() mutable -> Result<std::optional<T>> {
    return position == elements.size() ? std::nullopt : std::optional(elements[position++]);
  };
}

}  // namespace queries
