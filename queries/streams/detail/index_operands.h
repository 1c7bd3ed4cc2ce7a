#pragma once

#include <optional>
#include <string_view>
#include <utility>

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
  ALGEBRA3D_ASSIGN_OR_RETURN(const TupleStreamPtr stream, tuples_of(source));
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

/// A stream of the tuples with the given ids; `next_id` returns a Result of an optional id. Ids that are no longer in
/// the relation are skipped (frozen indexes).
template <typename NextId>
TupleStreamPtr fetched(RelationPtr relation, NextId next_id) {
  return make_stream([relation = std::move(relation), next_id = std::move(next_id)]() mutable -> Result<TuplePtr> {
    while (true) {
      ALGEBRA3D_ASSIGN_OR_RETURN(const auto id, next_id());
      if (!id) return TuplePtr();
      ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, relation->fetch(static_cast<TupleId>(*id)));
      if (tuple != nullptr) return tuple;
    }
  });
}

/// A function object that returns the elements of a vector one by one, then nothing.
template <typename T>
auto one_by_one(std::vector<T> elements) {
  return [elements = std::move(elements), position = std::size_t{0}]() mutable -> Result<std::optional<T>> {
    return position == elements.size() ? std::nullopt : std::optional(elements[position++]);
  };
}

}  // namespace queries
