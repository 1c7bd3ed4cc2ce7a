#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {

/// What an index is built from: a relation, whose tuples have ids, or a stream, which may carry them in an attribute of
/// type tid; else its tuples must come straight from a stored relation.
struct IndexSource {
  TypeExpr given;                           ///< tuple type of the operand
  TypeExpr indexed;                         ///< the same without the attribute that holds ids
  std::optional<std::size_t> id_attribute;  ///< in `given`
};
Result<IndexSource> index_source(const MappingCheck& check);

/// Calls `add(tuple, id)` for each tuple of the operand of a creating operator. Errors: wrong_usage for a tuple without
/// an id. Tuples whose id is undefined are left out.
template <typename Add>
Status for_each_indexed(const Datum& source, std::optional<std::size_t> id_attribute, std::string_view op,
                        const Context& context, Add add) {
  ASSIGN_OR_RETURN(const TupleStreamPtr stream, tuples_of(source));
  return for_each_tuple(*stream, context, [&](const TuplePtr& tuple) -> Status {
    if (id_attribute) {
      const Value& id = tuple->attributes[*id_attribute];
      return id.is_defined() ? add(*tuple, id_of(id)) : Status();
    }
    if (tuple->id != 0) return add(*tuple, tuple->id);
    return Error{
        ErrorCode::wrong_usage,
        "{}: the tuples have no ids; build the index on a stored relation, or on a filtered scan of one, or give "
        "them an attribute of type tid before",
        op};
  });
}

/// The name of the stored relation that an operand is; empty for everything else.
std::string stored_name(const Datum& source);

/// The index fits the relation: made for its tuples and, if it follows a stored relation, for this one.
template <typename Index>
Status check_fits(const Index& index, const Relation& relation, std::string_view op) {
  if (!index.is_definition() || index.relation() == relation.name()) return {};
  return Error{ErrorCode::wrong_usage, "{}: the index is on the relation '{}', not on '{}'", op, index.relation(),
               relation.name()};
}

/// Fetches tuples by id, skipping ids that a frozen index still holds and the relation does not.
template <typename NextId>
TupleStreamPtr fetched(RelationPtr relation, NextId next_id) {
  return make_stream([relation = std::move(relation), next_id = std::move(next_id)]() mutable -> Result<TuplePtr> {
    while (const auto id = next_id()) {
      ASSIGN_OR_RETURN(TuplePtr tuple, relation->fetch(static_cast<TupleId>(*id)));
      if (tuple != nullptr) return tuple;
    }
    return TuplePtr();
  });
}

/// The elements of a vector, one per call; then nothing.
template <typename T>
auto one_by_one(std::vector<T> elements) {
  return [elements = std::move(elements), position = std::size_t{0}]() mutable {
    return position == elements.size() ? std::nullopt : std::optional(elements[position++]);
  };
}

}  // namespace queries
